"""Take the tool, set the brush, pull, keep the pull as a pin, and key the pin."""

import math

from mathutils import Euler

from window import window_support

from . import hand


def steps(strip):
    """Generator: the five steps of the Pick & Pull page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    yield from hand.choose("Add", "Motus", "Grid Mesh", within=hand.box('HEADER'))
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(68.0), 0.0, math.radians(25.0))).to_quaternion()
    yield from hand.frame_view(zoom_out=2)
    yield from hand.click_at((31, 308))
    yield from strip.shot(0, 190)

    yield from hand.over_view()
    yield from hand.key('F')
    yield from hand.to(hand.place[0] + 70, hand.place[1])
    yield from strip.shot(310, 170)
    yield from hand.click()

    yield from hand.press_at(*hand.pixel_of((-1.0, 0.5, 0.0)))
    yield 3.5
    yield from strip.shot(250, 150)
    yield from hand.let_go()

    yield from hand.click("Pin Last Pull", hand.box('UI'))
    yield from hand.over_view()
    yield from strip.shot(620, 80)
    yield from hand.enter("1.8", "Strength", hand.box('UI'), beside=120)
    yield from strip.shot(200, 100)
    yield from strip.panel("pull_panel", 250, 80, 1050, 720)
