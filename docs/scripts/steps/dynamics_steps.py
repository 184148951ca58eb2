"""Key a move, add dynamics, choose a style, play, and loop it."""

import math

from mathutils import Euler

from window import window_support

from . import hand

MOVES = ((1, 0), (13, 4), (49, 4), (61, 0))
"""Frame, and place along X."""


def steps(strip):
    """Generator: the five steps of the Dynamics page."""
    yield from hand.fresh()
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(74.0), 0.0, math.radians(12.0))).to_quaternion()
    view.view_location, view.view_distance = (7.0, 0.0, 2.0), 16.0
    before = 0
    for frame, place in MOVES:
        yield from hand.to_frame(frame)
        yield from hand.move_along('X', place - before)
        yield from hand.key('I')
        before = place
    yield from hand.to_frame(13)
    yield from strip.shot(50, 395)

    yield from hand.on("Dynamics on Cube", hand.box('UI'))
    yield from strip.shot(620, 80, is_moved=True)
    yield from hand.click()

    yield from hand.click("Custom", hand.box('UI'))
    yield 0.5
    yield from hand.on("Bouncy")
    yield from strip.shot(620, 160)
    yield from hand.click()

    yield from hand.to_frame(15)
    yield from strip.shot(100, 300)
    yield from strip.panel("dynamics_panel", 0, 28, 1050, 720)

    yield from hand.click("Motion", hand.box('UI'))
    yield from hand.click("Loop", hand.box('UI'))
    yield from hand.click("Loop over the Scene", hand.box('UI'))
    yield from hand.to_frame(5)
    yield from strip.shot(150, 220)
