"""What fits into a region: labels beside fields, or within them where there is too little room."""

import math

import bpy

CHARACTER_WIDTH = 6.5
"""Pixels of a character on the average, in the interface's font at a scale of 1."""
NARROW = 210.0
"""Pixels at a scale of 1: a region that is no wider has no room for labels beside fields."""
MARGINS, LABELS = 46.0, 0.4
"""Pixels at a scale of 1 beside labels and fields, and the share of the rest that labels have."""
PADDING = 8.0
"""Pixels at a scale of 1 that Blender leaves around the text of a label."""
BOX = 22.0
"""Pixels at a scale of 1 of a checkbox, which stands among the fields with its label, or of the margins of an item in a row."""


def width():
    """Pixels at a scale of 1 of the region that is drawn; infinite for dialogs and redo panels, which are as wide as they need."""
    region = bpy.context.region
    if region is None or region.type in {'HUD', 'TEMPORARY'}:
        return math.inf
    return region.width / bpy.context.preferences.system.ui_scale


def of_text(text):
    """Pixels at a scale of 1."""
    return CHARACTER_WIDTH * len(text)


def label_fits(text):
    """Whether a label has room beside its field."""
    return width() > max(NARROW, MARGINS + (of_text(text) + PADDING) / LABELS)


def switch_fits(text):
    """Whether the label of a checkbox has room among the fields."""
    return (width() - MARGINS) * (1.0 - LABELS) > BOX + of_text(text)


def items_fit(texts):
    """Whether items have room side by side among the fields."""
    return (width() - MARGINS) * (1.0 - LABELS) > len(texts) * (BOX + max(map(of_text, texts), default=0.0))
