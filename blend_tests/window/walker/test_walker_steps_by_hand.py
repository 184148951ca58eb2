"""Handles of a walker's steps, and the chart of their times: they are dragged, one undo step each, and Esc puts all back."""

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

import support
from walker import walker_cases as cases
from walker.test_walker_soles import biped
from window import window_support
from window.pull import pull_support as mouse


def build():
    """A biped that walks, seen from above; its body is active."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    with window_support.override():
        body, _ = biped(use_plane=True)
        cases.select(body, [])
    bpy.context.scene.frame_set(40)
    view = window_support.region().data
    view.view_perspective = 'ORTHO'
    view.view_rotation = (1.0, 0.0, 0.0, 0.0)
    view.view_location, view.view_distance = (-0.6, 0.9, 0.0), 4.0
    view.update()
    bpy.context.view_layer.update()
    bpy.ops.ed.undo_push(message="built")
    return handle(False)


def entries():
    return bpy.data.objects["Body"].motus.walker.steps


def handle(turns, leg=0):
    """The first handle of a leg that moves it, or turns it."""
    with window_support.override():
        found = support.addon("walker.steps.handles").of(bpy.context, bpy.data.objects["Body"])
    return next(one for one in found if one.turns == turns and one.step.leg == leg)


def seen(place):
    region = window_support.region()
    pixel = location_3d_to_region_2d(region, region.data, place)
    return round(pixel.x + region.x), round(pixel.y + region.y)


def drag(turns, dx, dy, release=True):
    start = seen(handle(turns).place)
    for step in (6, 3, 1, 0):
        window_support.move(start[0] + step, start[1])
        yield
    yield from mouse.drag('LEFTMOUSE', start, (start[0] + dx, start[1] + dy), release=release)
    return start[0] + dx, start[1] + dy


def test_a_step_is_dragged_and_turned():
    before = build()
    yield
    yield from window_support.picture("walker_steps")
    cursor = yield from drag(False, 40, 25)
    assert len(entries()) == 1, len(entries())
    now = handle(False)
    place = seen(now.place)
    assert abs(place[0] - cursor[0]) <= 3 and abs(place[1] - cursor[1]) <= 3, (place, cursor)
    assert (Vector(now.place) - Vector(before.place)).length > 0.05
    yield from drag(True, 30, -30)
    assert len(entries()) == 1 and abs(entries()[0].turn) > 0.1, entries()[0].turn
    yield from window_support.picture("walker_steps_dragged")
    mouse.undo()
    yield
    assert entries()[0].turn == 0.0
    mouse.undo()
    yield
    assert len(entries()) == 0, "it was not undone by one step"
    mouse.redo()
    yield
    assert len(entries()) == 1


def test_escape_puts_it_back():
    build()
    yield
    place = yield from drag(False, 40, 25, release=False)
    assert len(entries()) == 1
    window_support.press('ESC', *place)
    yield
    assert len(entries()) == 0
    mouse.simulate('LEFTMOUSE', 'RELEASE', *place)
    yield


def chart_end(moment, leg=0):
    """Where the first end of a leg's bars is in the window, and its frame. moment: "touch" or "lift"."""
    region = window_support.region()
    with window_support.override():
        drawn = support.addon("walker.steps.chart").Chart.of(bpy.context, bpy.data.objects["Body"], region)
    end = next(one for one in drawn.ends() if one.moment == moment and one.step.leg == leg)
    return round(drawn.x(end.seconds)) + region.x, round(drawn.y(leg)) + region.y, end.seconds / cases.seconds(1.0), drawn


def drag_end(moment, frames, release=True):
    x, y, frame, drawn = chart_end(moment)
    for step in (6, 3, 1, 0):
        window_support.move(x + step, y)
        yield
    across = round(drawn.x(drawn.now + cases.seconds(frames)) - drawn.x(drawn.now))
    yield from mouse.drag('LEFTMOUSE', (x, y), (x + across, y), release=release)
    return frame, (x + across, y)


def test_a_step_is_timed_in_the_chart():
    build()
    bpy.context.scene.motus.show_walker_times = True
    yield
    frame, _ = yield from drag_end("lift", 5.0)
    assert len(entries()) == 1, len(entries())
    entry = entries()[0]
    assert entry.use_lift and not entry.use_touch and entry.lift == round(entry.lift), entry.lift
    assert abs(entry.lift - frame - 5.0) <= 1.5, (entry.lift, frame)
    yield from window_support.picture("walker_times")
    _, _, now, _ = chart_end("lift")
    assert abs(now - entry.lift) < 1e-9, now
    mouse.undo()
    yield
    assert len(entries()) == 0, "it was not undone by one step"
    mouse.redo()
    yield
    assert len(entries()) == 1


def test_escape_puts_the_time_back():
    build()
    bpy.context.scene.motus.show_walker_times = True
    yield
    _, place = yield from drag_end("touch", 4.0, release=False)
    assert len(entries()) == 1
    window_support.press('ESC', *place)
    yield
    assert len(entries()) == 0
    mouse.simulate('LEFTMOUSE', 'RELEASE', *place)
    yield
