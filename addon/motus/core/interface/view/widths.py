"""Estimate what fits into a region: labels beside fields, or inside the fields if there is too little room."""

import math

import bpy

CHARACTER_WIDTH = 6.5
"""Average width of a character of the interface's font, in pixels at an interface scale of 1."""
NARROW = 210.0
"""Width of a region, in pixels at an interface scale of 1, up to which it has no room for labels beside fields."""
MARGINS, LABELS = 46.0, 0.4
"""Pixels at an interface scale of 1 beside labels and fields, and the share of the remaining width that labels have."""
PADDING = 8.0
"""Pixels at an interface scale of 1 that Blender leaves around the text of a label."""
BOX = 22.0
"""Width of a checkbox among the fields, or of the margins of an item in a row, in pixels at an interface scale of 1."""

HEADER, ICON = 78.0, 22.0
"""Width that a panel's header needs for its arrow, its grip and the tabs beside it, and of a button there, in pixels at an interface scale of 1."""


def width():
    """Width of the region that is drawn, in pixels at an interface scale of 1.

    It is infinite for dialogs and redo panels, which are as wide as their content needs.
    """
    region = bpy.context.region
    if region is None or region.type in {'HUD', 'TEMPORARY'}:
        return math.inf
    return region.width / bpy.context.preferences.system.ui_scale


def of_text(text):
    """Estimated width of a text in pixels at an interface scale of 1."""
    return CHARACTER_WIDTH * len(text)


def label_fits(text):
    """Whether the region that is drawn has room for a label beside its field."""
    return width() > max(NARROW, MARGINS + (of_text(text) + PADDING) / LABELS)


def title_fits(text, buttons):
    """Whether the region that is drawn has room for the title of a panel beside so many buttons in its header."""
    return width() > HEADER + of_text(text) + ICON * buttons


def switch_fits(text):
    """Whether the region that is drawn has room for the label of a checkbox among the fields."""
    return (width() - MARGINS) * (1.0 - LABELS) > BOX + of_text(text)


def items_fit(texts):
    """Whether the region that is drawn has room for items of an enumeration side by side among the fields."""
    return (width() - MARGINS) * (1.0 - LABELS) > len(texts) * (BOX + max(map(of_text, texts), default=0.0))
