"""Handles of an emitter: radius, speed and cone angle are dragged, one undo step each, Esc puts all back."""

import math
from unittest import mock

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Euler

import support
from window import window_support
from window.pull import pull_support as mouse


def build(shape='CONE', **settings):
    """An emitter that is active, seen from a side."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.context.scene.frame_set(1)
    with window_support.override():
        bpy.ops.motus.snow_add(
            location=(0.0, 0.0, 2.0), shape=shape, emitter_radius=1.0, cone_angle=0.5, start_speed=3.0, rate=200.0, **settings
        )
    view = window_support.region().data
    view.view_perspective = 'ORTHO'
    view.view_rotation = Euler((1.3, 0.0, 0.2)).to_quaternion()
    view.view_location, view.view_distance = (0.0, 0.0, 1.5), 7.0
    view.update()
    bpy.context.view_layer.update()
    bpy.ops.ed.undo_push(message="built")


def emitter():
    return bpy.data.objects["Snow"]


def settings():
    return emitter().motus.snow


def seen(setting):
    """Pixel of the window that the handle of a setting is seen at."""
    names, places = support.addon("snow.dragging").places(emitter())
    region = window_support.region()
    place = location_3d_to_region_2d(region, region.data, places[names.index(setting)])
    return round(place.x + region.x), round(place.y + region.y)


def drag(setting, dx, dy, release=True):
    """Generator: takes a handle along."""
    start = seen(setting)
    for step in (6, 3, 1, 0):
        window_support.move(start[0] + step, start[1])
        yield
    yield from mouse.drag('LEFTMOUSE', start, (start[0] + dx, start[1] + dy), release=release)
    return start[0] + dx, start[1] + dy


def off(setting, cursor):
    place = seen(setting)
    return math.hypot(place[0] - cursor[0], place[1] - cursor[1])


def test_each_handle_follows_the_cursor():
    build()
    yield
    yield from window_support.picture("snow_handles")
    before = {name: getattr(settings(), name) for name in ("emitter_radius", "start_speed", "cone_angle")}
    cursor = yield from drag("emitter_radius", -60, 0)
    assert settings().emitter_radius > 1.3, settings().emitter_radius
    mouse.undo()
    yield
    assert settings().emitter_radius == before["emitter_radius"], "it was not undone by one step"
    mouse.redo()
    yield
    assert settings().emitter_radius > 1.3
    cursor = yield from drag("start_speed", 0, -40)
    assert settings().start_speed > before["start_speed"] and off("start_speed", cursor) <= 6.0
    before_angle = settings().cone_angle
    yield from drag("cone_angle", 50, 20)
    assert settings().cone_angle > before_angle + 0.1
    assert settings().start_speed != before["start_speed"]
    yield from window_support.picture("snow_handles_dragged")


def test_escape_puts_it_back():
    build('SQUARE')
    yield
    before = settings().emitter_radius
    place = yield from drag("emitter_radius", -60, 0, release=False)
    assert settings().emitter_radius != before
    window_support.press('ESC', *place)
    yield
    assert settings().emitter_radius == before
    mouse.simulate('LEFTMOUSE', 'RELEASE', *place)
    yield


def test_an_emitter_that_is_removed_while_the_drag_waits():
    build('SQUARE')
    yield
    place, ended = seen("emitter_radius"), []
    dragging = support.addon("core.interface.dragging.drag").PointDrag
    cancel = dragging.cancel

    def noted(self, context):
        ended.append(True)
        cancel(self, context)

    with mock.patch.object(dragging, "cancel", noted):
        with window_support.override():
            bpy.ops.motus.snow_drag('INVOKE_DEFAULT')
        yield
        bpy.data.objects.remove(emitter())
        yield from mouse.drag('LEFTMOUSE', place, place, steps=1)
        yield
    assert ended, "the drag was not given up"


def test_none_of_what_leaves_a_mesh_or_is_seen_by_a_camera():
    build('SQUARE')
    yield
    handles = support.addon("snow.handles")
    assert [one.setting for one in handles.of(settings())] == ["emitter_radius", "start_speed"]
    settings().random_orientation = True
    assert len(handles.of(settings())) == 3
    for shape in ('SURFACE', 'CAMERA'):
        settings().shape = shape
        assert handles.of(settings()) == []
    yield
