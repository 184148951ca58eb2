"""Declare what Motus wires on a rig for Look At: groups of heads that are solved together, their bones, inputs and outputs.

The owner is the armature object. An entry holds the settings of one head.
"""

import json
import math

import bpy

from ..core import rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Property, Transform
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.measures import axes
from . import anatomy

OUTPUTS = ("angle", "reason", "yaw", "pitch")
"""Numbers that the solver reports for each head; as an output of its group, each is named "<head bone>.<name>"."""
BLINK = "blink"
"""Output of a head that blinks: how far its eyes are shut, 0 to 1."""
PLAN = "plan"
"""Key in a group's data of the JSON text from which solve.Wired is made."""
LOOPED = "looped"
"""Key in a group's data of the number of heads that are left out because their targets move with them."""
ROTATION = frozenset({"rotation"})


def driven_bones(owner, entry):
    """Names of the bones that an entry turns, in the order of LookAtPlan.rows: spine, head, eyes; empty if the head bone is missing."""
    if entry.name not in owner.data.bones:
        return []
    return [*anatomy.below(owner, entry.name, entry.body_length), entry.name, *_eyes(owner, entry)]


def entries(owner):
    """List of an Entry (core/declare) for each head of an owner: what it reads and turns, from which the order of evaluation follows."""
    found = present(owner)
    lids = lids_of(owner, found)
    return [Entry(entry.name, tuple(_reads(owner, entry, bones)), (*bones, *lids[entry.name])) for entry, bones in found]


def has_blinks(settings):
    """Whether a head blinks along with turns of its gaze: then its solver reads keys of other frames."""
    return any(entry.use_blinks and entry.blink_angle < math.pi for entry in settings.entries)


def groups(owner):
    """Groups of the owner's heads, one for each level of wiring.levels(); the heads of a group are solved by one native call.

    Of what Motus drives on rigs, a head reads only what entries of lower levels drive. Heads whose targets move with them are left out.
    """
    levels = wiring.levels(owner)
    by_level, looped, every = {0: []}, 0, present(owner)
    lids = lids_of(owner, every)
    for entry, bones in every:
        level = levels.get(("look_at", entry.name))
        if level is None:
            looped += 1
        else:
            by_level.setdefault(level, []).append((entry, bones))
    # The first group exists even if it has no heads, so that its solver can report the heads that are left out.
    return tuple(_group(owner, str(level) if level else "", found, lids, looped) for level, found in sorted(by_level.items()))


def members(owner):
    """All pose bones of a rig that its heads' entries turn: spines, heads and eyes."""
    return [member.thing for group in groups(owner) for member in group.members]


def bone_renamed(owner, rig, old, new):
    """Replace the old name of a renamed bone by the new name in the owner's entries. rig: the armature object that has the bone."""
    for entry in owner.motus.look_at.entries:
        for item in (entry, *entry.eyes, *entry.lids):
            if rig == owner and item.name == old:
                item.name = new
        if pointed(entry, "target") == rig and entry.target_bone == old:
            entry.target_bone = new
        for extra in entry.extra_targets:
            if pointed(extra, "object") == rig and extra.bone == old:
                extra.bone = new


def shared_bone(owner, entry):
    """Name of a bone of an entry that a different entry turns already; "" if there is none."""
    return next((name for name in driven_bones(owner, entry) if name in _taken_before(owner, entry)), "")


def present(owner):
    """(entry, names of the bones that it turns) of all entries that are solved.

    An entry is left out if the rig does not have its head bone, or if an earlier entry turns one of its bones.
    """
    found, taken = [], set()
    for entry in owner.motus.look_at.entries:
        bones = driven_bones(owner, entry)
        if bones and taken.isdisjoint(bones):
            found.append((entry, bones))
            taken.update(bones)
    return found


def lids_of(owner, found):
    """{name of a head: [names of the eyelid bones that its blinks turn]}. found: result of present().

    A lid is left out if the rig does not have it below the head, or if a head turns the bone anyway.
    """
    taken, lids = {name for _, bones in found for name in bones}, {}
    for entry, _ in found:
        below = {bone.name for bone in owner.data.bones[entry.name].children_recursive} if entry.use_blinks else ()
        lids[entry.name] = [lid.name for lid in entry.lids if lid.name in below and lid.name not in taken]
        taken.update(lids[entry.name])
    return lids


def _taken_before(owner, entry):
    return {name for other, bones in present(owner) if other != entry for name in bones}


