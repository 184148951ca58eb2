"""Take the waist of a figure that walks, add a layer, give it a throw, let it come softly, and soften its border."""

import math

import bpy
from mathutils import Euler

import layers_pictures
from window import window_support

from . import hand

LABELS = 110
"""Pixels of the sidebar that labels take."""
LAP, THROWN = 24, 10
"""Frames of a lap of the walk, and that on which the throw is at its widest."""


def steps(strip):
    """Generator: the five steps of the page of animation layers."""
    yield from hand.fresh()
    yield from hand.empty_view()
    rig = _walker()
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(82.0), 0.0, math.radians(38.0))).to_quaternion()
    view.view_location, view.view_distance = (0.15, 0.0, 0.85), 3.4
    yield
    yield from hand.click("Figure", hand.whole('OUTLINER'))
    yield from hand.over_view()
    yield from hand.key('TAB', ctrl=True)
    yield 0.3
    bone = rig.pose.bones["Waist"]
    yield from hand.click_at(hand.pixel_of(0.5 * bone.head + 0.5 * bone.tail))
    yield from strip.shot(200, 140)

    yield from hand.on("Add Layer", hand.box('UI'))
    yield from strip.shot(620, 80)
    yield from hand.click()

    left, bottom, _, top = hand.box('UI')
    yield from hand.click("Action", (left, bottom, left + LABELS, top), beside=120)
    yield 0.5
    yield from hand.on("Throw")
    yield from strip.shot(620, 160)
    yield from hand.type_text("Throw")
    yield 0.5
    yield from hand.key('RET')

    yield from hand.to_frame(THROWN)
    yield from hand.on("Animation Layers", hand.box('UI'))
    yield from hand.scroll(-4)
    yield from hand.enter("4", "Blend In", hand.box('UI'), beside=120)
    yield from strip.shot(620, 240)

    yield from hand.enter("2", "Feather", hand.box('UI'), beside=120)
    yield from strip.shot(190, 100)
    yield from hand.scroll(20)
    yield from strip.panel("layers_panel", 0, 28, 1050, 720)


def _walker():
    """The figure, which walks on the spot; beside it an action by the name of Throw."""
    layers_pictures.throw_action(((1, 0.0), (THROWN, 1.0), (2 * THROWN, 0.0)))
    rig = layers_pictures.figure(0.0, "Figure")
    rig.show_in_front = True
    bpy.context.scene.collection.objects.unlink(rig)
    bpy.context.collection.objects.link(rig)  # with its parts, which the outliner then shows folded below it
    walk = layers_pictures.WALK
    for frame, turns in ((1, walk), (1 + LAP // 2, _mirrored(walk)), (1 + LAP, walk)):
        layers_pictures.key_pose(rig, turns, frame)
    bpy.context.scene.frame_end = LAP
    bpy.context.scene.frame_set(1)
    layers_pictures.dress(rig)
    return rig


def _mirrored(turns):
    """The same step on the other foot."""
    sides = {".L": ".R", ".R": ".L"}
    return {name[:-2] + sides.get(name[-2:], name[-2:]): (x, -y, -z) for name, (x, y, z) in turns.items()}
