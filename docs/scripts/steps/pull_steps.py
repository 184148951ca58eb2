"""Take the tool, set the brush, pull, keep the pull as a pin, and key the pin; then the handles of several pins."""

import math

from mathutils import Euler

from window import window_support

from . import hand

SELECT_BOX, PICK_PULL = (31, 696), (31, 308)
"""Where these tools are in the toolbar, pixels."""
ADD = (1001, 645)
"""The button beside the list of pins."""


def steps(strip):
    """Generator: the five steps of the Pick & Pull page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    yield from hand.choose("Add", "Motus", "Grid Mesh", within=hand.box('HEADER'))
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(68.0), 0.0, math.radians(25.0))).to_quaternion()
    yield from hand.frame_view(zoom_out=2)
    yield from hand.click_at(PICK_PULL)
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

    yield from hand.click_at(SELECT_BOX)
    for place, up in (((3.0, -2.5, 0.0), 60), ((2.5, 3.0, 0.0), 90)):
        yield from _pin(place, up)
    x, y = hand.pixel_of((3.0, -2.5, 0.0))
    yield from hand.click_at((x, y + 60))
    yield from strip.panel("pull_handles", 250, 80, 1050, 720)


def _pin(place, up):
    """Add a pin at a place of the grid, and drag its handle upwards, by pixels."""
    x, y = hand.pixel_of(place)
    yield from hand.to(x, y)
    yield from hand.click(button='RIGHTMOUSE', shift=True)  # the 3D cursor goes there
    yield from hand.click_at(ADD)
    yield from hand.press_at(x, y)
    yield from hand.drag_to(x, y + up)
    yield from hand.let_go()
