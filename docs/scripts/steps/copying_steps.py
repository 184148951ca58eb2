"""Keep settings as a preset with a picture, open the shelf of presets, and drag one onto an object."""

import bpy
from mathutils import Vector

import support
from window import window_support

from . import hand

ARROW = 50
"""Pixels from the sidebar's right edge to the middle of a panel's menu arrow, beside its tabs."""


def steps(strip):
    """Generator: the five steps of the page about presets of one's own."""
    if support.module_name() not in bpy.context.preferences.addons:  # `blender --addons` enables it without preferences
        support.disable()
        support.enable()
    yield from hand.fresh()
    with window_support.override():
        bpy.ops.mesh.primitive_torus_add(location=(4.0, 0.0, 0.0))
        bpy.ops.view3d.view_all()
    torus, cube = bpy.data.objects["Torus"], bpy.data.objects["Cube"]
    torus.select_set(False)
    cube.select_set(True)
    bpy.context.view_layer.objects.active = cube
    yield from hand.click("Dynamics on Cube", hand.box('UI'))
    yield from hand.click("Custom", hand.box('UI'))
    yield 0.5
    yield from hand.click("Bouncy")
    yield from hand.click("Motion", hand.box('UI'))
    yield 0.5
    _, y = yield from hand.at("Bake", hand.box('UI'))
    yield from hand.click_at((hand.box('UI')[2] - ARROW, y))
    yield 0.5
    yield from hand.on("Keep as Asset")
    yield from strip.shot(800, 380, is_moved=True)

    yield from hand.click()
    yield 0.5
    yield from hand.enter("Bouncy", "Name", beside=120)
    yield from hand.on("Picture")
    yield from strip.shot(790, 420, is_moved=True)
    yield from hand.key('RET')
    yield 0.5

    yield from hand.menu("View", within=(hand.whole('VIEW_3D')))
    yield from hand.on("Motus Presets")
    yield from strip.shot(60, 60, is_moved=True)
    yield from hand.click()
    yield 3.0

    region = next(one for one in window_support.area().regions if one.type == 'ASSET_SHELF')
    yield from hand.press_at(region.x + 40, region.y + region.height - 40)
    yield from strip.shot(0, 350)

    yield from hand.drag_to(*hand.pixel_of(torus.location + Vector((1.0, 0.0, 0.0))))
    yield from strip.shot(0, 350)
    yield from hand.let_go()
    bpy.context.preferences.addons[support.module_name()].preferences.show_preset_shelf = False
