"""Add snow, choose its kind, let it land, give flakes another look, and look at it from the camera."""

from . import hand

MATERIAL_PREVIEW = 989, 760
"""The button in the viewport's header, from the lower left of the window."""


def steps(strip):
    """Generator: the five steps of the Snow page."""
    yield from hand.fresh()
    yield from hand.on("Add Snow", hand.box('UI'))
    yield from strip.shot(620, 120, is_moved=True)
    yield from hand.click()

    yield from hand.over_view()
    yield from strip.shot(200, 80, has_mouse=False)

    yield from hand.click("Gentle Snow", hand.box('UI'))
    yield 0.5
    yield from hand.on("Blizzard")
    yield from strip.shot(620, 80)
    yield from hand.click()

    yield from hand.click("Collision", hand.box('UI'))
    yield from hand.click("Ground", hand.box('UI'))
    yield from hand.to_frame(60)
    yield from strip.shot(620, 400)

    yield from hand.over_view()
    yield from hand.key('A', alt=True)
    yield from hand.key('NUMPAD_0')
    yield from hand.click_at(MATERIAL_PREVIEW)
    yield from hand.over_view()
    yield 6.0
    yield from strip.shot(150, 150, has_mouse=False)
