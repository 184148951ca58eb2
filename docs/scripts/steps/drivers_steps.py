"""Point at a property, choose the motion, play, find it again, and change it."""

from . import hand

MENU = 990, 0, 1280, 760
DIALOG = 700, 0, 1280, 600
"""(left, bottom, right, top) in the window."""
TURN_X = 60
"""Pixels from the label of a rotation to its number."""


def steps(strip):
    """Generator: the five steps of the Motion Drivers page."""
    yield from hand.fresh()
    yield from _open_menu()
    yield from hand.on("Add Motion Driver", MENU)
    yield from strip.shot(860, 420)
    yield from hand.click()
    yield 0.5

    yield from hand.enter("2", "Length", beside=150)
    yield from strip.shot(730, 372)
    yield from strip.panel("drivers_dialog", 736, 275, 1130, 793)
    yield from hand.click("OK")

    yield from hand.to_frame(34)
    yield from strip.shot(350, 150)

    yield from hand.on("Motion Drivers", hand.box('UI'))
    yield from strip.shot(620, 80)

    yield from _open_menu()
    yield from hand.click("Edit Motion Driver", MENU)
    yield 0.5
    yield from hand.click("Pendulum", DIALOG)
    yield 0.5
    yield from hand.click("Noise")
    yield 0.5
    yield from strip.shot(400, 275)


def _open_menu():
    """The menu that the right button opens on the rotation about Y."""
    yield from hand.on("Y", hand.whole('PROPERTIES'))
    x, y = hand.place
    yield from hand.to(x + TURN_X, y - 68)
    yield from hand.click(button='RIGHTMOUSE')
    yield 0.3
