"""Dragging a pendulum's end bob with the mouse: it stays under the cursor, one undo step, Esc puts all back."""

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from pendulum import pendulum_cases as cases
from window import window_support

KEPT = ("angle1", "angle2", "velocity1", "velocity2", "start_frame")


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.context.scene.frame_set(1)
    bpy.ops.motus.pendulum_add(kind='DOUBLE', location=(0.0, 0.0, 0.0), angle1=0.4, angle2=-0.4, velocity2=1.0)
    bpy.context.scene.frame_set(20)
    bpy.ops.motus.pendulum_play(play='PAUSE')
    with window_support.override():
        bpy.ops.view3d.view_axis(type='FRONT')
        bpy.ops.view3d.view_all()


def pivot():
    return bpy.data.objects["Pendulum"]


def bob():
    return pivot().motus.pendulum.rods[1].bob


def settings():
    return [getattr(pivot().motus.pendulum, name) for name in KEPT]


def on_screen():
    """Where the end bob is in the window, pixels."""
    region = window_support.region()
    place = location_3d_to_region_2d(region, region.data, Vector(cases.place(bob()).tolist()))
    return np.array((region.x + place.x, region.y + place.y))


def button(value, x, y, kind='LEFTMOUSE'):
    window_support.window().event_simulate(type=kind, value=value, x=int(x), y=int(y))


def start():
    """Generator: starts the operator and presses on the end bob; its value is the place pressed at."""
    yield
    bpy.ops.ed.undo_push(message="built")
    with window_support.override():
        assert bpy.ops.motus.pendulum_drag('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    yield
    x, y = (round(value) for value in on_screen())
    window_support.move(x, y)
    yield
    button('PRESS', x, y)
    yield
    return x, y


def test_the_bob_follows_the_mouse():
    build()
    x, y = yield from start()
    before, origin = settings(), on_screen()
    for step in ((-20, 30), (-60, 60), (40, 90)):
        window_support.move(x + step[0], y + step[1])
        yield
        assert np.abs(on_screen() - origin - step).max() < 3.0, (step, on_screen(), origin)
    yield from window_support.picture("pendulum_drag")
    button('RELEASE', x + 40, y + 90)
    yield
    after = settings()
    assert after[2:] == [0.0, 0.0, 20.0], after
    window_support.press('Z', x, y, ctrl=True)
    yield
    assert settings() == before, "it was not undone by one step"


def test_escape_puts_back():
    for kind in ('ESC', 'RIGHTMOUSE'):
        build()
        x, y = yield from start()
        before = settings()
        window_support.move(x + 40, y + 50)
        yield
        assert settings() != before, "nothing was dragged"
        button('PRESS', x + 40, y + 50, kind)
        yield
        assert settings() == before
