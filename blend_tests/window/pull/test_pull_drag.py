"""Pick & Pull with the direction Cursor: the vertex that was pressed on stays under the cursor, in a session and with the tool."""

from math import hypot

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Euler, Vector

from window import window_support
from window.pull import pull_support as pull

NEAR = 1.5  # pixels


def build(mode='OBJECT', turn=(0.9, 0.0, 0.4), perspective=True):
    """The grid, seen from a side, and the brush that goes along with the cursor."""
    pull.build(mode)
    bpy.context.scene.motus.pull.direction = 'CURSOR'
    view = window_support.region().data
    view.view_perspective = 'PERSP' if perspective else 'ORTHO'
    view.view_rotation = Euler(turn).to_quaternion()
    view.update()


def world(vertex):
    grid = bpy.data.objects["Grid"]
    return grid.matrix_world @ Vector(pull.places().reshape(-1, 3)[vertex])


def seen(vertex):
    """Where a vertex is in the window."""
    region = window_support.region()
    place = location_3d_to_region_2d(region, region.data, world(vertex))
    return place.x + region.x, place.y + region.y


def middle():
    """The middle vertex, and the pixel that it is seen at."""
    vertex = len(bpy.data.objects["Grid"].data.vertices) // 2
    return vertex, tuple(round(part) for part in seen(vertex))


def off(vertex, cursor):
    x, y = seen(vertex)
    return hypot(x - cursor[0], y - cursor[1])


def beside(place, dx, dy):
    return place[0] + dx, place[1] + dy


def hover(place):
    """Generator: the tool reads the mesh."""
    for step in range(4):
        window_support.move(place[0] + 3 - step, place[1])
        yield


def held_in_session():
    """Generator: a session in which the middle vertex is dragged and held; its value is (vertex, place before, cursor)."""
    build()
    vertex, start = middle()
    before = world(vertex)
    yield from pull.session()
    end = beside(start, 42, 70)
    yield from pull.drag('LEFTMOUSE', start, end, release=False)
    return vertex, before, end


def session_in(mode, **view):
    build(mode, **view)
    vertex, _ = middle()
    flat = pull.places()
    yield from pull.session()
    for way in ((84, 28), (-35, 63), (7, -56)):
        start = tuple(round(part) for part in seen(vertex))
        end = beside(start, *way)
        yield from pull.drag('LEFTMOUSE', start, end)
        assert off(vertex, end) <= NEAR, (way, off(vertex, end))
    assert pull.pulling() is not None
    after = pull.places()
    yield from window_support.picture(f"pull_drag_{mode.lower()}")
    yield from pull.key('RET')
    assert pull.pulling() is None
    yield from pull.undo_and_redo(flat, after)


def test_session_in_object_mode():
    yield from session_in('OBJECT')


def test_session_in_edit_mode():
    yield from session_in('EDIT', perspective=False)


def test_session_in_sculpt_mode():
    yield from session_in('SCULPT')


def tool_in(mode):
    build(mode)
    pull.take_tool()
    vertex, start = middle()
    yield from hover(start)
    flat = pull.places()
    end = beside(start, 49, 60)
    yield from pull.drag('LEFTMOUSE', start, end)
    assert pull.pulling() is None
    assert off(vertex, end) <= NEAR, off(vertex, end)
    after = pull.places()
    yield from pull.drag('LEFTMOUSE', end, beside(end, 28, 0), release=False)
    assert not np.array_equal(pull.places(), after)
    yield from pull.key('ESC', *beside(end, 28, 0))
    assert pull.pulling() is None
    pull.simulate('LEFTMOUSE', 'RELEASE', *beside(end, 28, 0))
    yield
    assert np.array_equal(pull.places().view(np.uint32), after.view(np.uint32))
    yield from pull.undo_and_redo(flat, after)


def test_tool_in_object_mode():
    yield from tool_in('OBJECT')


def test_tool_in_edit_mode():
    yield from tool_in('EDIT')


