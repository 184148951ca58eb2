"""Handles of pins in the viewport: a click chooses, a drag takes the root along with the cursor, one undo step, Esc puts all back."""

import time
from math import hypot

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Euler, Vector

import support
from pull.pins import pin_cases
from window import window_support
from window.pull import pull_support as pull

NEAR = 1.5  # pixels
PLACES = ((-1.2, (0.0, 0.0, 0.8), "Hill"), (0.0, (0.0, 0.0, -0.5), "Hollow"), (1.2, (0.3, 0.0, 1.0), "Horn"))


def build(perspective=True, turn=(1.1, 0.0, 0.3)):
    """A grid with three pins, seen from a side."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    with window_support.override():
        grid = pin_cases.new_grid(61, 4.0)
    for x, way, name in PLACES:
        pin_cases.add(grid, pin_cases.vertex_at(grid, x, 0.0), way, radius=0.7, name=name)
    view = window_support.region().data
    view.view_perspective = 'PERSP' if perspective else 'ORTHO'
    view.view_rotation = Euler(turn).to_quaternion()
    with window_support.override():
        bpy.ops.view3d.view_selected()
    view.update()
    bpy.context.view_layer.update()
    bpy.ops.ed.undo_push(message="built")
    return grid


def grid():
    return bpy.data.objects["Grid"]


def root(index):
    """Where the root of a pin is seen in the world."""
    obj = grid()
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return evaluated.matrix_world @ evaluated.data.vertices[obj.motus.pull.pins[index].vertex].co


def seen(index):
    """Pixel of the window that a pin's root is seen at."""
    region = window_support.region()
    place = location_3d_to_region_2d(region, region.data, root(index))
    return round(place.x + region.x), round(place.y + region.y)


def off(index, cursor):
    region = window_support.region()
    place = location_3d_to_region_2d(region, region.data, root(index))
    return hypot(place.x + region.x - cursor[0], place.y + region.y - cursor[1])


def beside(place, dx, dy):
    return place[0] + dx, place[1] + dy


def ways():
    return [tuple(pin.displacement) for pin in grid().motus.pull.pins]


def hover(place):
    """Generator: the mouse comes over a place, so that Blender knows what lies there."""
    for step in (6, 3, 1, 0):
        window_support.move(place[0] + step, place[1])
        yield


def drag(index, dx, dy, release=True):
    """Generator: takes a handle along; its value is where the cursor is."""
    start = seen(index)
    yield from hover(start)
    yield from pull.drag('LEFTMOUSE', start, beside(start, dx, dy), release=release)
    return beside(start, dx, dy)


def test_click_chooses():
    build()
    before = ways()
    yield
    for index in (0, 2, 1):
        place = seen(index)
        yield from hover(place)
        window_support.press('LEFTMOUSE', *place)
        yield
        assert grid().motus.pull.active_pin == index, (index, grid().motus.pull.active_pin)
    yield from window_support.picture("pins_handles")
    assert ways() == before
    assert grid().select_get(), "the press went on to the viewport"
    pull.undo()
    yield
    assert grid().motus.pull.active_pin == 2


def drags(**view):
    build(**view)
    yield
    for index, way in ((0, (60, 40)), (1, (-40, 70)), (2, (30, -50))):
        before = ways()
        cursor = yield from drag(index, *way)
        assert off(index, cursor) <= NEAR, (index, off(index, cursor))
        after = ways()
        assert after[index] != before[index] and grid().motus.pull.active_pin == index
        assert [way for other, way in enumerate(after) if other != index] == ([way for other, way in enumerate(before) if other != index])
        pull.undo()
        yield
        assert ways() == before, "it was not undone by one step"
        pull.redo()
        yield
        assert ways() == after
    yield from window_support.picture("pins_handles_dragged")


def test_drag_in_perspective():
    yield from drags()


def test_drag_orthographic():
    yield from drags(perspective=False)


def test_drag_behind_modifiers_and_at_half_strength():
    """What turns and shortens the root's way is made up for."""
    obj = build()
    obj.rotation_euler, obj.scale = (0.2, 0.3, 0.5), (1.0, 0.6, 1.3)
    twist = obj.modifiers.new("Twist", 'SIMPLE_DEFORM')
    twist.deform_method, twist.angle, twist.deform_axis = 'BEND', 0.6, 'Z'
    obj.motus.pull.pins[0].strength = 0.4
    obj.motus.pull.influence = 0.8
    bpy.context.view_layer.update()
    yield
    cursor = yield from drag(0, 25, 20)
    assert off(0, cursor) <= 3.0, off(0, cursor)
    assert abs(obj.motus.pull.pins[0].strength - 0.4) < 1e-6


