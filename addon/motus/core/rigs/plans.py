"""Plans that are made once from what is wired on a rig and used for many frames."""

import zlib
from typing import Any, NamedTuple

from .. import keeping
from ..evaluated import copies
from ..file.stored import Damaged
from .arrays import inheritance, is_still, names_of, still

_PLANS = keeping.OfThread("plans of rigs", "what was wired, fingerprint of the bones included; the rig's name and library", most=64)
_SOURCES = keeping.OfEvaluation("what is read of a rig for its plan", "what was wired", "one for each group that is wired on a rig")


def fingerprint(rig):
    """A number that changes when a bone is given another parent or row, or inherits otherwise."""
    lines = [f"{bone.name}\t{bone.parent.name if bone.parent else ''}\t{inheritance(bone)}" for bone in rig.data.bones]
    lines += names_of(rig)
    return zlib.crc32("\n".join(lines).encode())


def plan(rig, key, make):
    """The result of `make(rig, rows)`, kept for the same `key` and bones; it has a Still as `still`. rows: name -> row.

    key: a string that stands for all that the plan is made of, the rig's fingerprint included. Kept by each thread for
    itself: a plan is not shared between threads.
    """
    if rig.pose is None or not isinstance(key, str):
        raise Damaged("no rig, or nothing that is known of it")
    plans = _PLANS.here()
    place = key, rig.name, rig.library and rig.library.name
    found = plans.find(place)
    copy = copies.stamp_of_data(rig)
    if found is not None and copy and found.copy == copy:
        return found
    if found is None or copy or not is_still(rig, found.still):
        # The key is what was wired; the rig may be one that was edited since.
        edited, names = fingerprint(rig), names_of(rig)
        if found is not None and found.edited == edited:
            found.still = still(rig, names)
        else:
            found = plans.add(place, make(rig, {name: row for row, name in enumerate(names)}))
            found.edited = edited
    found.copy = copy
    return found


def source(rig, key, make, read):
    """The result of `read(rig, plan)` for an evaluated rig and plan(rig, key, make).

    Kept for as long as Blender keeps these copies of the rig and of its armature; where the armature's cannot be told apart,
    for as long as its bones stay what they are.
    """
    armature = rig.data and copies.stamp_of_data(rig)
    kept = _SOURCES.on(copies.of(rig))
    found = kept.get(key)
    if found is None or found.armature != armature or (armature is None and not is_still(rig, found.still)):
        planned = plan(rig, key, make)
        found = kept[key] = _Source(armature, planned.still, read(rig, planned))
    return found.made


class _Source(NamedTuple):
    """An entry that source() keeps. armature: the armature's stamp. still: the plan's Still."""

    armature: Any
    still: Any
    made: Any
