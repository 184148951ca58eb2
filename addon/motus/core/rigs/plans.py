"""Plans of solvers for rigs: data that a solver computes once from a rig's set-up, and uses for many frames."""

import zlib
from typing import Any, NamedTuple

from .. import keeping
from ..evaluated import copies
from ..file.stored import Damaged
from .arrays import inheritance, is_still, names_of, still

_PLANS = keeping.OfThread(
    "plans of rigs, the results of analyzing a rig's bones for a solver",
    "text of everything that the plan depends on, with a checksum of the bones; name and library of the rig",
    most=64,
)
_SOURCES = keeping.OfEvaluation(
    "data of a rig that its plan is made from", "text of everything that the plan depends on", "one for each group that is wired on a rig"
)


def fingerprint(rig):
    """Checksum (CRC-32) of a rig's bones: names, parents, order, and how each bone inherits from its parent."""
    lines = [f"{bone.name}\t{bone.parent.name if bone.parent else ''}\t{inheritance(bone)}" for bone in rig.data.bones]
    lines += names_of(rig)
    return zlib.crc32("\n".join(lines).encode())


def plan(rig, key, make):
    """Plan of a solver for a rig: the result of the function `make(rig, rows)`, kept until `key` or the bones change.

    rows: {name of a bone: its row in the solver's arrays}.
    key: text that stands for everything that the plan is made from, the rig's fingerprint() included. The plan's attribute `still`
    is the rig's Still (names, rest pose, lengths and inheritance of the bones). Each thread makes and keeps its own plans.
    Raises Damaged if the object has no pose or `key` is no text.
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
        # `key` describes the rig when its drivers were added; the armature may have been edited since.
        edited, names = fingerprint(rig), names_of(rig)
        if found is not None and found.edited == edited:
            found.still = still(rig, names)
        else:
            found = plans.add(place, make(rig, {name: row for row, name in enumerate(names)}))
            found.edited = edited
    found.copy = copy
    return found


def source(rig, copy, key, make, read):
    """Data that a solver reads from an evaluated rig, kept between frames: the result of `read(rig, copy, plan)`.

    copy: the rig's Copy (core/evaluated/copies.py). The third argument of `read` is the rig's plan, plan(rig, key, make).
    The result is kept as long as Blender keeps the evaluated copies of the rig and of its armature. If the armature's copy cannot
    be identified, the result is kept as long as the rest pose and inheritance of the bones stay the same.
    """
    armature = rig.data and copies.stamp_of_data(rig)
    kept = _SOURCES.on(copy)
    found = kept.get(key)
    if found is None or found.armature != armature or (armature is None and not is_still(rig, found.still)):
        planned = plan(rig, key, make)
        found = kept[key] = _Source(armature, planned.still, read(rig, copy, planned))
    return found.made


class _Source(NamedTuple):
    """Data that a solver has read from an evaluated rig, with the signs by which source() knows whether they still hold.

    armature: number of the evaluated copy of the armature; None if copies cannot be told apart. still: the rig's Still, its names, rest
    pose and inheritance, when it was read. made: the data, which the caller's function read(rig, copy, plan) has returned.
    """

    armature: Any
    still: Any
    made: Any
