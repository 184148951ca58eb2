"""Declare the bones of a rig that layers may move, in groups that are solved together."""

import json

from ..core import rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.wiring import driven_bones
from . import mask

PLAN = "plan"
"""Key of a group's data: JSON text with the group's bones, from which solve.Wired is made."""
LOOPED = "looped"
"""Key of a group's data: number of bones that are left out, because their drivers depend on bones that layers move."""
ALL_KEYED = "\n"
"""Name of the Entry with all bones whose own channels have no drivers. Each bone with drivers has an Entry with its own name."""
CHANNELS = frozenset({"location", "rotation", "scale"})
CONNECTED = frozenset({"rotation", "scale"})


def masked(owner):
    """List the names of the bones that layers may move, in the order of the rig's pose: those in masks, all while a layer is edited."""
    entries = owner.motus.layers.entries
    if not entries or owner.pose is None:
        return []
    if any(entry.is_edited for entry in entries):
        return owner.pose.bones.keys()  # the action that is edited may animate bones outside of the mask too
    found = {name for entry in entries for name in mask.names(owner, entry)}
    return [name for name in owner.pose.bones.keys() if name in found]


def entries(owner):
    """List the Entries from which the order of evaluation is found: one for all bones without drivers, one for each bone with drivers.

    Bones with drivers on their own channels are evaluated after these drivers.
    """
    driven = driven_bones(owner)
    found = masked(owner)
    plain = tuple(name for name in found if name not in driven)
    return ([Entry(ALL_KEYED, (), plain)] if plain else []) + [Entry(name, (), (name,)) for name in found if name in driven]


def groups(owner):
    """Return the Groups of a rig: one for the bones of each level. Bones of one level do not wait for each other."""
    driven, levels = driven_bones(owner), wiring.levels(owner)
    by_level, looped = {0: []}, 0
    found = masked(owner)
    for name in found:
        level = levels.get(("layers", name if name in driven else ALL_KEYED))
        if level is None:
            looped += 1
        else:
            by_level.setdefault(level, []).append(name)
    # The first group exists even if it has no bones, because it reports problems.
    return tuple(_group(owner, str(level) if level else "", names, driven, looped) for level, names in sorted(by_level.items()))


def members(owner):
    """List all PoseBones of a rig that layers may move."""
    return [member.thing for group in groups(owner) for member in group.members]


def channels_of(bone):
    """Return the channels of a PoseBone that layers change: without "location" if the bone is connected to its parent."""
    return CONNECTED if bone.bone.use_connect and bone.parent else CHANNELS


def bone_renamed(owner, rig, old, new):
    """Rename a bone in the masks of the owner's layers after the user has renamed the bone.

    rig: armature object of the bone. old, new: names of the bone.
    """
    for entry in owner.motus.layers.entries if rig == owner else ():
        for item in entry.mask:
            if item.kind == 'BONE' and item.name == old:
                item.name = new


def _group(owner, key, names, driven, looped):
    bones = owner.pose.bones
    return Group(
        key=key,
        members=tuple(Member(bones[name], channels_of(bones[name]), 'LOCAL', is_relative=True) for name in names),
        inputs=(Transform(owner), *(BonesOwn(owner, name) for name in names if name in driven)),
        data={PLAN: plan_of(owner, names, driven), LOOPED: looped},
    )


def plan_of(owner, names, driven):
    """Return the JSON text from which solve.Wired is made.

    names: of the bones that are solved together. driven: names of all bones with drivers on their own channels.
    """
    # The transforms of driven bones of a different group are not known yet when this group is solved.
    unknown = sorted(driven.difference(names))
    return json.dumps({"fingerprint": rigs.fingerprint(owner), "bones": names, "unknown": unknown})
