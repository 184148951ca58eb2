"""Shapes from which the wooden pilot is made, and the mesh that collects them, each with the bone that moves it."""

import numpy as np

from ..stage import shapes
from . import skeleton

# Material slots of the body.
WOOD, DARK, JACKET, CREAM, SCARF, BOOT, LEATHER, BRASS, WHITE, IRIS, PUPIL, BLUSH, GLASS = range(13)


class Body:
    """Collects parts, (vertices, faces), and the bones that move them; finish() makes one skinned mesh."""

    def __init__(self):
        self._builder = shapes.MeshBuilder()
        self._bones = []

    def add(self, part, bone, slot, smooth=True):
        """Add a part in the armature's space. bone: name of one bone, or a list of names, one for each vertex. slot: material index."""
        self._builder.add(part, slot, smooth)
        self._bones += [bone] * len(part[0]) if isinstance(bone, str) else bone

    def add_local(self, part, bone, slot):
        """Add a part whose vertices are in the space of the bone that moves the part."""
        matrix = skeleton.frame(bone)
        vertices, faces = part
        self.add((vertices @ matrix[:3, :3].T + matrix[:3, 3], faces), bone, slot)

    def finish(self, collection, rig, body_materials):
        """Make the mesh object with vertex groups and an Armature modifier. Returns the object."""
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
    """Turn a profile of (radius, height) rows, from top to bottom, about Z. depth: scale along Y."""
    return shapes.upright(shapes.lathe(shapes.smooth_profile_points(profile, count), segments), depth=depth)


def along(bone, profile, count=30, segments=28):
    """Turn a profile of (radius, fraction of the bone's length) rows about a bone."""
    rows = np.asarray(profile) * (1.0, skeleton.length(bone))
    return shapes.lathe(shapes.smooth_profile_points(rows, count), segments)


def ball(radius):
    """Make a ball joint at the origin, a bone's start."""
    return shapes.sphere(radius, segments=28, rings=18)


def ribbon(line, half_width, half_thickness):
    """Make a flat strip with rounded edges along a line, (m, 3), with its width along X."""
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
    """Make a round tube along a line, (m, 3). radius: one number, or one for each point. closed: whether the ends are joined."""
    line = np.asarray(line, dtype=float)
    if closed:
        tangent = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
    else:
        tangent = np.gradient(line, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    # The normal of the line's plane, relative to which the cross-sections do not twist.
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
    """Make a finger with round ends along three points: start, bend and end. The bend is smoothed."""
    s = np.linspace(0.0, 1.0, rows)[:, None]
    start, bend, end = corners
    pull = 2.0 * bend - 0.5 * (start + end)
    line = (1 - s) ** 2 * start + 2 * s * (1 - s) * pull + s**2 * end
    ahead = (line[-1] - line[-2]) / np.linalg.norm(line[-1] - line[-2])
    cap = np.array((0.45, 0.8, 0.97))
    tip = line[-1] + np.outer(cap * radius, ahead)
    taper = np.concatenate((np.linspace(1.05, 0.92, rows), 0.92 * np.sqrt(1.0 - cap**2)))
    return tube(np.concatenate((line, tip)), radius * taper, sides=14)
