"""A session of Pick & Pull in the window: buttons, keys, Enter, Esc, undo and redo, in the modes."""

import bpy
import numpy as np
from mathutils import Euler

from window import window_support
from window.pull import pull_support as pull

brush = lambda: bpy.context.scene.motus.pull  # noqa: E731


def ends(dx=60, dy=0):
    """A way about the middle of the viewport."""
    x, y = window_support.centre()
    return (x - dx, y - dy), (x + dx, y + dy)


def test_up_down_and_enter():
    pull.build()
    flat = pull.places()
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends())
    top = pull.heights().max()
    assert top > 0.05, top
    assert pull.heights().min() >= 0.0
    x, y = window_support.centre()
    yield from pull.drag('RIGHTMOUSE', (x - 42, y + 84), (x + 42, y + 84))
    assert pull.heights().min() < -0.05
    assert pull.heights().max() == top, "the second stroke was not meant for the first's hill"
    after = pull.places()
    assert abs(pull.evaluated_top() - top) < 1e-6
    yield from pull.key('RET')
    assert pull.pulling() is None
    yield from pull.undo_and_redo(flat, after)
    assert abs(pull.evaluated_top() - top) < 1e-6


def test_escape_restores_every_bit():
    pull.build()
    grid = bpy.data.objects["Grid"]
    rng = np.random.default_rng(3)
    values = rng.normal(size=3 * len(grid.data.vertices)).astype(np.float32) * 1e-3 + pull.places()
    grid.data.vertices.foreach_set("co", values)
    grid.data.update()
    before = pull.places()
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends())
    assert not np.array_equal(pull.places(), before)
    yield from pull.key('ESC')
    assert pull.pulling() is None
    assert np.array_equal(pull.places().view(np.uint32), before.view(np.uint32))
    # In the middle of a stroke.
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends(), release=False)
    assert not np.array_equal(pull.places(), before)
    yield from pull.key('ESC')
    assert pull.pulling() is None
    assert np.array_equal(pull.places().view(np.uint32), before.view(np.uint32))


def test_a_mouse_without_pressure_pulls_fully():
    pull.build()
    brush().use_pressure_strength = brush().use_pressure_size = True
    yield from pull.session()
    x, y = window_support.centre()
    pull.simulate('LEFTMOUSE', 'PRESS', x, y)
    yield
    pull.simulate('LEFTMOUSE', 'RELEASE', x, y)
    yield
    top = pull.heights().max()
    assert 0.09 < top < 0.35, top  # one dab of 0.1, and few if the machine is slow
    yield from pull.key('ESC')


def test_held_still_it_goes_on():
    pull.build()
    yield from pull.session()
    x, y = window_support.centre()
    pull.simulate('LEFTMOUSE', 'PRESS', x, y)
    yield
    first = pull.heights().max()
    yield from window_support.until(lambda: pull.heights().max() > first + 0.2)
    assert pull.heights().max() > first + 0.2
    pull.simulate('LEFTMOUSE', 'RELEASE', x, y)
    yield
    last = pull.heights().max()
    yield 0.4
    assert pull.heights().max() == last, "released it stops"
    yield from pull.key('ESC')


def test_control_inverts_and_shift_smooths():
    pull.build()
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends(), ctrl=True)
    bottom = pull.heights().min()
    assert bottom < -0.05
    yield from pull.drag('LEFTMOUSE', *ends(), steps=15, shift=True)
    assert pull.heights().min() > bottom, "smoothing did not raise the pit"
    yield from pull.key('ESC')


def test_without_accumulate_the_bump_follows_the_mouse():
    pull.build()
    brush().accumulate, brush().strength = False, 0.5
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends(84), steps=20)
    found = pull.heights()
    assert abs(found.max() - 0.5) < 0.02, found.max()
    grid = bpy.data.objects["Grid"].data
    peak = grid.vertices[int(found.argmax())].co
    assert peak.x > 0.2, "it stayed where it began"
    left = [vertex.co.z for vertex in grid.vertices if vertex.co.x < peak.x - 0.9]
    assert max(left) == 0.0, "what the mouse has left is not flat again"
    yield from pull.key('ESC')


def test_numbers_are_typed():
    pull.build()
    yield from pull.session()
    for one in ('ZERO', 'PERIOD', 'THREE'):
        yield from pull.key(one)
    assert abs(brush().strength - 0.3) < 1e-6
    yield from pull.key('RET')
    assert pull.pulling() is not None, "Enter ended the session instead of the number"
    yield from pull.key('F')
    yield from pull.key('TWO')
    assert abs(brush().radius - 2.0) < 1e-6
    yield from pull.key('RET')
    assert pull.pulling().adjustment is None
    yield from pull.key('ESC')
    assert pull.pulling() is None


def test_wheel_zooms_as_under_the_tool():
    pull.build()
    yield from pull.session()
    x, y = window_support.centre()
    far, radius = view_distance(), brush().radius
    pull.simulate('WHEELUPMOUSE', 'PRESS', x, y)
    yield
    near = view_distance()
    assert near < far and brush().radius == radius, (far, near, brush().radius)
    yield from pull.key('ESC')
    with window_support.override():
        bpy.ops.wm.tool_set_by_id(name="motus.pick_pull")
    yield
    pull.simulate('WHEELUPMOUSE', 'PRESS', x, y)
    yield
    assert view_distance() < near and brush().radius == radius, (near, view_distance(), brush().radius)


