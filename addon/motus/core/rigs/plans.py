"""Plans that are made once from what is wired on a rig and used for many frames."""

import zlib
from collections import OrderedDict
from typing import Any, NamedTuple

from ..evaluated import copies
from ..evaluated.per_thread import kept
from ..file.stored import Damaged
from .arrays import inheritance, is_still, names_of, still

LARGEST_CACHE = 64


def fingerprint(rig):
    """A number that changes when a bone is given another parent or row, or inherits otherwise."""
    lines = [f"{bone.name}\t{bone.parent.name if bone.parent else ''}\t{inheritance(bone)}" for bone in rig.data.bones]
    lines += names_of(rig)
    return zlib.crc32("\n".join(lines).encode())


def plan(rig, key, make):
    """What `make(rig, rows)` gives, kept for the same `key` and bones; it has a Still as `still`. rows: name -> row.

    key: a string that stands for all that the plan is made of, the rig's fingerprint included. Kept by each thread for
    itself: a plan is not shared between threads.
    """
    if rig.pose is None or not isinstance(key, str):
        raise Damaged("no rig, or nothing that is known of it")
    plans = kept("plans", OrderedDict)
    place = key, rig.name, rig.library and rig.library.name
    found = plans.get(place)
    copy = copies.stamp_of_data(rig)
    if found is not None and copy and found.copy == copy:
        plans.move_to_end(place)
        return found
    if found is None or copy or not is_still(rig, found.still):
        # The key is what was wired; the rig may be one that was edited since.
        edited, names = fingerprint(rig), names_of(rig)
        if found is not None and found.edited == edited:
            found.still = still(rig, names)
        else:
            found = plans[place] = make(rig, {name: row for row, name in enumerate(names)})
            found.edited = edited
            if len(plans) > LARGEST_CACHE:
                plans.popitem(last=False)
    found.copy = copy
    plans.move_to_end(place)
    return found


def source(rig, key, make, read):
    """What `read(rig, plan)` makes of an evaluated rig and of plan(rig, key, make).

    Kept for as long as Blender keeps these copies of the rig and of its armature; where the armature's cannot be told apart,
    for as long as its bones stay what they are.
    """
    copy, armature = copies.of(rig), rig.data and copies.stamp_of_data(rig)
    place = "source", key
    found = None if copy is None else copy.found.get(place)
    if found is None or found.armature != armature or (armature is None and not is_still(rig, found.still)):
        planned = plan(rig, key, make)
        found = _Source(armature, planned.still, read(rig, planned))
        if copy is not None:
            copy.found[place] = found
    return found.made


class _Source(NamedTuple):
    """What source() keeps. armature: its stamp. still: of the plan."""

    armature: Any
    still: Any
    made: Any
