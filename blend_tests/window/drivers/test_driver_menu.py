"""A motion driver by the mouse: the right button's menu on a property, the dialog with its graph, the list in the sidebar."""

import bpy

import support
from window import properties_editor, window_support


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    cube = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", 'POINT'))
    bpy.context.scene.collection.objects.link(cube)
    cube.rotation_euler[1] = 0.25
    bpy.context.view_layer.objects.active = cube
    cube.select_set(True)
    return cube


def test_from_the_menu_of_a_property_to_the_list():
    lamp = build()
    yield from properties_editor.opened()
    found = yield from properties_editor.hover("rotation_euler")
    assert found, "the editor shows no rotation"
    (x, y), under_mouse = found, support.addon("core.interface.view.hovered")

    hovered, as_it_is = [], under_mouse.find
    under_mouse.find = lambda *arguments, **keywords: hovered.append(as_it_is(*arguments, **keywords)) or hovered[-1]
    try:
        window_support.press('RIGHTMOUSE', x, y)
        yield from window_support.until(lambda: hovered)
        yield from window_support.picture("driver_menu")
    finally:
        under_mouse.find = as_it_is
    assert hovered and hovered[0] is not None and hovered[0][:2] == (lamp, "rotation_euler"), hovered
    window_support.press('ESC', x, y)
    yield

    window_support.move(x, y + 1)
    yield
    window_support.move(x, y)
    yield
    with properties_editor.over():
        if hasattr(bpy.context, "property"):
            bpy.ops.motus.driver_add('INVOKE_DEFAULT')
        else:
            bpy.ops.motus.driver_add('INVOKE_DEFAULT', datablock="Lamp", data_path="rotation_euler", index=1)
    yield
    yield from window_support.picture("driver_dialog")
    window_support.press('RET', x, y)
    yield from window_support.until(lambda: lamp.animation_data and lamp.animation_data.drivers)
    (driven,) = lamp.animation_data.drivers
    assert driven.data_path == "rotation_euler" and "motus_pendulum(frame" in driven.driver.expression

    drawn = yield from window_support.open_tab("Motus")
    assert "MOTUS_PT_drivers" in drawn, drawn
    yield from window_support.picture("driver_list")
    with window_support.override():
        bpy.ops.motus.driver_remove(datablock="Lamp", data_path="rotation_euler")
    assert not lamp.animation_data.drivers


def test_a_second_one_from_the_sidebar_leaves_the_first():
    lamp = build()
    lamp.driver_add("rotation_euler", 1).driver.expression = "frame * 0.01"
    bpy.ops.motus.driver_add(datablock="Lamp", data_path="rotation_euler", index=0)
    yield from window_support.open_tab("Motus")
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.motus.driver_add('INVOKE_DEFAULT')
    yield
    yield from window_support.picture("driver_second")
    window_support.press('RET', x, y)
    yield from window_support.until(lambda: len(lamp.animation_data.drivers) == 3)
    expressions = {driven.array_index: driven.driver.expression for driven in lamp.animation_data.drivers}
    assert expressions[1] == "frame * 0.01" and all("motus_pendulum" in expressions[index] for index in (0, 2)), expressions


def open_dialog(**keywords):
    """Generator: the dialog of the rotation about Y, and the scene playing behind it."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    scene = bpy.context.scene
    scene.frame_set(20)
    with window_support.override():
        bpy.ops.motus.driver_add('INVOKE_DEFAULT', datablock="Lamp", data_path="rotation_euler", index=1, **keywords)
    seen = set()
    yield from window_support.until(lambda: seen.add((scene.frame_current, bpy.data.objects["Lamp"].rotation_euler[1])) or len(seen) > 4)
    return x, y, seen


def test_the_motion_is_seen_behind_the_dialog_and_taken_back():
    lamp = build()
    bpy.ops.ed.undo_push(message="Before")
    x, y, seen = yield from open_dialog(function='SINE', frequency=2.0)
    assert len({frame for frame, _ in seen}) > 2 and len({turn for _, turn in seen}) > 2, seen
    assert "motus_sine(frame, 2)" in lamp.animation_data.drivers[0].driver.expression
    yield from window_support.picture("driver_live")
    window_support.press('ESC', x, y)
    yield from window_support.until(lambda: not bpy.context.screen.is_animation_playing)
    assert lamp.animation_data is None and lamp.rotation_euler[1] == 0.25, (lamp.animation_data, lamp.rotation_euler)
    assert bpy.context.scene.frame_current == 20


def test_what_is_accepted_is_one_step_of_undo():
    build()
    bpy.ops.ed.undo_push(message="Before")
    x, y, _ = yield from open_dialog(function='SINE', frequency=2.0)
    window_support.press('RET', x, y)
    yield from window_support.until(lambda: not bpy.context.screen.is_animation_playing)
    assert bpy.context.scene.frame_current == 20
    (driven,) = bpy.data.objects["Lamp"].animation_data.drivers
    assert driven.driver.expression == "0.25 + motus_sine(frame, 2)", driven.driver.expression
    with window_support.override():
        bpy.ops.ed.undo()
    yield
    lamp = bpy.data.objects["Lamp"]
    assert lamp.animation_data is None and lamp.rotation_euler[1] == 0.25
