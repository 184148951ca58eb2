"""What the system offers others: the chains of a rig, and a way to add some. Found by declare.offered("ik")."""

from typing import Any, NamedTuple

from ..core.declare import has_settings, is_owner, of_owner
from ..core.file.pointers import pointed
from ..core.settings import entries
from . import groups
from .setup import system


class Chain(NamedTuple):
    """One chain of a rig. bones: the bones of the armature that it drives, from its end on. target_bone: "" for the target object itself."""

    bones: tuple
    target: Any
    target_bone: str
    is_muted: bool


class NewChain(NamedTuple):
    """A chain to be added, by the name of its last bone."""

    bone: str
    target: Any
    target_bone: str
    pole: Any
    pole_bone: str
    softness: float


def chains(rig):
    """The Chains of an original object by the names of their last bones; none if it is no rig with chains."""
    if not is_owner(system(), rig):
        return {}
    found = {}
    for entry in groups.entries(rig):
        settings = of_owner(system(), rig).entries[entry.name]
        found[entry.name] = Chain(_bones(rig, entry), pointed(settings, "target"), settings.target_bone, settings.is_muted)
    return found


def stretching_targets(rig):
    """(target object, name of its bone or "") of the chains that stretch all the way to their targets. rig: original or evaluated."""
    if not (has_settings(system(), rig) and is_owner(system(), rig)):
        return []
    found = [(pointed(entry, "target"), entry.target_bone) for entry in of_owner(system(), rig).entries if entry.stretch >= 1.0]
    return [(target, bone) for target, bone in found if target]


def add(rig, new):
    """Add NewChains to a rig."""
    with entries.at_once(system(), rig) as settings:
        for chain in new:
            entry = settings.entries.add()
            entry.name, entry.softness = chain.bone, chain.softness
            entry.target, entry.target_bone = chain.target, chain.target_bone
            entry.pole, entry.pole_bone = chain.pole, chain.pole_bone


def _bones(rig, entry):
    bone = rig.data.bones[entry.name]
    found = [bone]
    while bone.parent and bone.parent.name in entry.drives:
        bone = bone.parent
        found.append(bone)
    return tuple(one for one in found if one.name in entry.drives) or tuple(found)
