"""Sentences about the problems of an object's dynamics, with the names of the bones or properties concerned."""

from ..core.tracks.inputs import MISSING_BONES, NEEDS_RECORDING, NOT_KNOWN, of_unknown
from ..core.translations import tr
from . import groups, setup


def sentence(owner, problem, scene):
    """Return the sentence for the user about a Problem of an original owner, in the user's language."""
    if problem == MISSING_BONES:
        gone = next((entry.name for entry in owner.motus.dynamics.entries if groups.is_missing(owner, entry)), "")
        return tr("{object} has no bone {bone}: remove it from the list").format(object=owner.name, bone=gone)
    for unit in groups.units(owner) if problem in (NEEDS_RECORDING, NOT_KNOWN) else ():
        entry = next((one for one in unit.entries if not one.is_muted), None)
        if entry is None:
            continue
        source = unit.input(scene)
        if not source.is_known and of_unknown(source) == problem:
            return source.sentence(setup.label(entry))
    return tr(problem.sentence)
