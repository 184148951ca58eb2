"""A motion driver by the mouse: the right button's menu on a property, the dialog with its graph, the list in the sidebar."""

import bpy
import support
from window import window_support

STEP = 6  # pixels


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    cube = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", 'POINT'))
    bpy.context.scene.collection.objects.link(cube)
    cube.rotation_euler[1] = 0.25
    bpy.context.view_layer.objects.active = cube
    cube.select_set(True)
    return cube


def editor():
    """The properties editor's region with the object's transform, the same in all Blenders."""
    area = window_support.area('PROPERTIES')
    area.spaces.active.context = 'OBJECT'
    return area, next(one for one in area.regions if one.type == 'WINDOW')


def over():
    area, region = editor()
    return bpy.context.temp_override(window=window_support.window(), area=area, region=region)


def hover(wanted):
    """Generator: moves the mouse down the editor until it is over that property; its value is the place, or None."""
    _, region = editor()
    x = region.x + 11 * region.width // 20
    for y in range(region.y + region.height - STEP, region.y, -STEP):
        window_support.move(x, y)
        yield
        with over():
            if bpy.ops.ui.copy_data_path_button.poll():
                bpy.ops.ui.copy_data_path_button(full_path=False)
                if bpy.context.window_manager.clipboard.startswith(wanted):
                    return x, y
    return None


def test_from_the_menu_of_a_property_to_the_list():
    lamp = build()
    yield
    found = yield from hover("rotation_euler")
    assert found, "the editor shows no rotation"
    (x, y), under_mouse = found, support.addon("core.hovered")

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
    with over():
        if hasattr(bpy.context, "property"):
            bpy.ops.motus.driver_add('INVOKE_DEFAULT')
        else:
            bpy.ops.motus.driver_add('INVOKE_DEFAULT', datablock="Lamp", data_path="rotation_euler", index=1)
    yield
    yield from window_support.picture("driver_dialog")
    window_support.press('RET', x, y)
    yield from window_support.until(lambda: lamp.animation_data and lamp.animation_data.drivers)
    driven, = lamp.animation_data.drivers
    assert driven.data_path == "rotation_euler" and "motus_pendulum(frame" in driven.driver.expression

    drawn = yield from window_support.open_tab("Motus")
    assert "MOTUS_PT_drivers" in drawn, drawn
    yield from window_support.picture("driver_list")
    with window_support.override():
        bpy.ops.motus.driver_remove(datablock="Lamp", data_path="rotation_euler")
    assert not lamp.animation_data.drivers