def test_axes_and_numbers():
    build()
    start = root(0)
    yield
    cursor = yield from drag(0, 50, 60, release=False)
    for axis_index, axis in enumerate('XYZ'):
        yield from pull.key(axis, *cursor)
        way = root(0) - start
        assert abs(way[axis_index]) > 0.01, (axis, way)
        assert all(abs(part) < 1e-5 for other, part in enumerate(way) if other != axis_index), (axis, way)
    for one in ('ZERO', 'PERIOD', 'FIVE'):
        yield from pull.key(one, *cursor)
    yield from window_support.picture("pins_handles_axis")
    yield from pull.key('RET', *cursor)
    pull.simulate('LEFTMOUSE', 'RELEASE', *cursor)
    yield
    assert (root(0) - start - Vector((0.0, 0.0, 0.5))).length < 1e-5, root(0) - start


def test_escape_puts_back():
    for key in ('ESC', 'RIGHTMOUSE'):
        obj = build()
        obj.motus.pull.active_pin = 2
        before = ways()
        yield
        cursor = yield from drag(0, 60, 60, release=False)
        assert ways() != before
        pull.simulate(key, 'PRESS', *cursor)
        yield
        pull.simulate(key, 'RELEASE', *cursor)
        pull.simulate('LEFTMOUSE', 'RELEASE', *cursor)
        yield
        assert ways() == before and obj.motus.pull.active_pin == 2, key


def test_muted_pins_are_chosen_and_not_dragged():
    obj = build()
    obj.motus.pull.pins[0].is_muted = True
    bpy.context.view_layer.update()
    before = ways()
    yield
    yield from drag(0, 40, 40)
    assert ways() == before and obj.motus.pull.active_pin == 2
    place = seen(0)
    yield from hover(place)
    window_support.press('LEFTMOUSE', *place)
    yield
    assert obj.motus.pull.active_pin == 0


def test_the_viewport_is_closed_meanwhile():
    """As a script may do it: the drag ends, and all is as it was."""
    build()
    with window_support.override():
        bpy.ops.screen.area_split(direction='VERTICAL', factor=0.6)
    yield
    before, count = ways(), len(window_support.window().screen.areas)
    yield from drag(0, 60, 40, release=False)
    assert ways() != before
    with window_support.override():
        bpy.ops.screen.area_close()
    assert len(window_support.window().screen.areas) == count - 1
    yield
    x, y = window_support.centre()
    for step in range(3):
        window_support.move(x + 10 * step, y)
        yield
    pull.simulate('LEFTMOUSE', 'RELEASE', x, y)
    yield
    assert ways() == before
    cursor = yield from drag(0, 60, 40)
    assert off(0, cursor) <= NEAR, "the viewport that is left does not work"


def test_hidden_handles_are_not_picked():
    for hide in ("gizmos", "overlay", "tool"):
        obj = build()
        space = window_support.area().spaces.active
        if hide == "gizmos":
            space.show_gizmo = False
        elif hide == "overlay":
            bpy.context.scene.motus.show_pull = False
        else:
            pull.take_tool()
        place = seen(0)
        yield from hover(place)
        window_support.press('LEFTMOUSE', *place)
        yield
        space.show_gizmo, bpy.context.scene.motus.show_pull = True, True
        with window_support.override():
            bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
        assert obj.motus.pull.active_pin == 2, hide


def test_rest_in_edit_mode():
    build()
    with window_support.override():
        bpy.ops.object.mode_set(mode='EDIT')
    overlay = support.addon("core.interface.overlay")
    with window_support.override():
        assert any("rest" in note for note in overlay.notes(bpy.context))
    yield from window_support.open_tab("Motus")
    yield from window_support.picture("pins_rest")
    with window_support.override():
        bpy.ops.object.mode_set(mode='OBJECT')
        assert overlay.notes(bpy.context) == []


def test_a_thousand_handles():
    """Drawing and picking them takes little of the processor."""
    obj = build()
    setup, system = support.addon("pull.pins.setup"), support.addon("pull").SYSTEM
    settings = obj.motus.pull
    with support.addon("core.settings.entries").unwired(settings):
        for number in range(997):
            vertex = 3 * number
            setup._append(
                obj,
                f"Many {number}",
                {"vertex": vertex, "place": obj.data.vertices[vertex].co, "displacement": (0.0, 0.0, 0.1), "radius": 0.05},
            )
    support.addon("core.wiring").refresh(system, obj)
    bpy.context.view_layer.update()
    yield
    handles = support.addon("pull.pins.handles")
    depsgraph = bpy.context.evaluated_depsgraph_get()
    started = time.process_time()
    for _ in range(20):
        found = handles.read(obj, depsgraph)
    spent = (time.process_time() - started) / 20
    assert len(found.indices) == 1000 and not np.isnan(found.places).any()
    assert spent < 0.1
    yield from window_support.picture("pins_thousand")
    cursor = yield from drag(500, 0, 60)
    assert off(settings.active_pin, cursor) <= NEAR
