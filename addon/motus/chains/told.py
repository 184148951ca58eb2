"""Sentences about the problems of a rig's chains, with the names of the bones or colliders concerned."""

from ..core.tracks.inputs import NEEDS_RECORDING, NOT_KNOWN, of_unknown
from ..core.translations import tr
from . import groups, making, squash
from .of_bones import Bones


def input_of(owner, name, scene):
    """Return the input (motion that is followed) of a chain of an original owner; None if the chain does not exist. name: of its entry."""
    found = next((chain for chain in groups.chains(owner) if chain.entry.name == name), None)
    return found and found.source(scene)


def sentence(owner, problem, scene):
    """Return the sentence for the user about a Problem of an original owner, in the user's language."""
    entries = owner.motus.chains.entries
    gone = next((entry for entry in entries if groups.is_missing(owner, entry)), None) if problem == making.THINGS_MISSING else None
    if gone and gone.spline >= 0:
        return tr("{object} has no spline {number} with two points and more: remove {chain} from the list").format(
            object=owner.name, number=gone.spline + 1, chain=gone.name
        )
    if gone and not gone.links:
        return tr("{object} has no bone {bone}: remove it from the list").format(object=owner.name, bone=gone.name)
    if problem == making.KEEPS_LENGTHS:
        bones = [bone for chain in groups.chains(owner) if isinstance(chain, Bones) and chain.entry.squash > 0.0 for bone in chain.things]
        bone, child = next((bone, child) for bone in bones for child in [squash.first_inheriting(bone)] if child)
        return tr("{bone} keeps its length, since {child} inherits its scale: set Inherit Scale of {child} to None").format(
            bone=bone.name, child=child.name
        )
    for chain in groups.chains(owner) if problem in (NEEDS_RECORDING, NOT_KNOWN) else ():
        source = chain.source(scene)
        if not chain.entry.is_muted and not source.is_known and of_unknown(source) == problem:
            return source.sentence(chain.entry.name)
    return tr(problem.sentence)
