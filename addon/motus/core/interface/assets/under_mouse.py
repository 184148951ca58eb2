"""What is under the mouse in a 3D viewport: an object, or in Pose Mode a bone."""

import itertools
from typing import Any, NamedTuple

from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector
from mathutils.geometry import intersect_point_line

from ..view import viewports

REACH = 12.0
"""Pixels, at a scale of 1, from which what has no surface is hit."""
_AHEAD = 1e-3
"""Share of its distance by which a surface may be nearer to the viewer than what lies on it."""


class Found(NamedTuple):
    """What is under the mouse. bone: name of the bone; "" for the object. view: the View in which it is."""

    object: Any
    bone: str
    view: Any


def find(context, x, y):
    """What is under a pixel (x, y) of the window; None if there is nothing, or if no 3D viewport is there."""
    view = viewports.view_at(context.window, x, y)
    if view is None:
        return None
    reach = REACH * context.preferences.system.ui_scale
    mouse = Vector((x - view.region.x, y - view.region.y))
    origin, direction = view.ray(x, y)
    if context.mode == 'POSE':
        near = _nearest(view, mouse, reach, ((bone, line) for bone in context.visible_pose_bones or () for line in (_line(bone),)))
        return near and Found(near[0].id_data, near[0].name, view)
    is_hit, place, _, _, surface, _ = context.scene.ray_cast(context.view_layer.depsgraph, origin, direction)
    near = _nearest(view, mouse, reach, ((obj, line) for obj in context.visible_objects for line in _lines(obj)))
    if is_hit and (near is None or (place - origin).length < (1.0 - _AHEAD) * (near[1] - origin).length):
        return Found(surface.original, "", view)
    return near and Found(near[0], "", view)


def _line(bone):
    matrix = bone.id_data.matrix_world
    return matrix @ bone.head, matrix @ bone.tail


def _lines(obj):
    """Lines of an object that has no surface, as pairs of places in the world."""
    if obj.type == 'ARMATURE' and obj.pose:
        return [_line(bone) for bone in obj.pose.bones]
    if obj.type in {'EMPTY', 'CAMERA', 'LIGHT', 'SPEAKER', 'LATTICE', 'ARMATURE'}:
        return [(obj.matrix_world.translation, obj.matrix_world.translation)]
    if obj.type in {'CURVE', 'CURVES'} and hasattr(obj.data, "splines"):
        points = [[point.co.to_3d() for point in spline.bezier_points or spline.points] for spline in obj.data.splines]
        return [(obj.matrix_world @ first, obj.matrix_world @ second) for spline in points for first, second in itertools.pairwise(spline)]
    return []


def _nearest(view, mouse, reach, things):
    """(thing, its place in the world) that is nearest to the mouse on the screen, within reach; None if none is.

    things: (thing, (place, place)) for each line of a thing.
    """
    found = None
    for thing, line in things:
        ends = [location_3d_to_region_2d(view.region, view.data, place) for place in line]
        if None in ends:
            continue
        share = 0.0 if ends[0] == ends[1] else min(1.0, max(0.0, intersect_point_line(mouse, *ends)[1]))
        distance = (ends[0].lerp(ends[1], share) - mouse).length
        if distance <= reach:
            reach, found = distance, (thing, line[0].lerp(line[1], share))
    return found
