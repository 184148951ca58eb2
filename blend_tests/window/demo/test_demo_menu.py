"""Each demo scene is built from the list in the menu, as an artist chooses it."""

from functools import partial

import bpy

import support
from window import window_support

SCENES = support.addon("demo.scenes").SCENES


def _perspective():
    return window_support.area().spaces.active.region_3d.view_perspective


def _build(number):
    """Generator: chooses an item of the list by the keyboard, with nothing selected."""
    previous = window_support.window().scene
    window_support.area().spaces.active.region_3d.view_perspective = 'PERSP'
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.wm.call_menu(name="MOTUS_MT_demo")
    yield
    for key in ("HOME", *number * ("DOWN_ARROW",), "RET"):
        window_support.press(key, x, y)
        yield
    yield from window_support.until(lambda: window_support.window().scene != previous)
    built = window_support.window().scene
    assert built != previous, f"{SCENES[number].label} was not built"
    done = bpy.context.window_manager.operators[-1]
    assert (done.bl_idname, done.properties.system) == ("MOTUS_OT_demo_scene", SCENES[number].identifier), done.bl_idname
    assert built.camera, "it has no camera"
    yield from window_support.until(lambda: _perspective() == 'CAMERA')
    assert _perspective() == 'CAMERA', "the viewport does not look through the scene's camera"
    yield from window_support.picture(f"demo_{SCENES[number].name}")


globals().update({f"test_{demo.name}": partial(_build, number) for number, demo in enumerate(SCENES)})


def test_the_list_stands_in_the_add_menu():
    """Where F3 finds its items, too."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.wm.call_menu(name="MOTUS_MT_add")
    yield
    yield from window_support.picture("menu_add_with_demos")
    window_support.press('ESC', x, y)
    yield