def _eyes(owner, entry):
    below = {bone.name for bone in owner.data.bones[entry.name].children_recursive}
    return [eye.name for eye in entry.eyes if eye.name in below]


def goals(entry):
    """(object or None, bone or "") of each target of an entry: of its target, then of its further targets."""
    return [(pointed(entry, "target"), entry.target_bone), *((pointed(extra, "object"), extra.bone) for extra in entry.extra_targets)]


def weights(entry):
    """Weights of an entry's targets, in the order of goals()."""
    return [entry.target_weight, *(extra.weight for extra in entry.extra_targets)]


def _reads(owner, entry, bones):
    """(object, bone or "") whose evaluated transforms a head's solver reads: the parent of the lowest turned bone, and the targets."""
    lowest = owner.data.bones[bones[0]].parent
    reads = [(owner, lowest.name if lowest else "")]
    for target, bone in goals(entry):
        if target:
            has_bone = target.pose and bone in target.pose.bones
            reads.append((target, bone if has_bone else ""))
    return reads


def _group(owner, key, found, lids, looped):
    reads = [(owner, "")] + [pair for entry, bones in found for pair in _reads(owner, entry, bones)]
    own = [name for entry, bones in found for name in read_bones(owner, entry, bones)]
    blinking = [entry for entry, _ in found if entry.use_blinks]
    turned = [name for _, bones in found for name in bones] + [name for entry in blinking for name in lids[entry.name]]
    return Group(
        key=key,
        members=tuple(Member(owner.pose.bones[name], ROTATION, 'LOCAL', is_relative=True) for name in turned),
        inputs=(*(Transform(*pair) for pair in dict.fromkeys(reads)), *(BonesOwn(owner, name) for name in dict.fromkeys(own))),
        outputs=(
            *(f"{entry.name}.{name}" for entry, _ in found for name in OUTPUTS),
            *(f"{entry.name}.{BLINK}" for entry in blinking),
        ),
        properties=tuple(found for entry in blinking for found in _shut_by(entry)),
        data={PLAN: plan_of(owner, found, lids), LOOPED: looped},
    )


def _shut_by(entry):
    """Yield the Property of the shape key that a head's blinks drive, if there is one."""
    face = pointed(entry, "shut_object")
    keys = face and getattr(face.data, "shape_keys", None)
    if keys and entry.shut_key in keys.key_blocks:
        name = bpy.utils.escape_identifier(entry.shut_key)
        yield Property(f"{entry.name}.{BLINK}", face, f'data.shape_keys.key_blocks["{name}"].value')


def plan_of(owner, found, lids):
    """JSON text that describes a group of heads, from which solve.Wired is made. found: pairs of an entry and its bones' names.

    lids: {name of a head: [names of its eyelids]}.
    """
    heads = [
        {
            "name": entry.name,
            "body": bones[: bones.index(entry.name)],
            "eyes": bones[bones.index(entry.name) + 1 :],
            "head_forward": list(anatomy.head_forward(owner, entry)),
            "eyes_forward": [list(axis) for axis in anatomy.eyes_forward(owner, entry, bones[bones.index(entry.name) + 1 :])],
            "up": list(axes.vector(chosen(entry, "up"))),
            **({"saccades": [entry.saccade_rate, entry.eyes_seed]} if entry.use_saccades else {}),
            **({"blinks": _blinks(entry, lids[entry.name])} if entry.use_blinks else {}),
        }
        for entry, bones in found
    ]
    return json.dumps({"fingerprint": rigs.fingerprint(owner), "heads": heads})


def _blinks(entry, lids):
    angles = {lid.name: lid.angle for lid in entry.lids}
    return {
        "rate": entry.blink_rate / 60.0,
        "seed": entry.eyes_seed,
        "angle": entry.blink_angle,
        "lids": [angles[name] for name in lids],
    }


def read_bones(owner, entry, bones):
    """Names of bones whose own transforms (matrix_basis) an entry's solver reads: turned bones, and bones between the head and its eyes."""
    return (*bones, *_between(owner, entry))


def _between(owner, entry):
    """Names of the bones between a head and its eyes. Relative to the head, only their own animation moves these bones."""
    bones = owner.data.bones
    names = [bone.name for eye in _eyes(owner, entry) for bone in bones[eye].parent_recursive]
    above = {bone.name for bone in bones[entry.name].children_recursive}
    return [name for name in names if name in above]
