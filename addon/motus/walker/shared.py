"""Results that a walker's two solvers (feet and body) share within one evaluation."""

from ..core import wiring
from ..core.evaluated import copies, read_keys

KEY = "walker shared"
"""Of Copy.found: (moment, group, what was found, which keys were read)."""


def found(context, make):
    """The result of make(), made by the first of an owner's two solvers and kept for the second one."""
    copy = copies.of(context.owner)
    if copy is None:
        return make()
    moment = wiring.evaluation(), context.frame
    # Taken by one alone: who is solved again by itself may be so because the rest has changed.
    waiting = copy.found.pop(KEY, None)
    if waiting is not None and waiting[0] == moment and waiting[1] != context.group and read_keys.note(waiting[3]):
        return waiting[2]
    made = make()
    copy.found[KEY] = moment, context.group, made, read_keys.noted()
    return made
