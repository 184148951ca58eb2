"""Sentences about the problems of an object's dynamics, with the names of the bones or properties concerned."""

from ..core.translations import tr
from . import groups, setup, solve


def sentence(owner, problem, scene):
    """Return the sentence for the user about a Problem of an original owner, in the user's language."""
    if problem == solve.MISSING_BONES:
        gone = next((entry.name for entry in owner.motus.dynamics.entries if groups.is_missing(owner, entry)), "")
        return tr("{object} has no bone {bone}: remove it from the list").format(object=owner.name, bone=gone)
    spoken = {
        solve.NEEDS_RECORDING: lambda: tr("What {thing} follows needs recording: {reason}"),
        solve.NOT_KNOWN: lambda: tr("What {thing} follows is not known on other frames: {reason}"),
    }.get(problem)
    for unit in groups.units(owner) if spoken else ():
        entry = next((one for one in unit.entries if not one.is_muted), None)
        if entry is None:
            continue
        source = unit.input(scene)
        if not source.is_known and bool(source.reason) == (problem == solve.NOT_KNOWN):
            reason = source.reason or next(track.reason for track, _ in source.unknown if not track.is_known)
            return spoken().format(thing=setup.label(entry), reason=reason.sentence)  # type: ignore[misc]
    return tr(problem.sentence)
