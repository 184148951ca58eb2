"""Results that the two solvers of a walker, one for its feet and one for its body, share within one evaluation by Blender."""

from ..core import keeping, wiring
from ..core.evaluated import copies, read_keys

_WAITING = keeping.OfEvaluation(
    "results that the first solver of a walker hands to its second solver: (moment, group, results, keys that were read)",
    "the walker's object",
    "one for each walker",
    until="the second solver has taken it",
)


def found(context, make):
    """Return the result of make(), which the first of a walker's two solvers calls; the second solver takes the kept result.

    The result is kept for one evaluation and one frame, on the evaluated copy of the owner (the object that walks).
    context: Context of the solver that asks. make: function without arguments.
    """
    copy = copies.of(context.owner)
    if copy is None:
        return make()
    moment = wiring.evaluation(), context.frame
    # The kept result is taken once: a solver that is called again by itself may be called because the input has changed.
    kept = _WAITING.on(copy)
    waiting = kept.pop("waiting", None)
    if waiting is not None and waiting[0] == moment and waiting[1] != context.group and read_keys.note(waiting[3]):
        return waiting[2]
    made = make()
    kept["waiting"] = moment, context.group, made, read_keys.noted()
    return made
