"""Pieces of the wooden pilot: turned and bent shapes, and the mesh that collects them, each carried by a bone."""

import numpy as np

from ..stage import shapes
from . import skeleton

# Material slots of the body.
WOOD, DARK, JACKET, CREAM, SCARF, BOOT, LEATHER, BRASS, WHITE, IRIS, PUPIL, BLUSH, GLASS = range(13)


class Body:
    """Collects parts and the bone that carries each."""

    def __init__(self):
        self._builder = shapes.MeshBuilder()
        self._bones = []

    def add(self, part, bone, slot, smooth=True):
        """A part in the armature's space; `bone` is one bone's name, or one for each vertex."""
        self._builder.add(part, slot, smooth)
        self._bones += [bone] * len(part[0]) if isinstance(bone, str) else bone

    def add_local(self, part, bone, slot):
        """A part in the space of the bone that carries it."""
        matrix = skeleton.frame(bone)
        vertices, faces = part
        self.add((vertices @ matrix[:3, :3].T + matrix[:3, 3], faces), bone, slot)

    def finish(self, collection, rig, body_materials):
        """The mesh object, skinned to the rig."""
        mesh = self._builder.build("Pilot Body", body_materials)
        thing = shapes.link_object(collection, f"{rig.name} Body", mesh, rig)
        carried = {}
        for index, bone in enumerate(self._bones):
            carried.setdefault(bone, []).append(index)
        for bone, vertices in carried.items():
            thing.vertex_groups.new(name=bone).add(vertices, 1.0, "REPLACE")
        modifier = thing.modifiers.new("Armature", "ARMATURE")
        modifier.object = rig
        return thing


def turned(profile, count=36, segments=36, depth=1.0):
    """A profile of (radius, height) rows from top to bottom, turned about Z."""
    return shapes.upright(shapes.lathe(shapes.smooth_profile_points(profile, count), segments), depth=depth)


def along(bone, profile, count=30, segments=28):
    """A profile of (radius, fraction) rows turned about a bone."""
    rows = np.asarray(profile) * (1.0, skeleton.length(bone))
    return shapes.lathe(shapes.smooth_profile_points(rows, count), segments)


def ball(radius):
    """A joint at a bone's start."""
    return shapes.sphere(radius, segments=28, rings=18)


def ribbon(line, half_width, half_thickness):
    """A flat strip with rounded edges down a line, its width along X."""
    angle = shapes.ring(14)
    across = np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** 0.6
    width = np.asarray(half_width) * np.ones(len(line))
    ends = np.ones(len(line))
    ends[0] = ends[-1] = 0.02
    sections = np.repeat(line[:, None, :], 14, axis=1)
    sections[..., 0] += width[:, None] * ends[:, None] * across
    sections[..., 1] += half_thickness * ends[:, None] * np.sin(angle)
    return shapes.loft(sections[:, ::-1])


def tube(line, radius, closed=False, sides=14):
    """A round tube along a line (m, 3); `radius` is one number or one for each point."""
    line = np.asarray(line, dtype=float)
    if closed:
        tangent = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
    else:
        tangent = np.gradient(line, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    # Across the line's plane, so that the sections do not twist.
    normal = np.linalg.svd(line - line.mean(axis=0))[2][2]
    first = normal - tangent * (tangent @ normal)[:, None]
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(tangent, first)
    angle = shapes.ring(sides)
    reach = np.broadcast_to(np.asarray(radius, dtype=float), (len(line),))[:, None, None]
    offset = first[:, None, :] * np.cos(angle)[:, None] + second[:, None, :] * np.sin(angle)[:, None]
    sections = line[:, None, :] + reach * offset
    if closed:
        sections = np.concatenate((sections, sections[:1]))
    return shapes.loft(sections)


def capsule(corners, radius, rows=16):
    """A finger with round ends through three corners, its bend smoothed."""
    s = np.linspace(0.0, 1.0, rows)[:, None]
    start, bend, end = corners
    pull = 2.0 * bend - 0.5 * (start + end)
    line = (1 - s) ** 2 * start + 2 * s * (1 - s) * pull + s**2 * end
    ahead = (line[-1] - line[-2]) / np.linalg.norm(line[-1] - line[-2])
    cap = np.array((0.45, 0.8, 0.97))
    tip = line[-1] + np.outer(cap * radius, ahead)
    taper = np.concatenate((np.linspace(1.05, 0.92, rows), 0.92 * np.sqrt(1.0 - cap**2)))
    return tube(np.concatenate((line, tip)), radius * taper, sides=14)
