"""Follow Path as an artist sees it: the sidebar, the constraint properties and the overlay, on a curve with a banked follower."""

import bpy
from window import window_support

COURSE = ((0, 0, 0), (4, 2, 0.5), (7, -1, 1.5), (10, 2, 0.5))


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    curve = bpy.data.curves.new("Course", 'CURVE')
    curve.dimensions = '3D'
    spline = curve.splines.new('BEZIER')
    spline.bezier_points.add(len(COURSE) - 1)
    for point, place in zip(spline.bezier_points, COURSE):
        point.co = place
        point.handle_left_type = point.handle_right_type = 'AUTO'
    course = bpy.data.objects.new("Course", curve)
    glider = bpy.data.objects.new("Glider", None)
    glider.empty_display_type = 'ARROWS'
    for obj in (course, glider):
        bpy.context.scene.collection.objects.link(obj)
    bpy.ops.motus.path_follow_add(
        object="Glider", curve="Course", timing='SPEED', speed=4.0, orientation='BANKING', bank_strength=2.0)
    for obj in (course, glider):
        obj.select_set(obj == glider)
    bpy.context.view_layer.objects.active = glider
    bpy.context.scene.motus.show_tangents = True
    bpy.context.scene.frame_set(30)
    return glider


def test_sidebar_and_overlay():
    glider = build()
    with window_support.override():
        bpy.ops.view3d.view_all()
    yield
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("path_sidebar")
    assert any("path" in name for name in drawn), drawn
    _, _, values = window_support.pixels(path)
    assert len({round(value, 2) for value in values[0::4]}) > 20
    glider.motus.path.curve = None
    yield
    yield from window_support.picture("path_problem")


def test_constraint_properties():
    build()
    properties = window_support.area('PROPERTIES')
    # A tall editor, so that the whole panel is in the picture.
    window_support.area('VIEW_3D').type = 'PROPERTIES'
    yield
    for area in window_support.window().screen.areas:
        if area.type == 'PROPERTIES':
            area.spaces.active.context = 'CONSTRAINT'
    yield
    yield from window_support.picture("path_constraints")
    assert properties.spaces.active.context == 'CONSTRAINT'
    for area in window_support.window().screen.areas:
        if area.type == 'PROPERTIES' and area != properties:
            area.type = 'VIEW_3D'
            break
    yield
