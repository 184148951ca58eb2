"""Give the camera two eyes, look through both, choose the screen, fit the budget to it, and check the frames."""

from . import hand

DIALOG = 600, 60, 1270, 450
"""(left, bottom, right, top) in the window."""


def steps(strip):
    """Generator: the five steps of the Stereo Cameras page."""
    yield from hand.fresh()
    yield from hand.click("Camera", hand.whole('OUTLINER'))
    yield from hand.on("Add Stereo Rig", hand.box('UI'))
    yield from strip.shot(620, 80, is_moved=True)
    yield from hand.click()

    yield from hand.over_view()
    yield from strip.shot(290, 120, has_mouse=False)

    yield from hand.click("Anaglyph View", hand.box('UI'))
    yield from hand.over_view()
    yield from strip.shot(330, 210, has_mouse=False)
    yield from hand.click("Anaglyph View", hand.box('UI'))

    yield from hand.click("Television", hand.box('UI'))
    yield 0.5
    yield from hand.click("Cinema")
    yield from hand.on("Fit to Screen", hand.box('UI'))
    yield from strip.shot(620, 300, is_moved=True)
    yield from hand.click()

    yield from hand.click("Check Stereo", hand.box('UI'))
    yield 0.5
    yield from hand.click("OK", DIALOG)
    yield 20.0
    yield from hand.on("Measured Parallax", hand.box('UI'))
    yield from hand.scroll(-11)
    yield from strip.shot(200, 180)
