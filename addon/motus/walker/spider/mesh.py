"""Mesh of the spider: parts with few faces; each part is deformed by one bone."""

import math

import bpy
from mathutils import Vector

from ...core.lazy import numpy as np
from . import anatomy, rig

FUR, BAND, EYE, GLINT = range(4)
"""Indices of the mesh's material slots."""
_SIDES, _RINGS = 9, 7
# Profiles of tubes, a row for each ring: position along the tube from 0 to 1, radius, material of the band that ends there.
_UPPER = ((0.0, 0.020, FUR), (0.12, 0.029, FUR), (0.45, 0.034, FUR), (0.78, 0.027, FUR), (0.86, 0.028, BAND), (1.0, 0.021, BAND))
_LOWER = (
    (0.0, 0.020, BAND),
    (0.07, 0.025, BAND),
    (0.20, 0.024, BAND),
    (0.45, 0.019, FUR),
    (0.50, 0.0195, BAND),
    (0.58, 0.017, BAND),
    (0.80, 0.010, FUR),
    (1.0, 0.003, FUR),
)
_BOW = 0.022
"""Distance by which the middle of a leg's lower bone bends outwards, as a share of the spider's span."""
_PALP = ((0.0, 0.016, FUR), (0.4, 0.019, FUR), (0.75, 0.017, BAND), (1.0, 0.007, BAND))
_FANG = ((0.0, 0.023, FUR), (0.5, 0.027, FUR), (0.85, 0.019, FUR), (1.0, 0.004, EYE))
_EYES = ((0.027, 0.022, 0.0), (0.062, 0.014, -0.012))
"""(distance from the body's middle, radius, distance ahead of the first eye) of each eye of one side."""


