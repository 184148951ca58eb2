"""The sidebar's Motus tab opens and draws."""

import bpy

import support
from window import window_support

SENTENCES = (
    "Landscape has a Multiresolution modifier: apply it or remove it first",
    "Some chains have no target that they could reach for: the list says why",
    "A property that is to be driven is gone, has another driver, or is another file's; what is left is driven",
)
AROUND = 80.0
"""Pixels of the sidebar that its tabs, margins and a message's icon take."""


class _Lines(list):
    """A layout that keeps its labels."""

    def box(self):
        return self

    def column(self, align):
        return self

    def label(self, text, icon, translate):
        self.append(text)


def test_key_opens_the_sidebar():
    space = window_support.area().spaces.active
    space.show_region_ui = False
    yield
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    window_support.press('N', x, y)
    yield
    assert space.show_region_ui


def test_tab_draws_its_panels():
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("sidebar")
    assert drawn, "no panel of the tab was drawn"

    width, height, values = window_support.pixels(path)
    window = window_support.window()
    assert (width, height) == (window.width, window.height)
    brightness = {round(value, 2) for value in values[0::4]}
    assert len(brightness) > 20, "the picture shows no interface"


def test_messages_fit_into_the_sidebar():
    yield from window_support.open_tab("Motus")
    scale = bpy.context.preferences.system.ui_scale
    sidebar, lines = window_support.region('UI'), _Lines()
    with bpy.context.temp_override(window=window_support.window(), area=window_support.area(), region=sidebar):
        for sentence in SENTENCES:
            support.addon("core.interface.ui").draw_message(lines, sentence, 'INFO')
    assert " ".join(lines) == " ".join(SENTENCES)
    widest = max(window_support.text_width(line) for line in lines)
    assert widest <= sidebar.width - AROUND * scale, (widest, sidebar.width, lines)
