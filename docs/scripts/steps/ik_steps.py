"""Take the last bone, add a chain, drag it, weigh it, and see where it bends and reaches."""

import math

import bpy
from mathutils import Euler, Vector

import ik_arm
from window import window_support

from . import hand

DRAG_CHAIN = (31, 349)
"""Where the tool is in the toolbar, pixels."""


def steps(strip):
    """Generator: the five steps of the Inverse Kinematics page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    rig = ik_arm.build(Vector((0.0, 0.0, 0.0)), "Arm")
    rig.show_in_front = True
    yield from _look()
    yield from hand.click("Arm", hand.whole('OUTLINER'))
    yield from hand.over_view()
    yield from hand.key('TAB', ctrl=True)
    yield 0.3
    yield from hand.click_at(hand.pixel_of(rig.data.bones["Hand"].head_local * 0.5 + rig.data.bones["Hand"].tail_local * 0.5))
    yield from strip.shot(230, 160)

    yield from hand.on("IK on Hand", hand.box('UI'))
    yield from strip.shot(620, 80)
    yield from hand.click()

    yield from hand.enter("3", "Length", hand.box('UI'), beside=120)
    yield from hand.scroll(-10)
    yield from hand.click("Drag Chain", hand.box('UI'))
    yield from hand.press_at(*hand.pixel_of(rig.data.bones["Hand"].tail_local))
    yield from hand.drag_to(hand.place[0] - 10, hand.place[1] + 170)
    yield from strip.shot(260, 150)
    yield from hand.let_go()

    yield from hand.on("Drag Chain", hand.box('UI'))
    yield from hand.scroll(10)
    yield from hand.enter("0.5", "Position", hand.box('UI'), beside=120)
    yield from strip.shot(620, 280)

    yield from hand.enter("1", "Position", hand.box('UI'), beside=120)
    yield from hand.over_view()
    yield from hand.scroll(-4)
    yield from strip.shot(190, 200)

    yield from hand.scroll(2)
    yield from hand.click("As Bone", hand.box('UI'))
    yield from hand.click("New Control Bone", hand.box('UI'))
    yield from hand.over_view()
    yield from strip.panel("ik_control_bones", 240, 80, 1050, 720)

    yield from hand.click_at(DRAG_CHAIN)
    yield from hand.press_at(*hand.pixel_of(_tip(rig)))
    yield from hand.drag_to(hand.place[0] + 150, hand.place[1] + 90)
    yield from hand.let_go()
    yield from strip.panel("ik_panel", 0, 28, 1050, 720)


def _tip(rig):
    return rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["Hand"].tail


def _look():
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(80.0), 0.0, math.radians(20.0))).to_quaternion()
    view.view_location, view.view_distance = (0.35, 0.0, -0.25), 2.2
    yield
