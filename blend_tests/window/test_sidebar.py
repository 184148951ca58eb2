"""The sidebar's Motus tab opens and draws."""

import window_support


def test_key_opens_the_sidebar():
    space = window_support.area().spaces.active
    space.show_region_ui = False
    yield 0.3
    x, y = window_support.centre()
    window_support.move(x, y)
    yield 0.2
    window_support.press('N', x, y)
    yield 0.5
    assert space.show_region_ui


def test_tab_draws_its_panels():
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("sidebar")
    assert drawn, "no panel of the tab was drawn"

    width, height, values = window_support.pixels(path)
    assert (width, height) == (1280, 800)
    brightness = {round(value, 2) for value in values[0::4]}
    assert len(brightness) > 20, "the picture shows no interface"
