"""The remote control of the main scene: a box with two sticks that hangs from the pilot's neck, and the places of his hands on it."""

import math

import numpy as np
from mathutils import Matrix

from ..character import parts
from ..stage import materials, shapes

BONE = "spine.003"  # bone to which the box is parented
# Place and tilt of the box in the armature's space: in front of the belly, with the sticks towards the eyes.
PLACE, TILT = (0.0, -0.245, 1.130), math.radians(-32.0)
SIZE, CORNER = (0.190, 0.085, 0.046), 0.010  # width, depth and thickness of the box, and radius of its corners, m
STICKS = 0.052, 0.004, 0.030  # distances from the box's middle to the side and towards the pilot, and height; m
STICK_LEAN = {"L": (0.10, -0.16), "R": (-0.05, 0.12)}  # tilt of each stick
AERIAL = 0.34  # m
NECK = (0.062, -0.010, 1.448)  # place beside the neck at which the strap lies
STRAP = 0.010, 0.0022  # half the strap's width and half its thickness, m
PALM = (0.0, 0.048, -0.019)  # point of the palm that touches the box, in the space of the hand's bone
SPREAD = math.radians(14.0)  # angle by which the fingers point inwards
GRIP_BACK = 0.004  # m by which the palms are nearer to the pilot than the box's middle
BODY, DARK, METAL, RED = range(4)


def build(collection, rig):
    """Build the box and its strap as children of the chest's bone. The rig has to be in rest pose. Returns the box."""
    box = shapes.link_object(collection, "Remote", _box_mesh(), rig)
    box.parent_type, box.parent_bone = "BONE", BONE
    box.matrix_parent_inverse = _to_bone(rig)
    box.matrix_basis = place()
    strap = shapes.link_object(collection, "Strap", _strap_mesh(), rig)
    strap.parent_type, strap.parent_bone = "BONE", BONE
    strap.matrix_parent_inverse = _to_bone(rig)
    return box


def place():
    """Return the rest matrix of the remote control's box in the armature's space."""
    return Matrix.Translation(PLACE) @ Matrix.Rotation(TILT, 4, "X")


def grip(side):
    """Return the matrix, in the box's space, of a hand's bone that holds the box: thumb up, fingers around the far edge."""
    sign = 1.0 if side == "L" else -1.0
    along = np.array((-sign * math.sin(SPREAD), -math.cos(SPREAD), 0.0))
    back = np.array((sign * math.cos(SPREAD), -math.sin(SPREAD), 0.0))
    axes = np.column_stack((np.cross(along, back), along, back))
    touched = np.array((sign * 0.5 * SIZE[0], GRIP_BACK, -0.006))
    matrix = np.identity(4)
    matrix[:3, :3], matrix[:3, 3] = axes, touched - axes @ np.array(PALM)
    return Matrix(matrix.tolist())


def _to_bone(rig):
    """Return the matrix from the armature's space to the space at the tail of BONE, in which children of the bone are placed."""
    bone = rig.data.bones[BONE]
    return (bone.matrix_local @ Matrix.Translation((0.0, bone.length, 0.0))).inverted()


def _box_mesh():
    builder = shapes.MeshBuilder()
    width, depth, thick = SIZE
    builder.add(shapes.beam(SIZE, (0.0, 0.0, 0.0), CORNER), BODY, smooth=False)
    builder.add(shapes.beam((0.86 * width, 0.80 * depth, 0.004), (0.0, 0.0, 0.5 * thick), 0.001), DARK, smooth=False)
    aside, near, high = STICKS
    for side, sign in (("L", 1.0), ("R", -1.0)):
        foot = np.array((sign * aside, near, 0.5 * thick))
        builder.add(shapes.sphere(0.017, foot, (1.0, 1.0, 0.45), 24, 12), DARK)
        lean_x, lean_y = STICK_LEAN[side]
        tip = foot + (high * lean_x, high * lean_y, high)
        builder.add(parts.tube(np.linspace(foot, tip, 4) + _bow(4), 0.0034, sides=10), METAL)
        builder.add(shapes.sphere(0.0075, tip, segments=16, rings=10), METAL)
    builder.add(shapes.box((0.030, 0.010, 0.003), (0.0, 0.018, 0.5 * thick + 0.003)), RED, smooth=False)
    start = np.array((0.030, -0.5 * depth + 0.004, 0.2 * thick))
    line = np.linspace(start, start + (0.05, -0.62 * AERIAL, 0.76 * AERIAL), 6)
    builder.add(parts.tube(line + _bow(6), np.linspace(0.0032, 0.0016, 6), sides=8), METAL)
    builder.add(shapes.sphere(0.0055, line[-1], segments=12, rings=8), RED)
    return builder.build(
        "Remote",
        [
            materials.principled("Remote Paint", color=(0.80, 0.62, 0.10), roughness=0.4, coat=0.5, coat_roughness=0.1),
            materials.principled("Remote Face", color=(0.025, 0.025, 0.028), roughness=0.5),
            materials.principled("Remote Metal", color=(0.85, 0.83, 0.78), metallic=1.0, roughness=0.2),
            materials.principled("Remote Light", color=(0.75, 0.03, 0.02), roughness=0.3),
        ],
    )


def _bow(count):
    """Return offsets (count, 3) that bend a straight line of points by less than a millimetre.

    On an exactly straight line the plane in which a tube's cross-section turns would be undefined.
    """
    return np.outer(np.sin(np.linspace(0.0, math.pi, count)), (0.0004, 0.0, 0.0002))


def _strap_mesh():
    """Make the mesh of the strap: two ribbons from the box's corners over the chest, and one around the nape."""
    builder = shapes.MeshBuilder()
    matrix = np.array(place())
    for sign in (1.0, -1.0):
        corner = matrix[:3, :3] @ (sign * 0.40 * SIZE[0], -0.30 * SIZE[1], 0.5 * SIZE[2]) + matrix[:3, 3]
        chest = np.array((sign * 0.088, -0.128, 1.330))
        top = np.array((sign * NECK[0], *NECK[1:]))
        over = np.array((sign * 0.076, -0.096, 1.415))
        builder.add(parts.ribbon(_through((corner, chest, over, top)), *STRAP))
    nape = [
        np.array((0.066 * math.cos(a), 0.055 * math.sin(a) + 0.004, 1.446 + 0.006 * math.sin(a)))
        for a in np.linspace(-0.15, math.pi + 0.15, 24)
    ]
    builder.add(parts.tube(np.array(nape), 0.0075, sides=10))
    return builder.build("Strap", [materials.principled("Strap", color=(0.10, 0.045, 0.02), roughness=0.7)])


def _through(corners, rows=28):
    """Return `rows` points of a smooth line through the corners."""
    corners = np.asarray(corners)
    steps = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    stations = np.column_stack((np.concatenate(([0.0], np.cumsum(steps))), corners))
    return shapes.smooth_profile(stations, rows)[:, 1:]
