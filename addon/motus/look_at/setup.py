"""Setting heads up and taking them back: plain functions behind the operators."""

import bpy

from ..core import entries, libraries, needed
from ..core.system import registered

DISTANCE = 6.0  # of the head bone's length: where a target is made
TARGET_SIZE = 0.35  # of the head bone's length


MADE_KEY = "motus_look_at_target"
"""Custom property of the empties that are made along with an entry."""


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["look_at"]


def add(rig, head, changes, eyes):
    """Let the bone look. changes: settings of its entry by name; eyes: names, None keeps those it has."""
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries.get(head)
        if entry is None:
            entry = settings.entries.add()
            entry.name = head
        for name, value in changes.items():
            setattr(entry, name, value)
        if eyes is not None:
            entry.eyes.clear()
            for eye in eyes:
                entry.eyes.add().name = eye
        settings.active_entry = settings.entries.find(head)


def remove(rig, index):
    """Take one head back, with the target that was made along with it."""
    target = rig.motus.look_at.entries[index].target
    entries.remove(system(), rig, [index], "active_entry")
    remove_unneeded(target)


def remove_unneeded(target):
    """Delete a target that was made here, if nothing else needs it and nobody has animated it. target: an object or None."""
    if target and MADE_KEY in target and target.animation_data is None and not needed.is_needed(target):
        bpy.data.objects.remove(target)


def new_target(context, rig, head, forward):
    """An empty in front of the head as it stands now, so that nothing turns before the empty is moved."""
    bone = rig.pose.bones[head]
    pose = rig.matrix_world @ bone.matrix
    along = pose.to_3x3() @ forward
    size = (pose.to_3x3().col[1]).length * bone.bone.length
    empty = bpy.data.objects.new(f"{rig.name} {head} Target", None)
    empty[MADE_KEY] = True
    empty.empty_display_type = 'SPHERE'
    empty.empty_display_size = TARGET_SIZE * size
    empty.location = pose.translation + DISTANCE * size * along.normalized()
    libraries.collection_for(context, rig).objects.link(empty)
    return empty
