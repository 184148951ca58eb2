"""Find the targets and poles that Motus has made along with chains, and delete those that nothing needs any more.

A control is a target or pole: (object, bone), with "" for the object itself.
"""

import itertools

import bpy

from ...core import wiring
from ...core.blender import needed
from ...core.declare import systems
from ..groups import goals
from . import control_bones
from .placing import CONTROL_KEY


def of_entries(rig, indices):
    """(object, bone or "") of the targets and poles that Motus has made for the entries at these indices of a rig, each once.

    Targets and poles that a different entry of any rig uses are left out.
    """
    entries = [rig.motus.ik.entries[index] for index in indices]
    pairs = dict.fromkeys(pair for entry in entries for pair in goals(entry) if _is_made(rig, *pair))
    others = {
        pair
        for one in _rigs()
        for index, entry in enumerate(one.motus.ik.entries)
        if one != rig or index not in indices
        for pair in goals(entry)
    }
    return [pair for pair in pairs if pair not in others]


def label(obj, bone):
    """Name of a control for the user: "object", or "object: bone"."""
    return f"{obj.name}: {bone}" if bone else obj.name


def remove_unneeded(context, rig, controls):
    """Delete controls that no entry uses any more, unless something else needs them.

    controls: list of (object, bone or ""). Returns the labels of the controls that stay.
    """
    in_use = [(obj, bone) for obj, bone in controls if (_is_bone_needed(obj, bone) if bone else needed.is_needed(obj))]
    kept = [label(*pair) for pair in in_use]
    bones = [bone for obj, bone in controls if bone and (obj, bone) not in in_use]
    if bones:
        control_bones.remove(context, rig, bones)
    for obj in [obj for obj, bone in controls if not bone and (obj, bone) not in in_use]:
        bpy.data.objects.remove(obj)
    return kept


def _is_made(rig, obj, bone):
    if bone:
        return obj == rig and not rig.data.library and not rig.data.override_library and control_bones.is_made(rig, bone)
    return CONTROL_KEY in obj


def _rigs():
    # Reading the property `motus` of an object that has no settings yet would create them.
    return [found for found in bpy.data.objects if found.type == 'ARMATURE' and found.is_property_set("motus")]


def _is_bone_needed(rig, bone):
    """Whether a child bone, a child object, a constraint, a driver or an entry of a Motus system uses a bone of the rig.

    All objects with the rig's armature are looked at, since they would lose the bone, too.
    """
    if rig.data.bones[bone].children:
        return True
    rigs = {obj for obj in bpy.data.objects if obj.data == rig.data}
    for obj in bpy.data.objects:
        if obj.parent in rigs and obj.parent_type == 'BONE' and obj.parent_bone == bone:
            return True
        things = [obj, *(obj.pose.bones if obj.pose else ())]
        constraints = itertools.chain.from_iterable(thing.constraints for thing in things)
        if any(one in rigs and name == bone for constraint in constraints for one, name in _constraint_targets(constraint)):
            return True
    path = f'pose.bones["{bpy.utils.escape_identifier(bone)}"]'
    for _, _, variable, index in wiring.targets_on(rigs):
        target = variable.targets[index]
        if target.bone_target == bone or target.data_path.startswith(path):
            return True
    pairs = {(one, bone) for one in rigs}
    return any(
        not pairs.isdisjoint(entry.reads) or (one in rigs and bone in entry.drives)
        for system in systems()
        if system.entries
        for one in _rigs()
        for entry in system.entries(one)
    )


def _constraint_targets(constraint):
    """(object or None, bone name) of each target of a constraint, and of its pole target."""
    listed = constraint.targets if constraint.type == 'ARMATURE' else [constraint]
    found = [(getattr(one, "target", None), getattr(one, "subtarget", "")) for one in listed]
    return found + [(getattr(constraint, "pole_target", None), getattr(constraint, "pole_subtarget", ""))]
