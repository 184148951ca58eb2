"""Setting heads up and taking them back: plain functions behind the operators."""

import bpy

from ..core.blender import needed
from ..core.declare import registered
from ..core.file import libraries
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.settings import entries
from . import anatomy, facing

DISTANCE = 6.0  # of the head bone's length: where a target is made
TARGET_SIZE = 0.35  # of the head bone's length
UNMOVED = 1e-4  # of the same: so near to where it was made a target stands there still
MADE_KEY = "motus_look_at_target"
"""Custom property of the empties that are made along with an entry."""


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["look_at"]


def add(rig, head, changes, eyes, new_target=None):
    """Let the bone look; gives its entry.

    changes: settings of its entry by name. eyes: names, None keeps those it has. new_target(rig, entry): makes a target where there
    is none.
    """
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries.get(head)
        if entry is None:
            entry = settings.entries.add()
            entry.name = head
        for name, value in changes.items():
            setattr(entry, name, value)
        if new_target and pointed(entry, "target") is None:
            entry.target = new_target(rig, entry)
        if eyes is not None:
            entry.eyes.clear()
            for eye in eyes:
                entry.eyes.add().name = eye
        settings.active_entry = settings.entries.find(head)
    return rig.motus.look_at.entries[head]


def remove(rig, index):
    """Take one head back, with the target that was made along with it."""
    target = pointed(rig.motus.look_at.entries[index], "target")
    entries.remove(system(), rig, [index], "active_entry")
    remove_unneeded(target)


def remove_unneeded(target):
    """Delete a target that was made here, if nothing else needs it and nobody has animated it. target: an object or None."""
    if target and MADE_KEY in target and target.animation_data is None and not needed.is_needed(target):
        bpy.data.objects.remove(target)


def turn(rig, entry):
    """Let the character face a quarter further about its up axis. A target that stands where it was made goes along, so that nothing turns."""
    place, size = _in_front(rig, entry)
    target = pointed(entry, "target")
    goes_along = target and MADE_KEY in target and target.parent is None and (target.location - place).length < UNMOVED * size
    entry.forward = facing.turned(chosen(entry, "forward"), chosen(entry, "up"))
    if goes_along:
        target.location, _ = _in_front(rig, entry)


def _in_front(rig, entry):
    """(place in the world of a target that a head looks at as it is posed, length of the head bone in the world)."""
    bone = rig.pose.bones[entry.name]
    pose = rig.matrix_world @ bone.matrix
    size = pose.to_3x3().col[1].length * bone.bone.length
    return pose.translation + DISTANCE * size * (pose.to_3x3() @ anatomy.head_forward(rig, entry)).normalized(), size


def new_target(context, rig, entry):
    """An empty in front of the head as it stands now, so that nothing turns before the empty is moved."""
    place, size = _in_front(rig, entry)
    empty = bpy.data.objects.new(f"{rig.name} {entry.name} Target", None)
    empty[MADE_KEY] = True
    empty.empty_display_type = 'SPHERE'
    empty.empty_display_size = TARGET_SIZE * size
    empty.location = place
    libraries.collection_for(context, rig).objects.link(empty)
    return empty
