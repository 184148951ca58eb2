"""What is wired on a rig: its heads, the bones they turn, and which of them are solved together."""

import json

from ..core import rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.measures import axes
from . import anatomy

OUTPUTS = ("angle", "reason", "yaw", "pitch")
"""What is told of each head: "<bone>.<output>"."""
PLAN = "plan"
"""Key of a group's data: a JSON object that solve.Wired is made of."""
LOOPED = "looped"
"""Key of a group's data: how many heads are left out, because their targets move with them."""
ROTATION = frozenset({"rotation"})


def driven_bones(owner, entry):
    """Names of the bones that an entry turns, in the order of LookAtPlan.rows; empty where the rig has no such head."""
    if entry.name not in owner.data.bones:
        return []
    return [*anatomy.below(owner, entry.name, entry.body_length), entry.name, *_eyes(owner, entry)]


def entries(owner):
    """For the order of evaluation: what each head reads and drives."""
    return [Entry(entry.name, tuple(_reads(owner, entry, bones)), tuple(bones)) for entry, bones in present(owner)]


def groups(owner):
    """One group for the heads of each level: they are solved by one call."""
    levels = wiring.levels(owner)
    by_level, looped = {0: []}, 0
    for entry, bones in present(owner):
        level = levels.get(("look_at", entry.name))
        if level is None:
            looped += 1
        else:
            by_level.setdefault(level, []).append((entry, bones))
    # The first group is there even without a head, to say what is wrong.
    return tuple(_group(owner, str(level) if level else "", found, looped) for level, found in sorted(by_level.items()))


def members(owner):
    """All bones of a rig that its heads turn: spines, heads and eyes."""
    return [member.thing for group in groups(owner) for member in group.members]


def bone_renamed(owner, rig, old, new):
    """Let the entries follow a bone that was given another name."""
    for entry in owner.motus.look_at.entries:
        for item in (entry, *entry.eyes):
            if rig == owner and item.name == old:
                item.name = new
        if pointed(entry, "target") == rig and entry.target_bone == old:
            entry.target_bone = new


def shared_bone(owner, entry):
    """A bone that the entry would turn and an earlier one turns already; "" without."""
    return next((name for name in driven_bones(owner, entry) if name in _taken_before(owner, entry)), "")


def present(owner):
    """(entry, its bones) of all entries whose head the rig has, and whose bones no entry before them turns."""
    found, taken = [], set()
    for entry in owner.motus.look_at.entries:
        bones = driven_bones(owner, entry)
        if bones and taken.isdisjoint(bones):
            found.append((entry, bones))
            taken.update(bones)
    return found


def _taken_before(owner, entry):
    return {name for other, bones in present(owner) if other != entry for name in bones}


def _eyes(owner, entry):
    below = {bone.name for bone in owner.data.bones[entry.name].children_recursive}
    return [eye.name for eye in entry.eyes if eye.name in below]


def _reads(owner, entry, bones):
    """(object, bone or "") that a head needs to stand before it can look."""
    lowest = owner.data.bones[bones[0]].parent
    reads = [(owner, lowest.name if lowest else "")]
    target = pointed(entry, "target")
    if target:
        has_bone = target.pose and entry.target_bone in target.pose.bones
        reads.append((target, entry.target_bone if has_bone else ""))
    return reads


def _group(owner, key, found, looped):
    reads = [(owner, "")] + [pair for entry, bones in found for pair in _reads(owner, entry, bones)]
    own = [name for entry, bones in found for name in read_bones(owner, entry, bones)]
    return Group(
        key=key,
        members=tuple(Member(owner.pose.bones[name], ROTATION, 'LOCAL', is_relative=True) for _, bones in found for name in bones),
        inputs=(*(Transform(*pair) for pair in dict.fromkeys(reads)), *(BonesOwn(owner, name) for name in dict.fromkeys(own))),
        outputs=tuple(f"{entry.name}.{name}" for entry, _ in found for name in OUTPUTS),
        data={PLAN: plan_of(owner, found), LOOPED: looped},
    )


def plan_of(owner, found):
    """What solve.Wired is made of, as text. found: entries with their bones."""
    heads = [
        {
            "name": entry.name,
            "body": bones[: bones.index(entry.name)],
            "eyes": bones[bones.index(entry.name) + 1 :],
            "head_forward": list(anatomy.head_forward(owner, entry)),
            "eyes_forward": [list(axis) for axis in anatomy.eyes_forward(owner, entry, bones[bones.index(entry.name) + 1 :])],
            "up": list(axes.vector(chosen(entry, "up"))),
        }
        for entry, bones in found
    ]
    return json.dumps({"fingerprint": rigs.fingerprint(owner), "heads": heads})


def read_bones(owner, entry, bones):
    """Names of the bones whose own transforms an entry reads: those that it turns, and those from the head to its eyes."""
    return (*bones, *_between(owner, entry))


def _between(owner, entry):
    """Bones from the head to its eyes, which stand still against the head but for their animation."""
    bones = owner.data.bones
    names = [bone.name for eye in _eyes(owner, entry) for bone in bones[eye].parent_recursive]
    above = {bone.name for bone in bones[entry.name].children_recursive}
    return [name for name in names if name in above]
