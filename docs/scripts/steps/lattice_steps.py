"""Choose an object, fit a lattice, set it, pull, and keep the shape."""

import math

from mathutils import Euler, Vector

from window import window_support

from . import hand

EAR = Vector((1.25, -0.05, 0.55))
CHIN = Vector((0.0, -0.7, -0.9))
"""Both on Blender's monkey."""


def steps(strip):
    """Generator: the five steps of the Lattice page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    yield from hand.choose("Add", "Mesh", "Monkey", within=hand.box('HEADER'))
    view = window_support.area().spaces.active.region_3d
    view.view_rotation = Euler((math.radians(80.0), 0.0, math.radians(15.0))).to_quaternion()
    view.view_location, view.view_distance = (0.6, 0.0, 0.0), 9.0
    yield from hand.on("Fit Lattice", hand.box('UI'))
    yield from strip.shot(620, 80, is_moved=True)
    yield from hand.click()
    yield from hand.click("Fit Lattice", (0, 60, 300, 130))
    yield from hand.enter("5", "Z", (0, 60, 400, 400), beside=80)
    yield from strip.shot(60, 320)

    yield from hand.click("Pull Lattice", hand.box('UI'))
    yield from strip.shot(620, 80)

    yield from hand.press_at(*hand.pixel_of(EAR))
    yield from hand.drag_to(hand.place[0] + 40, hand.place[1] + 60)
    yield from strip.shot(300, 180)
    yield from hand.let_go()

    yield from hand.click("Pull Lattice", hand.box('UI'))
    yield from hand.press_at(*hand.pixel_of(CHIN))
    yield from hand.drag_to(hand.place[0], hand.place[1] - 60)
    yield from hand.let_go()
    yield from hand.click("Suzanne", hand.whole('OUTLINER'))
    yield from strip.shot(210, 110)
