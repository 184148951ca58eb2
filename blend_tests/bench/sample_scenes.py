"""Objects that several benchmarks begin with."""

import bpy


def new_object(name, data=None):
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def new_curve(place=0.0):
    """A bend of 18 m whose path is evaluated along with the frames."""
    data = bpy.data.curves.new("Course", 'CURVE')
    data.dimensions = '3D'
    spline = data.splines.new('BEZIER')
    spline.bezier_points.add(1)
    for point, x in zip(spline.bezier_points, (0.0, 12.0)):
        point.handle_left_type = point.handle_right_type = 'FREE'
        point.co = (x, place, 0.25 * x)
        point.handle_left, point.handle_right = (x - 4.0, place - 6.0, 0.25 * x), (x + 4.0, place + 6.0, 0.25 * x)
    data.path_duration = 200
    data.driver_add("eval_time").driver.expression = "frame"
    return new_object("Course", data)
