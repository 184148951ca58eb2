"""Add, change and remove the entries of heads: functions that the operators of Look At call, and that need no window."""

from ..core.declare import registered
from ..core.file.choices import chosen
from ..core.file.pointers import pointed
from ..core.settings import entries, entry_keys, lists, targets
from . import anatomy, facing

DISTANCE = 6.0  # from the head to a new target, in lengths of the head bone
TARGET_SIZE = 0.35  # display size of a new target, in lengths of the head bone
UNMOVED = 1e-4  # in lengths of the head bone: a target this near to the place at which it was made counts as not moved
MADE_KEY = "motus_look_at_target"
"""Custom property that marks the empties that Motus has made as targets of heads."""


def system():
    """The registered System of Look At.

    It is looked up by name: the package's __init__, which defines it, imports this module, so this module cannot import it.
    """
    return registered["look_at"]


def add(rig, head, changes, eyes, new_target=None):
    """Set up Look At on the bone named `head`, or change its settings. Returns the entry of the head.

    changes: {name: value} of the entry's settings. eyes: names of the eye bones; None keeps the present eyes.
    new_target(rig, entry): makes a target if the entry has none; None leaves the entry without a target.
    """
    present = rig.motus.look_at.entries.get(head)
    rows = [{"name": eye} for eye in eyes or ()]
    if present and eyes is not None:
        rows = lists.library_first(present.eyes, rows, lists.same_name)
        lists.check_replaceable(present.eyes, rows, lists.same_name)
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries.get(head) or lists.add(settings.entries, head)
        for name, value in changes.items():
            setattr(entry, name, value)
        if new_target and pointed(entry, "target") is None:
            entry.target = new_target(rig, entry)
        if eyes is not None:
            lists.replace(entry.eyes, rows, is_same=lists.same_name)
        settings.active_entry = settings.entries.find(head)
    return rig.motus.look_at.entries[head]


def remove(rig, index):
    """Remove a head's entry by its index, and delete the target that Motus made for it if nothing else needs that target."""
    target = pointed(rig.motus.look_at.entries[index], "target")
    entries.remove(system(), rig, [index], "active_entry")
    remove_unneeded(target)


def add_target(rig, entry, target, bone):
    """Give an entry a further target: an object, or None, which the user replaces in the list, and its bone or ""."""
    with entries.at_once(system(), rig):
        extra = lists.add_numbered(entry.extra_targets, "Target")
        extra.object, extra.bone = target, bone
        entry.active_extra_target = len(entry.extra_targets) - 1


def remove_target(rig, place, index):
    """Remove the further target at an index, with keys and drivers of its weight, from the entry at a place in the list of heads."""
    lists.check_own(rig.motus.look_at.entries[place].extra_targets, [index])
    with entries.at_once(system(), rig) as settings:
        entry = settings.entries[place]
        for prefix in entry_keys.prefixes("motus.look_at.entries", settings.entries, place):
            entry_keys.forget(rig, f"{prefix}extra_targets", entry.extra_targets, index)
        lists.remove(entry.extra_targets, index)
        entry.active_extra_target = max(0, min(entry.active_extra_target, len(entry.extra_targets) - 1))


def add_lids(rig, entry, lids):
    """Let bones shut as eyelids of a head, by the names in `lids`, each by the turn that shuts its eye; the head blinks then."""
    with entries.at_once(system(), rig):
        for name in lids:
            lists.add(entry.lids, name).angle = anatomy.lid_angle(rig, entry, name)
        entry.use_blinks = True


def remove_lid(rig, entry, name):
    """Leave the eyelid of a name to its own animation again."""
    with entries.at_once(system(), rig):
        lists.remove(entry.lids, entry.lids.find(name))


def remove_unneeded(target):
    """Delete a target that Motus has made if nothing uses the object, and it has no animation data. target: an object or None."""
    targets.remove_unneeded(target, MADE_KEY)


def turn(rig, entry):
    """Turn the forward axis of a head's entry by a quarter about its up axis, counter-clockwise as seen from above.

    A target that Motus has made, and that still stands at the place at which it was made, moves along, so that no bone turns.
    """
    place, size = _in_front(rig, entry)
    target = pointed(entry, "target")
    goes_along = target and MADE_KEY in target and target.parent is None and (target.location - place).length < UNMOVED * size
    entry.forward = facing.turned(chosen(entry, "forward"), chosen(entry, "up"))
    if goes_along:
        target.location, _ = _in_front(rig, entry)


def _in_front(rig, entry):
    """(world position at which a new target lies straight ahead of the posed head, length of the head bone in world units)."""
    bone = rig.pose.bones[entry.name]
    pose = rig.matrix_world @ bone.matrix
    size = pose.to_3x3().col[1].length * bone.bone.length
    return pose.translation + DISTANCE * size * (pose.to_3x3() @ anatomy.head_forward(rig, entry)).normalized(), size


def new_target(context, rig, entry):
    """Make an empty straight ahead of the posed head, so that nothing turns until the empty is moved. Returns the empty."""
    place, size = _in_front(rig, entry)
    empty = targets.new_empty(context, rig, f"{rig.name} {entry.name} Target", MADE_KEY)
    empty.empty_display_type = 'SPHERE'
    empty.empty_display_size = TARGET_SIZE * size
    empty.location = place
    return empty