class _Parts:
    """Vertices, faces and materials of a mesh, collected part by part; each part belongs to one bone, by name."""

    def __init__(self, size):
        self._size = size
        self.vertices, self.faces, self.materials, self.bones, self.smooth = [], [], [], {}, []

    def add(self, vertices, faces, materials, bone, is_smooth=False):
        """Add a part to the mesh. vertices: (n, 3), for a span of 1. faces: tuples of indices into `vertices`.

        materials: index of a material slot for each face. bone: name of the bone that deforms the part.
        """
        first = len(self.vertices)
        self.vertices += (self._size * np.asarray(vertices)).tolist()
        self.faces += [[first + index for index in face] for face in faces]
        self.materials += materials
        self.smooth += [is_smooth] * len(faces)
        self.bones.setdefault(bone, []).extend(range(first, len(self.vertices)))

    def tube(self, places, profile, bone):
        """Add a tube along a line. places: (n, 3), its points. bone: name of the bone that deforms it.

        profile: (position, radius, material) of the ring at each point, such as _UPPER.
        """
        places = np.asarray(places, float)
        along = np.gradient(places, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        side = np.empty_like(along)
        last = np.cross(along[0], (0.0, 0.0, 1.0))
        for row, ahead in enumerate(along):  # sides of neighbouring rings are nearly parallel, so that the tube does not twist
            last = last - last.dot(ahead) * ahead
            last /= np.linalg.norm(last)
            side[row] = last
        up = np.cross(along, side)
        angles = np.arange(_SIDES) * 2.0 * math.pi / _SIDES
        radii = np.array([radius for _, radius, _ in profile])[:, None, None]
        rings = places[:, None] + radii * (np.cos(angles)[None, :, None] * side[:, None] + np.sin(angles)[None, :, None] * up[:, None])
        self.rings(rings, [material for _, _, material in profile[1:]], bone)

    def rings(self, rings, materials, bone, is_smooth=False):
        """Add a tube through m rings of k points, closed at both ends. rings: (m, k, 3). bone: name of the bone that deforms it.

        materials: index of a material slot for each of the m - 1 bands between rings, or a list with an index for each of k faces.
        """
        count, sides = rings.shape[:2]
        faces, found = [], []
        for row in range(count - 1):
            for index in range(sides):
                following = (index + 1) % sides
                faces.append((row * sides + index, row * sides + following, (row + 1) * sides + following, (row + 1) * sides + index))
                material = materials[row]
                found.append(material[index] if isinstance(material, list) else material)
        ends = [list(range(sides))[::-1], list(range((count - 1) * sides, count * sides))]
        last = [material if isinstance(material, int) else material[0] for material in (materials[0], materials[-1])]
        self.add(rings.reshape(-1, 3), faces + ends, found + last, bone, is_smooth)

    def ball(self, middle, radii, material, bone, **keywords):
        """Add an ellipsoid whose poles lie along Y. middle, radii: x, y and z of its centre and half-axes.

        material: index of a material slot, or a function of (ring, side) that returns one. bone: name of the bone that deforms it.
        """
        turns = np.linspace(0.08, math.pi - 0.08, _RINGS + 1)
        angles = 0.5 * math.pi - np.arange(_SIDES + 1) * 2.0 * math.pi / (_SIDES + 1)
        rings = np.stack(
            [
                np.column_stack((np.cos(angles) * math.sin(turn), np.full(len(angles), -math.cos(turn)), np.sin(angles) * math.sin(turn)))
                for turn in turns
            ]
        ) * radii + np.asarray(middle)
        kinds = [[material(row, index) for index in range(_SIDES + 1)] if callable(material) else material for row in range(_RINGS)]
        self.rings(rings, kinds, bone, **keywords)


def build(owner, count, size, color):
    """Make the mesh object of a spider as a child of its armature, in the armature's collections; returns the object.

    owner: armature object. count: number of legs. size: span of the legs, metres. color: of the bands, RGBA.
    """
    parts = _Parts(size)
    _add_body(parts, count)
    for leg in anatomy.legs(count):
        _add_leg(parts, leg)
    mesh = bpy.data.meshes.new(owner.name)
    mesh.from_pydata(parts.vertices, [], parts.faces)
    for material in _materials(color):
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", parts.materials)
    mesh.polygons.foreach_set("use_smooth", parts.smooth)
    mesh.update()
    skin = bpy.data.objects.new(f"{owner.name} Mesh", mesh)
    for collection in owner.users_collection:
        collection.objects.link(skin)
    for bone, vertices in parts.bones.items():
        skin.vertex_groups.new(name=bone).add(vertices, 1.0, 'REPLACE')
    skin.parent = owner
    skin.modifiers.new("Armature", 'ARMATURE').object = owner
    return skin


def _add_leg(parts, leg):
    upper, lower = rig.UPPER + leg.name, rig.LOWER + leg.name
    parts.tube(_between(leg.hip, leg.knee, _UPPER, 0.0), _UPPER, upper)
    parts.tube(_between(leg.knee, leg.foot, _LOWER, _BOW), _LOWER, lower)
    parts.ball(leg.knee, (0.0225,) * 3, BAND, lower)
    parts.ball(leg.hip, (0.026,) * 3, FUR, rig.BODY)


def _between(start, end, profile, bow):
    """Points along a line from `start` to `end` that bends away from the body, one for each row of a profile. bow: largest bend."""
    way = end - start
    away = Vector((way.x, way.y, 0.0)).normalized()
    return [tuple(start + share * way + bow * math.sin(math.pi * share) * away) for share, _, _ in profile]


def _add_body(parts, count):
    longer, height = anatomy.stretch(count), anatomy.HEIGHT
    ahead = 0.125 * longer
    parts.ball((0.0, anatomy.HIP_AHEAD, height + 0.01), (0.088, ahead, 0.060), FUR, rig.BODY)
    parts.ball((0.0, anatomy.HIP_AHEAD + 0.4 * ahead, height + 0.032), (0.062, 0.075, 0.050), FUR, rig.BODY)
    parts.ball((0.0, -0.07 * longer - 0.155, height + 0.045), (0.118, 0.165, 0.098), _pattern, rig.ABDOMEN)
    face = anatomy.HIP_AHEAD + ahead
    for side in (-1.0, 1.0):
        for across, radius, back in _EYES:
            middle = Vector((side * across, face - 0.028 + back, height + 0.048))
            parts.ball(middle, (radius,) * 3, EYE, rig.BODY, is_smooth=True)
            glint = middle + radius * Vector((0.35 * side, 0.72, 0.52))
            parts.ball(glint, (0.22 * radius,) * 3, GLINT, rig.BODY, is_smooth=True)
        parts.tube(
            _curve(
                (side * 0.045, face - 0.035, height),
                (side * 0.085, face + 0.075, height + 0.035),
                (side * 0.060, face + 0.125, height - 0.075),
                _PALP,
            ),
            _PALP,
            rig.BODY,
        )
        parts.tube(
            _curve(
                (side * 0.026, face - 0.020, height + 0.015),
                (side * 0.030, face + 0.055, height - 0.015),
                (side * 0.022, face + 0.025, height - 0.090),
                _FANG,
            ),
            _FANG,
            rig.BODY,
        )


def _curve(start, middle, end, profile):
    """Points on a parabola from `start` to `end`, one for each row of a profile. middle: control point of the Bezier curve."""
    start, middle, end = map(Vector, (start, middle, end))
    return [tuple((1.0 - t) ** 2 * start + 2.0 * t * (1.0 - t) * middle + t * t * end) for t, _, _ in profile]


def _pattern(ring, side):
    """Index of the material slot of a face of the abdomen, so that chevrons appear on its back. side: 0 is at the top."""
    from_top = min(side, _SIDES - side)
    return BAND if from_top <= (1 if ring % 2 else 0) and 1 <= ring <= _RINGS - 2 else FUR


def _materials(color):
    return (
        _material("Spider Fur", (0.014, 0.010, 0.009, 1.0), 0.7),
        _material("Spider Bands", color, 0.6),
        _material("Spider Eyes", (0.004, 0.004, 0.006, 1.0), 0.06),
        _material("Spider Glint", (1.0, 1.0, 1.0, 1.0), 0.3),
    )


def _material(name, color, roughness):
    material = bpy.data.materials.new(name)
    material.diffuse_color = color
    if not material.use_nodes:
        material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == 'BSDF_PRINCIPLED')
    shader.inputs["Base Color"].default_value = color
    shader.inputs["Roughness"].default_value = roughness
    return material
