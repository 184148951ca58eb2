"""Follow Path as an artist sees it: the sidebar, the constraint properties and the overlay, on a curve with a banked follower."""

import bpy

import support
from window import properties_editor, window_support

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
    bpy.ops.motus.path_follow_add(object="Glider", curve="Course", timing='SPEED', speed=4.0, orientation='BANKING', bank_strength=2.0)
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


def test_readouts_move_in_playback():
    """The mouse stands still meanwhile: what passes under it has panels drawn anew."""
    build()
    drawn = yield from window_support.open_tab("Motus")
    yield from window_support.until(lambda: "MOTUS_PT_path_readouts" in drawn)
    with window_support.override():
        bpy.ops.screen.animation_play()
    yield
    drawn.clear()
    try:
        yield from window_support.until(lambda: drawn.count("MOTUS_PT_path_readouts") > 2, seconds=20.0)
        assert drawn.count("MOTUS_PT_path_readouts") > 2, drawn
    finally:
        with window_support.override():
            bpy.ops.screen.animation_cancel(restore_frame=True)


def test_constraint_properties():
    build()
    yield from properties_editor.picture_of('CONSTRAINT', "path_constraints")


def test_a_train_on_a_closed_curve():
    build()
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.curve.primitive_bezier_circle_add(radius=6.0)
    ring = bpy.context.object
    for index in range(4):
        bpy.ops.mesh.primitive_cube_add(size=1.0, location=(index, 0.0, 0.0), scale=(0.5, 1.0, 0.5))
        bpy.context.object.name = f"Wagon {index}"
    bpy.ops.object.select_all(action='SELECT')
    bpy.context.view_layer.objects.active = ring
    with window_support.override():
        bpy.ops.view3d.view_axis(type='TOP')
        bpy.ops.motus.path_train_add()
        bpy.ops.view3d.view_all()
    yield
    engine = bpy.context.object
    assert engine.name == "Wagon 0" and engine.motus.path.extend == 'LOOP'
    drawn = yield from window_support.open_tab("Motus")
    assert any("train" in name for name in drawn), drawn
    yield from window_support.picture("path_train")
    with window_support.override():
        bpy.ops.wm.call_panel(name="MOTUS_PT_path_presets")
    yield from window_support.picture("path_presets")
    window_support.press('ESC', *window_support.centre())
    yield
    bpy.ops.object.select_all(action='DESELECT')
    ring.select_set(True)
    bpy.context.view_layer.objects.active = ring
    yield from window_support.picture("path_followed_curve")
    with window_support.override():
        bpy.ops.object.mode_set(mode='EDIT')
        for point in ring.data.splines[0].bezier_points[:1]:
            point.co.x -= 3.0
            point.handle_left.x -= 3.0
            point.handle_right.x -= 3.0
        ring.data.update_tag()
    yield
    shown = support.addon("core.interface.overlay").batches(bpy.context)
    assert len(shown) >= 2, shown
    yield from window_support.picture("path_edited")
    with window_support.override():
        bpy.ops.object.mode_set(mode='OBJECT')
