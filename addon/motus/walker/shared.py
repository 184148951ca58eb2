"""Results that a walker's two solvers (feet and body) share within one evaluation."""

from ..core import keeping, wiring
from ..core.evaluated import copies, read_keys

_WAITING = keeping.OfEvaluation(
    "what a walker's first solver leaves for its second one: (moment, group, what was found, which keys were read)",
    "the owner",
    "one for each walker",
    until="the second solver has taken it",
)


def found(context, make):
    """The result of make(), made by the first of an owner's two solvers and kept for the second one."""
    copy = copies.of(context.owner)
    if copy is None:
        return make()
    moment = wiring.evaluation(), context.frame
    # Taken by one alone: who is solved again by itself may be so because the rest has changed.
    kept = _WAITING.on(copy)
    waiting = kept.pop("waiting", None)
    if waiting is not None and waiting[0] == moment and waiting[1] != context.group and read_keys.note(waiting[3]):
        return waiting[2]
    made = make()
    kept["waiting"] = moment, context.group, made, read_keys.noted()
    return made
