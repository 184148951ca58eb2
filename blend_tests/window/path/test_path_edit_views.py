"""Edit Views in the window: Blender's quad view fitted to the curve, a visible way back, and everything as it was."""

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

import support
from window import window_support

KNOTS = ((-3.0, 0.0, 0.0), (2.0, 4.0, 1.0), (14.0, 1.0, 3.0))
NAMES = ("view_perspective", "view_rotation", "view_location", "view_distance", "lock_rotation", "is_orthographic_side_view")


def build():
    """A curve that is active, in Edit Mode, before a camera that the scene has."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    data = bpy.data.curves.new("Course", 'CURVE')
    data.dimensions = '3D'
    spline = data.splines.new('BEZIER')
    spline.bezier_points.add(len(KNOTS) - 1)
    for point, place in zip(spline.bezier_points, KNOTS):
        point.co, point.handle_left_type, point.handle_right_type = place, 'AUTO', 'AUTO'
    curve = bpy.data.objects.new("Course", data)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    for obj in (curve, camera):
        bpy.context.scene.collection.objects.link(obj)
    bpy.context.scene.camera = camera
    bpy.context.view_layer.objects.active = curve
    curve.select_set(True)
    with window_support.override():
        bpy.ops.object.mode_set(mode='EDIT')
    return curve


def space():
    return window_support.area().spaces.active


def windows():
    return [region for region in window_support.area().regions if region.type == 'WINDOW']


def matrix(view):
    """What is seen. Blender 3.4 begins with a rotation that is not quite of length 1."""
    turned = view.view_matrix.to_3x3().normalized()
    return tuple(round(value, 4) + 0.0 for row in (*turned, view.view_matrix.translation) for value in row)


def state():
    view = space().region_3d
    found = [getattr(view, name) for name in NAMES]
    return [tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value for value in found] + [
        matrix(view),
        space().use_local_camera,
        len(windows()),
    ]


def run(**keywords):
    with window_support.override():
        return bpy.ops.motus.path_edit_views('INVOKE_DEFAULT', **keywords)


def assert_all_seen(curve):
    """In the views from the front, the top and the right, and not below a header, toolbar or sidebar."""
    over = [one for one in window_support.area().regions if one.type in {'HEADER', 'TOOL_HEADER', 'TOOLS', 'UI'}]
    for region in windows()[:3]:
        for place in (curve.matrix_world @ Vector(corner) for corner in curve.bound_box):
            seen = location_3d_to_region_2d(region, region.data, place)
            assert 0 < seen.x < region.width and 0 < seen.y < region.height, (seen, region.width, region.height)
            x, y = seen.x + region.x, seen.y + region.y
            assert not [one.type for one in over if one.x <= x < one.x + one.width and one.y <= y < one.y + one.height], (x, y)


def there_and_back(perspective):
    curve = build()
    view = space().region_3d
    view.view_location, view.view_distance, view.view_perspective = (1.0, 2.0, 3.0), 17.0, perspective
    yield
    before, is_dirty = state(), bpy.data.is_dirty
    counts = len(bpy.data.objects), len(bpy.data.collections), len(bpy.data.cameras)
    assert run() == {'FINISHED'}
    yield
    assert len(windows()) == 4 and all(region.data.view_perspective == 'ORTHO' for region in windows()[:3])
    assert_all_seen(curve)
    assert (len(bpy.data.objects), len(bpy.data.collections), len(bpy.data.cameras)) == counts
    assert bpy.data.is_dirty == is_dirty
    yield from window_support.picture(f"path_edit_views_{perspective.lower()}")
    yield from window_support.open_tab("Motus")
    yield from window_support.picture(f"path_edit_views_panel_{perspective.lower()}")
    space().show_region_ui = False
    yield
    assert run() == {'FINISHED'}  # once more goes back
    yield
    assert state() == before, (state(), before)


def test_there_and_back():
    yield from there_and_back('PERSP')


def test_back_to_the_camera():
    yield from there_and_back('CAMERA')


def test_the_header_leads_back():
    build()
    yield
    before = state()
    run(view='ALL')
    yield
    draws = [name for name in bpy.types.VIEW3D_MT_editor_menus.draw._draw_funcs if "edit_views" in name.__module__]
    assert len(draws) == 1
    assert run(view='LEAVE') == {'FINISHED'}
    yield
    assert state() == before, (state(), before)


def test_beside_an_open_sidebar():
    curve = build()
    yield from window_support.open_tab("Motus")
    for view in ('ALL', 'TOP'):
        run(view=view)
        yield
        if view == 'ALL':
            assert_all_seen(curve)
        yield from window_support.picture(f"path_edit_views_sidebar_{view.lower()}")
    run(view='LEAVE')
    space().show_region_ui = False
    yield


def test_the_way_back_from_a_maximised_area():
    build()
    yield
    before, views = state(), support.addon("path.edit_views")
    run(view='ALL')
    yield
    for is_maximised in (True, False):
        with window_support.override():
            bpy.ops.screen.screen_full_area()
        yield
        with window_support.override():
            assert views.is_on(bpy.context), is_maximised
    run(view='LEAVE')
    yield
    assert state() == before, (state(), before)


def test_another_file_has_none():
    build()
    yield
    views = support.addon("path.edit_views")
    run(view='TOP')
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    with window_support.override():
        assert not views.is_on(bpy.context)
    assert not views._before._kept


def test_a_quad_view_of_the_artists_own_stays():
    curve = build()
    yield
    with window_support.override():
        bpy.ops.screen.region_quadview()
    yield
    before = [matrix(region.data) for region in windows()]
    run(view='ALL')
    yield
    assert_all_seen(curve)
    run(view='LEAVE')
    yield
    assert [matrix(region.data) for region in windows()] == before
    with window_support.override():
        bpy.ops.screen.region_quadview()
    yield


def test_left_by_blenders_own_key():
    build()
    yield
    run(view='ALL')
    yield
    with window_support.override():
        bpy.ops.screen.region_quadview()
    yield
    before = state()
    assert run() == {'FINISHED'}
    yield
    assert len(windows()) == 4, "what is left is no edit view any more"
    run()
    yield
    assert state() == before, (state(), before)


def test_single_views():
    build()
    yield
    before = state()
    for view in ('TOP', 'SIDE', 'ALL', 'TOP'):
        assert run(view=view) == {'FINISHED'}
        yield
        assert len(windows()) == (4 if view == 'ALL' else 1)
    yield from window_support.picture("path_edit_view_top")
    run(view='LEAVE')
    yield
    assert state() == before, (state(), before)
