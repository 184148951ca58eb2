"""Take the head, let it look, move the target, share the turn, and see who looks where."""

import math

import bpy
from mathutils import Euler

import look_at_figure
from window import window_support

from . import hand


def steps(strip):
    """Generator: the five steps of the Look At page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    look_at_figure.build()
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(80.0), 0.0, math.radians(35.0))).to_quaternion()
    view.view_location, view.view_distance = (0.35, -0.3, 1.2), 2.6
    yield from hand.over_view()
    yield from hand.click("Figure", hand.whole('OUTLINER'))
    yield from strip.shot(200, 100)

    yield from hand.on("Look At with Head", hand.box('UI'))
    yield from strip.shot(620, 80, is_moved=True)
    yield from hand.click()

    target = bpy.data.objects["Figure Head Target"]
    yield from hand.click_at(hand.pixel_of(target.location))
    yield from hand.move_along('X', 0.8)
    yield from strip.shot(200, 100)
    yield from hand.click("Figure", hand.whole('OUTLINER'))
    yield from hand.enter("0.8", "Body", hand.box('UI'), beside=120)
    yield from strip.shot(620, 80)
    yield from hand.enter("0.3", "Body", hand.box('UI'), beside=120)
    yield from hand.enter("1", "Eyes", hand.box('UI'), beside=120)
    yield from strip.shot(200, 90)
    yield from strip.panel("look_at_panel", 0, 28, 1050, 720)
