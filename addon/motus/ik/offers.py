"""Functions of inverse kinematics that different systems call by declare.offered("ik"): list the chains of a rig, and add chains."""

from typing import Any, NamedTuple

from ..core.declare import has_settings, is_owner, of_owner
from ..core.file.pointers import pointed
from ..core.settings import entries, lists
from . import groups
from .setup import system


class Chain(NamedTuple):
    """One chain of a rig.

    bones: the armature's Bones that the chain drives, from its end to its root. target: Object, or None if none is chosen.
    target_bone: name of the target's bone, "" for the object itself.
    """

    bones: tuple
    target: Any
    target_bone: str
    is_muted: bool


class NewChain(NamedTuple):
    """Settings of a chain that is to be added.

    bone: name of its last bone. target, pole: Object or None. target_bone, pole_bone: name of a bone, "" for the object itself.
    """

    bone: str
    target: Any
    target_bone: str
    pole: Any
    pole_bone: str
    softness: float


def chains(rig):
    """{name of the last bone: Chain} of all chains of an original object; empty if it is no rig with chains."""
    if not is_owner(system(), rig):
        return {}
    found = {}
    for entry in groups.entries(rig):
        settings = of_owner(system(), rig).entries[entry.name]
        found[entry.name] = Chain(_bones(rig, entry), pointed(settings, "target"), settings.target_bone, settings.is_muted)
    return found


def stretching_targets(rig):
    """(target object, name of its bone or "") of the chains of a rig, original or evaluated, whose Stretch is 1: they reach any target."""
    if not (has_settings(system(), rig) and is_owner(system(), rig)):
        return []
    found = [(pointed(entry, "target"), entry.target_bone) for entry in of_owner(system(), rig).entries if entry.stretch >= 1.0]
    return [(target, bone) for target, bone in found if target]


def add(rig, new):
    """Add chains to a rig, and wire it once. new: list of NewChain."""
    with entries.at_once(system(), rig) as settings:
        for chain in new:
            entry = lists.add(settings.entries, chain.bone)
            entry.softness = chain.softness
            entry.target, entry.target_bone = chain.target, chain.target_bone
            entry.pole, entry.pole_bone = chain.pole, chain.pole_bone


def _bones(rig, entry):
    bone = rig.data.bones[entry.name]
    found = [bone]
    while bone.parent and bone.parent.name in entry.drives:
        bone = bone.parent
        found.append(bone)
    return tuple(one for one in found if one.name in entry.drives) or tuple(found)
