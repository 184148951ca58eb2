"""Small graphs for panels and dialogs, drawn into the pixels of an icon: Blender lets add-ons draw nothing else there."""

import bpy
import bpy.utils.previews

from ... import keeping
from ...lazy import numpy as np

WIDTH, HEIGHT = 256, 256  # icons are square
PAD = 8  # pixels above and below
LINE, AXIS, LEVEL = (0.95, 0.55, 0.20), (0.55, 0.55, 0.55), (0.40, 0.62, 0.90)

_graphs = []
"""List of the preview collection with all graphs; empty until the first graph is drawn."""
_shown = keeping.OfProcess("hashes of the values of the graphs that icons show", "name of the icon's place in the interface", most=256)


def icon(name, values, levels=(0.0,), marks=()):
    """Icon of a graph of values (n,) from left to right, for UILayout.template_icon.

    name: of the place in the interface that shows the graph; each place has one graph at a time. levels: heights of thin horizontal lines.
    marks: further arrays (n,) of values, drawn behind the first.
    """
    if not _graphs:
        _graphs.append(bpy.utils.previews.new())
    previews = _graphs[0]
    preview = previews.get(name) or previews.new(name)
    values = [np.nan_to_num(np.asarray(one, dtype=float)) for one in (values, *marks)]
    key = hash((tuple(levels), *(one.tobytes() for one in values)))
    if _shown.get(name) != key:
        preview.image_size = (WIDTH, HEIGHT)
        preview.image_pixels_float = pixels(values[0], levels, values[1:]).ravel().tolist()
        _shown.add(name, key)
    return preview.icon_id


def pixels(values, levels=(0.0,), marks=()):
    """Draw a graph as pixels: (HEIGHT, WIDTH, 4) floats in [0, 1], the bottom row first.

    values: (n,) from left to right. levels: heights of thin horizontal lines. marks: further arrays (n,), drawn behind the first.
    """
    every = np.concatenate([values, *marks, np.asarray(levels, dtype=float)])
    low, high = every.min(), every.max()
    scale = (HEIGHT - 2 * PAD - 1) / max(high - low, 1e-12)
    picture = np.zeros((HEIGHT, WIDTH, 4))
    for level in levels:
        _draw(picture, np.full(WIDTH, PAD + (level - low) * scale), AXIS, 0.5)
    for curve, colour, width in (*((mark, LEVEL, 1.0) for mark in marks), (values, LINE, 1.6)):
        at = np.linspace(0.0, len(curve) - 1.0, WIDTH)
        _draw(picture, PAD + (np.interp(at, np.arange(len(curve)), curve) - low) * scale, colour, width)
    return picture


def _draw(picture, heights, colour, width):
    """Draw a smooth line into a picture. heights: of the line in each column, (WIDTH,). width: half the line's width in pixels."""
    rise = np.abs(np.gradient(heights))
    rows = np.arange(HEIGHT)[:, None]
    # The distance from the line counts, not the height above it, with which a steep line would be thin.
    distance = np.abs(rows - heights) / np.sqrt(1.0 + rise * rise)
    # A steep line must have no gap between neighbouring columns.
    reach = np.maximum(width, 0.5 * rise / np.sqrt(1.0 + rise * rise))
    cover = np.clip(reach + 0.5 - distance, 0.0, 1.0)[..., None]
    picture[..., :3] += cover * (np.array(colour) - picture[..., :3])
    picture[..., 3:] = np.maximum(picture[..., 3:], cover)


def unregister():
    """Remove the preview collection with all graphs."""
    while _graphs:
        bpy.utils.previews.remove(_graphs.pop())
    _shown.clear()


def register():
    """Do nothing: the preview collection is created with the first graph."""
