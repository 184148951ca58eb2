"""The armature of the hopping creature: a root bone, the body, a tail and two antennae. The creature faces -Y."""

import bpy
import numpy as np

from ..stage import shapes

NAME = "Hopper"
ROOT, BODY, TAIL, ANTENNAE = "Root", "Body", "Tail", ("Antenna.L", "Antenna.R")
BODY_BONE = ((0.0, 0.0, 0.04), (0.0, 0.0, 0.62))

TAIL_WAY = ((0.0, 0.36, 0.34), (0.0, 0.62, 0.34), (0.0, 0.88, 0.44), (0.0, 1.10, 0.62), (0.0, 1.26, 0.86), (0.0, 1.33, 1.12))
ANTENNA_WAY = ((0.13, -0.10, 1.00), (0.17, -0.12, 1.18), (0.23, -0.13, 1.36), (0.31, -0.15, 1.53), (0.40, -0.19, 1.67))
JOINTS = {TAIL: 9, **dict.fromkeys(ANTENNAE, 6)}
"""Number of bones in each chain: {name of the chain: number}."""


def way(chain, count):
    """Return `count` positions along a chain of bones in rest pose, at equal distances, as an array (count, 3)."""
    points = np.array(TAIL_WAY if chain == TAIL else ANTENNA_WAY)
    if chain == ANTENNAE[1]:
        points = points * (-1.0, 1.0, 1.0)
    steps = np.linspace(0.0, len(points) - 1.0, 400)
    fine = shapes.smooth_profile(np.column_stack((np.arange(len(points)), points)), 400)
    fine = np.stack([np.interp(steps, fine[:, 0], fine[:, 1 + axis]) for axis in range(3)], axis=1)
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(fine, axis=0), axis=1))))
    wanted = np.linspace(0.0, along[-1], count)
    return np.stack([np.interp(wanted, along, fine[:, axis]) for axis in range(3)], axis=1)


def names(chain):
    """List the names of a chain's bones, topmost first."""
    stem, dot, side = chain.partition(".")
    return [f"{stem} {index + 1}{dot}{side}" for index in range(JOINTS[chain])]


def build(context, collection):
    """Make the creature's armature object. The context is in Object Mode afterwards."""
    rig = shapes.link_object(collection, NAME, bpy.data.armatures.new(NAME))
    rig.data.display_type = "STICK"
    for other in context.selected_objects:
        other.select_set(False)
    context.view_layer.objects.active = rig
    rig.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    bones = rig.data.edit_bones
    _add(bones, ROOT, None, (0.0, 0.0, 0.0), (0.0, -0.3, 0.0))
    _add(bones, BODY, bones[ROOT], *BODY_BONE)
    for chain, joints in JOINTS.items():
        places, above = way(chain, joints + 1), bones[BODY]
        for name, head, tail in zip(names(chain), places, places[1:]):
            above = _add(bones, name, above, head, tail)
            above.inherit_scale = "NONE"  # tail and antennae do not take the scale of the body, which is squashed
            above.use_connect = (above.parent.tail - above.head).length < 1e-6
    bpy.ops.object.mode_set(mode="OBJECT")
    return rig


def _add(bones, name, parent, head, tail):
    bone = bones.new(name)
    bone.parent, bone.head, bone.tail = parent, head, tail
    return bone