def test_tool_in_sculpt_mode():
    yield from tool_in('SCULPT')


def test_axes_are_locked_and_let_go():
    vertex, before, end = yield from held_in_session()
    for index, axis in enumerate('XYZ'):
        yield from pull.key(axis, *end)
        way = world(vertex) - before
        assert abs(way[index]) > 0.01, (axis, way)
        assert [part for other, part in enumerate(way) if other != index] == [0.0, 0.0], (axis, way)
    assert pull.pulling().stroke.axis == 'Z'
    yield from window_support.picture("pull_drag_axis")
    yield from pull.key('Z', *end)
    assert off(vertex, end) <= NEAR
    assert bpy.context.scene.motus.pull.mirror == set(), "an axis of the drag has switched the mirror"
    yield from pull.key('X', *end)
    pull.simulate('LEFTMOUSE', 'RELEASE', *end)
    yield
    way = world(vertex) - before
    assert way.x and not way.y and not way.z
    yield from pull.key('X')
    assert bpy.context.scene.motus.pull.mirror == {'X'}, "between drags X is the mirror's"
    yield from pull.key('ESC')


def test_shift_is_precise():
    vertex, _, end = yield from held_in_session()
    window_support.move(*beside(end, 100, -50), shift=True)
    yield
    assert off(vertex, beside(end, 10, -5)) <= NEAR, off(vertex, beside(end, 10, -5))
    yield from window_support.picture("pull_drag_precise")
    window_support.move(*beside(end, 120, -50))
    yield
    assert off(vertex, beside(end, 30, -5)) <= NEAR, "without Shift it goes on from there"
    yield from pull.key('RET', *end)
    yield from pull.key('ESC', *end)
    assert pull.pulling() is None


def test_numbers_are_typed():
    vertex, before, end = yield from held_in_session()
    free = world(vertex) - before
    for one in ('ZERO', 'PERIOD', 'FIVE'):
        yield from pull.key(one, *end)
    assert (world(vertex) - before - 0.5 * free.normalized()).length < 1e-5
    window_support.move(*beside(end, 30, 0))
    yield
    yield from pull.key('Z', *end)
    assert (world(vertex) - before - Vector((0.0, 0.0, 0.5))).length < 1e-6
    yield from pull.key('RET', *end)
    assert pull.pulling() is not None and not pull.pulling().is_stroking
    assert abs(bpy.context.scene.motus.pull.strength - 0.1) < 1e-6
    pull.simulate('LEFTMOUSE', 'RELEASE', *end)
    yield
    assert (world(vertex) - before - Vector((0.0, 0.0, 0.5))).length < 1e-6
    yield from pull.key('Z', ctrl=True)
    assert world(vertex) == before
    yield from pull.key('RET')
    assert pull.pulling() is None


def test_cancelled_every_bit_is_as_before():
    """By Esc and the right button only the drag is taken back, and the session goes on."""
    build()
    vertex, start = middle()
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', start, beside(start, 20, 30))
    first = pull.places()
    for button in ('ESC', 'RIGHTMOUSE'):
        start = tuple(round(part) for part in seen(vertex))
        end = beside(start, 42, 70)
        yield from pull.drag('LEFTMOUSE', start, end, release=False)
        assert not np.array_equal(pull.places(), first)
        yield from pull.key(button, *end)
        assert pull.pulling() is not None and not pull.pulling().is_stroking, button
        pull.simulate('LEFTMOUSE', 'RELEASE', *end)
        yield
        assert np.array_equal(pull.places().view(np.uint32), first.view(np.uint32)), button
    yield from pull.key('RET')


def test_d_comes_to_it():
    build()
    bpy.context.scene.motus.pull.direction = 'Z'
    yield from pull.session()
    yield from pull.key('D')
    assert bpy.context.scene.motus.pull.direction == 'CURSOR'
    yield from window_support.picture("pull_drag_header")
    yield from pull.key('ESC')
