"""Pulling a lattice with the mouse: the point stays under the cursor, one undo step, Esc puts all back."""

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from lattice import lattice_cases as cases
from window import window_support


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.object
    bpy.ops.motus.lattice_fit(objects=monkey.name)
    cases.only(monkey)
    with window_support.override():
        bpy.ops.view3d.view_axis(type='FRONT')
        bpy.ops.view3d.view_all()
    return monkey


def on_screen(place):
    """Place in the viewport's region, pixels."""
    region = window_support.region()
    return location_3d_to_region_2d(region, region.data, place)


def button(value, x, y, kind='LEFTMOUSE'):
    window_support.window().event_simulate(type=kind, value=value, x=x, y=y)


def positions():
    return cases.evaluated(bpy.data.objects["Suzanne"])


def points():
    return cases.points_of(bpy.data.objects["Suzanne"].modifiers[0].object)


def front_vertex():
    """A vertex on the forehead, seen from the front."""
    places = positions()
    return int((np.abs(places[:, 0] - 0.1) + np.abs(places[:, 2] - 0.6) + 0.5 * places[:, 1]).argmin())


def start(x_offset=0):
    """Generator: starts the operator and presses on a vertex; its value is (vertex, place pressed at)."""
    yield
    bpy.ops.ed.undo_push(message="built")
    with window_support.override():
        assert bpy.ops.motus.lattice_pull('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    yield
    vertex = front_vertex()
    region = window_support.region()
    place = on_screen(Vector(positions()[vertex].tolist()))
    x, y = round(region.x + place.x) + x_offset, round(region.y + place.y)
    window_support.move(x, y)
    yield
    button('PRESS', x, y)
    yield
    return vertex, x, y


def test_the_point_follows_the_mouse():
    build()
    vertex, x, y = yield from start()
    before, rest = positions(), points()
    origin = on_screen(Vector(before[vertex].tolist()))
    for step in ((10, 0), (40, 30), (-30, 60), (30, 40)):
        window_support.move(x + step[0], y + step[1])
        yield
        found = on_screen(Vector(positions()[vertex].tolist()))
        assert (found - origin - Vector(step)).length < 3.0, (step, found, origin)
    yield from window_support.picture("lattice_pull")
    button('RELEASE', x + 30, y + 40)
    yield
    after = positions()
    assert np.abs(after - before).max() > 0.05
    window_support.press('Z', x, y, ctrl=True)
    yield
    assert np.abs(positions() - before).max() < 1e-6, "it was not undone by one step"
    assert (points() == rest).all()
    window_support.press('Z', x, y, ctrl=True, shift=True)
    yield
    assert np.abs(positions() - after).max() < 1e-6, "it was not redone"


def test_escape_puts_back():
    for kind in ('ESC', 'RIGHTMOUSE'):
        build()
        _, x, y = yield from start()
        rest = points()
        window_support.move(x + 50, y + 20)
        yield
        assert (points() != rest).any(), "nothing was pulled"
        button('PRESS', x + 50, y + 20, kind)
        yield
        button('RELEASE', x + 50, y + 20, kind)
        button('RELEASE', x + 50, y + 20)
        yield
        assert (points() == rest).all()


def test_mirrored_by_a_key():
    build()
    yield
    with window_support.override():
        assert bpy.ops.motus.lattice_pull('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    yield
    region = window_support.region()
    vertex = front_vertex()
    place = on_screen(Vector(positions()[vertex].tolist()))
    x, y = round(region.x + place.x), round(region.y + place.y)
    window_support.move(x, y)
    yield
    window_support.press('X', x, y)
    yield
    rest = points()
    button('PRESS', x, y)
    yield
    window_support.move(x + 30, y + 50)
    yield
    button('RELEASE', x + 30, y + 50)
    yield
    change = (points() - rest).reshape(4, 4, 4, 3)
    assert np.abs(change).max() > 0.01
    assert np.abs(change[:, :, ::-1] * (-1, 1, 1) - change).max() < 1e-4


def test_a_press_beside_it_is_let_through():
    build()
    yield
    with window_support.override():
        assert bpy.ops.motus.lattice_pull('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    region = window_support.region()
    rest = points()
    x, y = region.x + 90, region.y + 30
    window_support.move(x, y)
    yield
    button('PRESS', x, y)
    button('RELEASE', x, y)
    yield
    button('PRESS', x, y, 'ESC')
    button('RELEASE', x, y, 'ESC')
    yield
    assert (points() == rest).all()


def test_the_panel_is_drawn():
    """As a popover: in the sidebar it is closed until somebody opens it."""
    monkey = build()
    lattice = monkey.modifiers[0].object
    for obj in (monkey, lattice):
        cases.only(obj)
        drawn = window_support.drawn_panels("Motus")
        yield
        with window_support.override():
            bpy.ops.wm.call_panel(name="MOTUS_PT_lattice", keep_open=True)
        yield
        assert "MOTUS_PT_lattice" in drawn, drawn
        yield from window_support.picture(f"lattice_panel_{obj.type.lower()}")
        x, y = window_support.centre()
        window_support.press('ESC', x, y)
        yield


def test_what_is_pulled_is_drawn():
    """During the drag and after it, without anything else that has the viewport drawn."""
    build()
    _, x, y = yield from start()
    paths = [(yield from window_support.picture("lattice_before"))]
    window_support.move(x + 60, y + 60)
    paths.append((yield from window_support.picture("lattice_during")))
    button('RELEASE', x + 60, y + 60)
    paths.append((yield from window_support.picture("lattice_after")))
    region = window_support.region()
    before, during, after = (viewport(path, region) for path in paths)
    assert np.abs(during - before).max(axis=2).mean() > 0.005, "nothing was drawn during the drag"
    assert np.abs(after - before).max(axis=2).mean() > 0.005, "nothing was drawn after the drag"


def test_reset_is_drawn():
    lattice = build().modifiers[0].object
    rest = points()
    for point in lattice.data.points:
        point.co_deform *= 0.5
    cases.only(lattice)
    yield
    pulled = yield from window_support.picture("lattice_pulled")
    with window_support.override():
        assert bpy.ops.motus.lattice_reset() == {'FINISHED'}
    reset = yield from window_support.picture("lattice_reset")
    assert (points() == rest).all()
    region = window_support.region()
    assert np.abs(viewport(reset, region) - viewport(pulled, region)).max(axis=2).mean() > 0.005, "nothing was drawn"


def viewport(path, region):
    """Of a picture the part that is the region, (height, width, 3)."""
    width, height, values = window_support.pixels(path)
    picture = np.array(values, np.float32).reshape(height, width, 4)
    return picture[region.y : region.y + region.height, region.x : region.x + region.width, :3]
