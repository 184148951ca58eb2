"""Sentences about the problems of a rig's chains, with the names of the bones or colliders concerned."""

from ..core.tracks.inputs import MISSING_BONES, NEEDS_RECORDING, NOT_KNOWN, Tails, of_unknown
from ..core.translations import tr
from . import groups, making, setup


def input_of(owner, name, scene):
    """Return the input (motion that is followed) of a chain of an original owner; None if the chain does not exist. name: of its topmost bone."""
    found = next((chain for chain in groups.chains(owner) if chain.entry.name == name), None)
    return found and Tails(found.bones, scene, setup.system())


def sentence(owner, problem, scene):
    """Return the sentence for the user about a Problem of an original owner, in the user's language."""
    entries = owner.motus.chains.entries
    if problem == MISSING_BONES:
        gone = next((entry.name for entry in entries if groups.is_missing(owner, entry)), "")
        return tr("{object} has no bone {bone}: remove it from the list").format(object=owner.name, bone=gone)
    if problem == making.BELOW_ANOTHER:
        name = next((entry.name for entry in entries if groups.is_below(owner, entry)), "")
        return tr("{bone} belongs to another chain, which moves it: remove it from the list").format(bone=name)
    for chain in groups.chains(owner) if problem in (NEEDS_RECORDING, NOT_KNOWN) else ():
        source = Tails(chain.bones, scene, setup.system())
        if not chain.entry.is_muted and not source.is_known and of_unknown(source) == problem:
            return source.sentence(chain.entry.name)
    return tr(problem.sentence)
