"""What is wired on a rig: the bones that layers may move, and which of them are solved together."""

import json

from ..core import rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.wiring import driven_bones
from . import mask

PLAN = "plan"
"""Key of a group's data: a JSON object that solve.Wired is made of."""
LOOPED = "looped"
"""Key of a group's data: how many bones are left out, because their drivers read what layers move."""
ALL_KEYED = "\n"
"""Name of the entry of all bones whose own channels nothing drives; the others have one each."""
CHANNELS = frozenset({"location", "rotation", "scale"})
CONNECTED = frozenset({"rotation", "scale"})


def masked(owner):
    """Names of the bones in the masks of the layers, in the order of the rig."""
    entries = owner.motus.layers.entries
    if not entries or owner.pose is None:
        return []
    found = {name for entry in entries for name in mask.names(owner, entry)}
    return [name for name in owner.pose.bones.keys() if name in found]


def entries(owner):
    """For the order of evaluation: bones whose own channels are driven wait for their drivers."""
    driven = driven_bones(owner)
    found = masked(owner)
    plain = tuple(name for name in found if name not in driven)
    return ([Entry(ALL_KEYED, (), plain)] if plain else []) + [Entry(name, (), (name,)) for name in found if name in driven]


def groups(owner):
    """One group for the bones of each level."""
    driven, levels = driven_bones(owner), wiring.levels(owner)
    by_level, looped = {0: []}, 0
    found = masked(owner)
    for name in found:
        level = levels.get(("layers", name if name in driven else ALL_KEYED))
        if level is None:
            looped += 1
        else:
            by_level.setdefault(level, []).append(name)
    # The first group is there even without a bone, to say what is wrong.
    return tuple(_group(owner, str(level) if level else "", names, driven, looped) for level, names in sorted(by_level.items()))


def members(owner):
    """All bones that layers may move."""
    return [member.thing for group in groups(owner) for member in group.members]


def channels_of(bone):
    """What layers move of a PoseBone: keys do not move one that is connected to its parent."""
    return CONNECTED if bone.bone.use_connect and bone.parent else CHANNELS


def bone_renamed(owner, rig, old, new):
    """Let the masks follow a bone that was given another name."""
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
    """What solve.Wired is made of, as text. names: of the bones that are solved; driven: of all whose own channels are driven."""
    # Where drivers put a bone of another group is not known yet.
    unknown = sorted(driven.difference(names))
    return json.dumps({"fingerprint": rigs.fingerprint(owner), "bones": names, "unknown": unknown})
