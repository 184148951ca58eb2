"""One stamp for the own transforms of many bones of a rig: the channels of all bones are read at once, by one call a property.

Own.stamp (transforms.py) says the same of one bone, and is more general. For a rig with hundreds of bones it takes longer than all else
that an edit of a solver's setting makes necessary.
"""

from typing import Any, NamedTuple

from .. import keeping, rigs
from ..animation import strips
from ..blender import actions
from ..evaluated import copies
from ..evaluated.question import answered
from ..lazy import numpy as np

MODES = {'QUATERNION': 0, 'XYZ': 1, 'XZY': 2, 'YXZ': 3, 'YZX': 4, 'ZXY': 5, 'ZYX': 6, 'AXIS_ANGLE': 7}
"""PoseBone.rotation_mode as a number."""
SIZES = {"rotation_mode": 1, "location": 3, "rotation_euler": 3, "rotation_quaternion": 4, "rotation_axis_angle": 4, "scale": 3}
"""Properties of a PoseBone that its own transform depends on, and how many numbers each has."""
REST = {"matrix_local": 16, "length": 1}
"""Numbers of a Bone that say where it rests."""
SWITCHES = {"use_inherit_rotation": 1, "use_local_location": 1, "use_connect": 1, "use_relative_parent": 1}
"""Properties of a Bone that say what it takes over from its parent, beside inherit_scale."""

_keyed = keeping.OfFile(
    "which numbers of the own transforms of a rig's bones have keys", "stamp of the action, names of the bones in the order of the pose", 64
)


class _Channels(NamedTuple):
    """Numbers of all bones of an evaluated rig that their own transforms and their rest pose depend on.

    acting: stamp of the action. rows: {bone name: row}. numbers: (bones, n) float32, 0 where keys set the number; rotation modes first.
    rest: (bones, m) float32. changes_mode: (bones,), whether keys set the rotation mode.
    """

    acting: Any
    rows: dict
    numbers: Any
    rest: Any
    changes_mode: Any


def stamp(rig, names):
    """Hashable value that changes whenever the own transform or the rest pose of bones of an evaluated rig may change at any time.

    names: tuple of the bones' names. The result is None if edits cannot be detected, or if anything but keys of the active action moves
    the bones: then each bone is to be asked (Own.stamp). Not covered are poses that systems lay over bones (laid.py), and which bone is
    whose parent.
    """
    found = answered((hash(rig), "channels of bones"), lambda: _read(rig))
    if found is None:
        return None
    rows = [found.rows[name] for name in names]
    if found.changes_mode[rows].any():
        return None
    return found.acting, names, found.numbers[rows].tobytes(), found.rest[rows].tobytes()


def _read(rig):
    """The _Channels of an evaluated rig; None if edits of its keys cannot be detected, or NLA strips or drivers move bones."""
    animation = rig.animation_data
    if copies.has_driven_poses(rig) or (animation and animation.use_nla and len(animation.nla_tracks)):
        return None
    acting = strips.stamp_of(animation)
    if acting is None:
        return None
    names = rigs.names_of(rig)
    rows = dict(zip(names, range(len(names))))
    keyed = _keyed.made((acting, names), lambda: _find_keyed(rig, rows))
    posed, bones = rig.pose.bones, rig.data.bones
    # Modes and inheritance one by one: in Blender 3.4 foreach_get reads wrong values for enums.
    modes = np.array([[MODES[bone.rotation_mode]] for bone in posed], np.float32)
    inherited = np.array([[rigs.INHERIT_SCALE[bone.inherit_scale]] for bone in bones], np.float32)
    numbers = np.concatenate([modes, _columns(posed, list(SIZES.items())[1:])], axis=1)
    numbers[keyed] = 0.0
    rest = np.concatenate([_columns(bones, REST.items()), _columns(bones, SWITCHES.items()), inherited], axis=1)
    order = bones.keys()
    if list(names) != order:  # bones that were added later stand at the end of the pose
        rest[[rows[name] for name in order]] = rest.copy()
    return _Channels(acting, rows, numbers, rest, keyed[:, 0])


def _columns(bones, sizes):
    """Properties of all bones of a collection side by side, (bones, numbers) float32. sizes: (property, how many numbers it has) of each."""
    found = []
    for name, size in sizes:
        read = np.empty(len(bones) * size, bool if name in SWITCHES else np.float32)
        bones.foreach_get(name, read)
        found.append(read.reshape(-1, size).astype(np.float32))
    return np.concatenate(found, axis=1)


def _find_keyed(rig, rows):
    """Which numbers of the bones have keys with an effect, (bones, numbers) bool. rows: {bone name: row}."""
    starts = dict(zip(SIZES, np.cumsum([0, *SIZES.values()]).tolist()))
    keyed = np.zeros((len(rows), sum(SIZES.values())), bool)
    curves = actions.curves_of(rig.animation_data) if rig.animation_data else ()
    for curve in curves:
        name, index = curve.data_path.rpartition(".")[2], curve.array_index
        row = rows.get(actions.bone_of(curve))
        if row is not None and index < SIZES.get(name, 0) and strips.acting(curves, curve.data_path, index):
            keyed[row, starts[name] + index] = True
    return keyed