def view_distance():
    return window_support.area().spaces.active.region_3d.view_distance


def test_brackets_and_f_change_radius_and_strength():
    pull.build()
    yield from pull.session()
    x, y = window_support.centre()
    yield from pull.key('RIGHT_BRACKET')
    assert brush().radius > 0.8
    yield from pull.key('LEFT_BRACKET')
    assert abs(brush().radius - 0.8) < 1e-6
    yield from pull.key('F')
    window_support.move(x + 40, y)
    yield
    wide = brush().radius
    assert wide > 0.8
    yield from window_support.picture("pull_adjust_radius")
    yield from pull.key('RIGHTMOUSE', x + 40, y)
    assert abs(brush().radius - 0.8) < 1e-6, "the right button did not take the radius back"
    yield from pull.key('F')
    window_support.move(x + 80, y)
    yield
    yield from pull.key('LEFTMOUSE', x + 80, y)
    assert brush().radius > 0.8
    assert pull.heights().max() == 0.0, "the click that confirms has pulled"
    strength = brush().strength
    yield from pull.key('F', shift=True)
    window_support.move(x + 140, y)
    yield
    yield from pull.key('LEFTMOUSE', x + 140, y)
    assert brush().strength > strength
    yield from pull.key('ESC')


def test_step_back_within_the_session():
    pull.build()
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends())
    first = pull.places()
    yield from pull.drag('LEFTMOUSE', *ends(0, 60))
    assert not np.array_equal(pull.places(), first)
    yield from pull.key('Z', ctrl=True)
    assert pull.pulling() is not None
    assert np.array_equal(pull.places(), first)
    yield from pull.key('ESC')


def test_keys_change_the_brush():
    pull.build()
    yield from pull.session()
    yield from pull.key('X')
    assert brush().mirror == {'X'}
    yield from pull.key('A')
    assert not brush().accumulate
    yield from pull.key('D')
    assert brush().direction != 'Z'
    yield from pull.key('O')
    assert brush().falloff != 'SMOOTH'
    yield from pull.key('ESC')


def test_the_view_can_be_turned():
    pull.build()
    view = window_support.region().data
    yield from pull.session()
    before = view.view_rotation.copy()
    yield from pull.key('NUMPAD_1')
    yield
    assert view.view_rotation.rotation_difference(before).angle > 0.5
    assert pull.pulling() is not None
    yield from pull.key('ESC')


def test_in_edit_mode():
    yield from in_mode('EDIT')


def test_in_sculpt_mode():
    yield from in_mode('SCULPT')


def in_mode(mode):
    pull.build(mode)
    flat = pull.places()
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends())
    assert pull.heights().max() > 0.05
    yield from window_support.picture(f"pull_{mode.lower()}")
    yield from pull.key('ESC')
    assert np.array_equal(pull.places(), flat)
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends())
    one = pull.places()
    yield from pull.key('RET')
    yield from pull.session()
    yield from pull.drag('RIGHTMOUSE', *ends(0, 80))
    two = pull.places()
    yield from pull.key('RET')
    for act, wanted in ((pull.undo, one), (pull.undo, flat), (pull.redo, one), (pull.redo, two), (pull.undo, one)):
        act()
        yield
        assert bpy.context.object.mode == mode
        assert np.array_equal(pull.places(), wanted)
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends(30, 30))
    assert not np.array_equal(pull.places(), one)
    yield from pull.key('RET')
    pull.undo()
    yield
    assert np.array_equal(pull.places(), one)


def evaluated():
    """(n, 3) of what Blender shows of the grid."""
    mesh = bpy.data.objects["Grid"].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    values = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3)


def test_a_stroke_becomes_a_pin():
    """Nothing is seen to change by it; with the pin's strength at 0 the mesh is as before the stroke."""
    pull.build()
    brush().strength = 0.03
    flat = pull.places()
    yield from pull.session()
    yield from pull.drag('LEFTMOUSE', *ends(105, 42), steps=25)
    yield from pull.key('RET')
    stroked = evaluated()
    assert stroked[:, 2].max() > 0.1
    window_support.region().data.view_rotation = Euler((1.0, 0.0, 0.4)).to_quaternion()
    before = yield from window_support.picture("stroke")
    with window_support.override():
        assert bpy.ops.motus.pin_add(from_last=True) == {'FINISHED'}
    (pin,) = bpy.data.objects["Grid"].motus.pull.pins
    assert np.array_equal(pull.places(), flat)
    assert np.abs(evaluated() - stroked).max() < 2.5e-7
    pinned = yield from window_support.picture("stroke_pinned")
    pin.strength = 0.0
    without = yield from window_support.picture("stroke_strength_0")
    assert np.array_equal(evaluated().ravel(), flat)
    before, pinned, without = (viewport(path) for path in (before, pinned, without))
    assert np.abs(pinned - before).mean() < 1e-3, np.abs(pinned - before).mean()
    assert np.abs(without - before).mean() > 5e-3, np.abs(without - before).mean()


def viewport(path):
    """The middle of the viewport in a picture, (height, width, 3)."""
    width, height, values = window_support.pixels(path)
    (x, y), one = window_support.centre(), window_support.region()
    picture = np.array(values, np.float32).reshape(height, width, 4)
    return picture[y - one.height // 3 : y + one.height // 3, x - one.width // 3 : x + one.width // 3, :3]
