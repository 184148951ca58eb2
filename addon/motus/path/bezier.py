"""Operator that adds a curve object for one Bézier curve of any degree; its control points are spline points or placed objects."""

import bpy
from mathutils import Vector

from ..core.interface.operators import OBJECT_MODE, Operator, select_only
from ..core.interface.rows import Row, Rows
from ..core.refusals import Refused
from ..core.translations import tr
from . import targets
from .curves import CONTROL_POLYGON_KEY, MAX_DEGREE

HIGHEST_OFFERED = 32
LENGTH = 4.0  # length of a new curve along X, m
BULGE = 1.0  # distance of the control points from the X axis, to either side in turn, m


class MOTUS_OT_path_new_bezier(Operator, bpy.types.Operator):
    bl_idname = "motus.path_new_bezier"
    bl_label = "Bézier of Any Degree"
    bl_description = "Add a curve whose points, or placed objects, are the control points of one Bézier curve"

    degree: bpy.props.IntProperty(
        name="Degree",
        description="Degree of the curve: one less than the number of its control points",
        default=3,
        min=1,
        max=HIGHEST_OFFERED,
    )
    objects: bpy.props.StringProperty(
        name="Objects",
        description="Names of objects with commas between, or a collection's name: the objects' places are the control points, and moving "
        "an object moves the curve",
        options={'SKIP_SAVE'},
    )
    name: bpy.props.StringProperty(name="Name", description="Name of the new curve", default="Bezier")

    modes = OBJECT_MODE
    redo = (Rows((Row("degree", when=lambda operator: not operator.objects),)),)

    def run(self, context):
        hooks = targets.named_list(self.objects)
        if hooks and not 2 <= len(hooks) <= MAX_DEGREE + 1:
            raise Refused(tr("A Bézier curve needs 2 to {most} control points, not {count}").format(most=MAX_DEGREE + 1, count=len(hooks)))
        context.view_layer.update()
        if hooks:
            curve = new_curve(self.name, [hook.matrix_world.translation for hook in hooks])
            _hook(curve, hooks)
        else:
            curve = new_curve(self.name, default_points(self.degree))
            curve.location = context.scene.cursor.location
        context.collection.objects.link(curve)
        select_only(context, curve)
        self.report({'INFO'}, tr("{curve} has degree {degree}").format(curve=curve.name, degree=len(curve.data.splines[0].points) - 1))


def default_points(degree):
    """Return degree + 1 control points of a new curve along the X axis; the inner ones lie in turn left and right of the axis."""
    middle = range(1, degree)
    points = [Vector((LENGTH * i / degree - 0.5 * LENGTH, BULGE * (-1.0) ** i, 0.0)) for i in middle]
    return [Vector((-0.5 * LENGTH, 0.0, 0.0)), *points, Vector((0.5 * LENGTH, 0.0, 0.0))]


def new_curve(name, points):
    """Create an unlinked curve object with one poly spline, whose points are the control points of one Bézier curve."""
    data = bpy.data.curves.new(name, 'CURVE')
    data.dimensions = '3D'
    data[CONTROL_POLYGON_KEY] = True
    spline = data.splines.new('POLY')
    spline.points.add(len(points) - 1)
    for point, position in zip(spline.points, points):
        point.co = (*position, 1.0)
    return bpy.data.objects.new(name, data)


def _hook(curve, hooks):
    """Add a Hook modifier for each control point, so that it follows an object; the curve object must be at the world origin."""
    for index, hook in enumerate(hooks):
        modifier = curve.modifiers.new(hook.name, 'HOOK')
        modifier.object = hook
        modifier.vertex_indices_set([index])
        modifier.matrix_inverse = hook.matrix_world.inverted_safe()


classes = (MOTUS_OT_path_new_bezier,)
