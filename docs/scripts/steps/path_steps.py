"""Choose an object and a curve, let it follow, set the time, lean it into the bends, and edit the curve."""

import math

from mathutils import Euler

from window import window_support

from . import hand


def steps(strip):
    """Generator: the five steps of the Follow Path page."""
    yield from hand.fresh()
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(60.0), 0.0, math.radians(25.0))).to_quaternion()
    view.view_location, view.view_distance = (1.5, 0.0, 0.0), 20.0
    yield from hand.choose("Add", "Curve", "Circle", within=hand.box('HEADER'))
    yield from hand.over_view()
    yield from hand.key('S')
    yield from hand.type_text("4")
    yield from hand.key('RET')
    yield from hand.click_at(hand.pixel_of((0.0, 0.0, 0.0)))
    yield from hand.click_at(hand.pixel_of((0.0, -4.0, 0.0)), shift=True)
    yield from hand.on("Follow Path", hand.box('UI'))
    yield from strip.shot(620, 80)
    yield from hand.click()

    yield from hand.enter("5", "Duration", hand.box('UI'), beside=120)
    yield from hand.to_frame(30)
    yield from strip.shot(620, 80)

    yield from hand.click("World Up", hand.box('UI'))
    yield 0.5
    yield from hand.on("Banking")
    yield from strip.shot(620, 300)
    yield from hand.click()

    yield from hand.to_frame(80)
    yield from strip.shot(200, 300)
    yield from strip.panel("path_panel", 0, 28, 1050, 720)

    yield from hand.click_at(hand.pixel_of((0.0, 4.0, 0.0)))
    yield from hand.key('TAB')
    yield from hand.key('A', alt=True)
    yield from hand.click_at(hand.pixel_of((4.0, 0.0, 0.0)))
    yield from hand.key('G')
    yield from hand.to(hand.place[0] + 60, hand.place[1] + 60)
    yield from hand.click()
    yield from strip.shot(200, 250)
    yield from hand.click("Edit Views", hand.box('UI'))
    yield from strip.panel("path_edit_views", 0, 28, 1050, 720)
