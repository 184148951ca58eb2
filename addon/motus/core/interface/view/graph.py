"""Small graphs for panels and dialogs, drawn into the pixels of an icon: Blender lets add-ons draw nothing else there."""

import math

import bpy
import bpy.utils.previews

from ... import keeping
from ...lazy import numpy as np
from . import widths

WIDTH, HEIGHT = 256, 256  # icons are square
PAD = 8  # pixels above and below
TICKS = 5  # numbers beside a graph that has numbers
ROWS = 2 * TICKS - 1
"""Height of a graph with numbers, in lines of text: a number, and an empty line between two."""
BESIDE = 4.0
"""Width of the numbers beside a graph, in heights of a line."""
LINE_HEIGHT = 20.0
"""Height of a line of text, in pixels at an interface scale of 1."""
MARGIN = 2.5
"""Width that panels and boxes take beside a graph, in heights of a line."""
_ROUND = 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0
LINE, AXIS, LEVEL, DOT, FLAG = (0.95, 0.55, 0.20), (0.55, 0.55, 0.55), (0.40, 0.62, 0.90), (1.0, 1.0, 1.0), (0.85, 0.20, 0.20, 0.35)
MOST_STAMPS = 20_000
"""Largest number of places at which a line through points is drawn."""

_graphs = []
"""List of the preview collection with all graphs; empty until the first graph is drawn."""
_shown = keeping.OfProcess("hashes of the values of the graphs that icons show", "name of the icon's place in the interface", most=256)


def draw(layout, name, values, heights, columns, marks=(), flags=(), across=(), dot=None):
    """Draw a graph of values (n,) with numbers on its axes.

    name: as of icon(). heights: {height: text} of TICKS evenly spaced heights, rising, between which all values lie. columns: three texts,
    for the left end, the middle and the right end. marks, flags, across, dot: as of icon().
    """
    whole = layout.column(align=True)
    room = widths.width() / LINE_HEIGHT - MARGIN
    if room < ROWS + BESIDE:
        _draw_narrow(whole, icon(name, values, tuple(heights), marks, PAD, flags, across, dot), room, list(heights.values()), columns)
        return
    row = _centred(whole)
    numbers = row.column(align=True)
    numbers.ui_units_x = BESIDE
    for number, text in enumerate(reversed(heights.values())):
        if number:
            numbers.label()
        line = numbers.row()
        line.alignment = 'RIGHT'
        line.label(text=text, translate=False)
    row.template_icon(icon(name, values, tuple(heights), marks, HEIGHT / ROWS / 2.0, flags, across, dot), scale=ROWS)
    row = _centred(whole)
    corner = row.column()
    corner.ui_units_x = BESIDE
    corner.label()
    _draw_columns(row, columns, ROWS)


def _draw_narrow(layout, icon_id, room, numbers, columns):
    """Draw a graph where there is no room for numbers beside it: with the last of them above it and the first below. room: in lines."""
    layout.label(text=numbers[-1], translate=False)
    layout.template_icon(icon_id, scale=min(max(room, 1.0), ROWS))
    layout.label(text=numbers[0], translate=False)
    _draw_columns(layout.row(align=True), columns, room)


def _draw_columns(row, columns, room):
    """Draw the texts below a graph, for its left end, middle and right end. room: width of the graph, in lines."""
    for text, alignment in zip(columns, ('LEFT', 'CENTER', 'RIGHT')):
        column = row.column()
        column.ui_units_x = room / len(columns)
        line = column.row()
        line.alignment = alignment
        line.label(text=text, translate=False)


def _centred(layout):
    row = layout.row(align=True)
    row.alignment = 'CENTER'
    return row


def ticks(low, high):
    """TICKS evenly spaced round numbers around the range from low to high, rising."""
    least = max((high - low) / (TICKS - 1), 1e-6 * max(abs(low), abs(high), 1e-3))
    power = 10.0 ** math.floor(math.log10(least))
    for factor in (*_ROUND, *(10.0 * one for one in _ROUND[1:])):
        step = factor * power
        first = math.floor(low / step + 1e-9)
        if (first + TICKS - 1) * step >= high - 1e-9 * step:
            break
    return [(first + number) * step for number in range(TICKS)]


def icon(name, values, levels=(0.0,), marks=(), pad=PAD, flags=(), across=(), dot=None):
    """Icon of a graph of values (n,) from left to right, for UILayout.template_icon.

    name: of the place in the interface that shows the graph; each place has one graph at a time. levels: heights of thin horizontal lines.
    marks: further arrays (n,) of values, drawn behind the first. pad: pixels above and below. flags: empty, or (n,) of truth values, red
    where true. across: arrays (n,), for the values and for each of the marks, of places from 0 at the left end to 1 at the right one,
    through which a line may come several times; empty if all are evenly spaced. dot: index of a value that is marked, or None.
    """
    if not _graphs:
        _graphs.append(bpy.utils.previews.new())
    previews = _graphs[0]
    preview = previews.get(name) or previews.new(name)
    values, across = ([np.nan_to_num(np.asarray(one, dtype=float)) for one in several] for several in ((values, *marks), across))
    flags = np.asarray(flags, dtype=bool)
    key = hash((tuple(levels), pad, flags.tobytes(), dot, *(one.tobytes() for one in (*values, *across))))
    if _shown.get(name) != key:
        preview.image_size = (WIDTH, HEIGHT)
        preview.image_pixels_float.foreach_set(pixels(values[0], levels, values[1:], pad, flags, across, dot).ravel().astype(np.float32))
        _shown.add(name, key)
    return preview.icon_id


def pixels(values, levels=(0.0,), marks=(), pad=PAD, flags=(), across=(), dot=None):
    """Draw a graph as pixels: (HEIGHT, WIDTH, 4) floats in [0, 1], the bottom row first.

    values: (n,) from left to right. levels: heights of thin horizontal lines. marks: further arrays (n,), drawn behind the first.
    pad: pixels above and below. flags, across, dot: as of icon().
    """
    every = np.concatenate([values, *marks, np.asarray(levels, dtype=float)])
    low, high = every.min(), every.max()
    scale = (HEIGHT - 2 * pad - 1) / max(high - low, 1e-12)
    picture = np.zeros((HEIGHT, WIDTH, 4))
    if len(flags):
        picture[:, np.asarray(flags)[np.arange(WIDTH) * len(flags) // WIDTH]] = FLAG
    for level in levels:
        _draw(picture, np.full(WIDTH, pad + (level - low) * scale), AXIS, 0.5)
    curves = (values, *marks)
    for number in reversed(range(len(curves))):
        curve, colour, width = curves[number], LEVEL if number else LINE, 1.0 if number else 1.6
        rows = pad + (curve - low) * scale
        columns = (np.asarray(across[number]) if across else np.linspace(0.0, 1.0, len(curve))) * (WIDTH - 1.0)
        if across:
            _draw_path(picture, columns, rows, colour, width)
        else:
            _draw(picture, np.interp(np.arange(WIDTH), columns, rows), colour, width)
    if dot is not None:
        _draw_path(picture, columns[[dot]], rows[[dot]], DOT, 4.0)  # the values are drawn last
    return picture


def _draw(picture, heights, colour, width):
    """Draw a smooth line into a picture. heights: of the line in each column, (WIDTH,). width: half the line's width in pixels."""
    rise = np.abs(np.gradient(heights))
    slant = np.sqrt(1.0 + rise * rise)
    # A steep line must have no gap between neighbouring columns.
    reach = np.maximum(width, 0.5 * rise / slant)
    # Rows that the line does not reach stay as they are; a level reaches two or three.
    room = (reach + 0.5) * slant
    first, end = (int(min(max(0.0, row), HEIGHT)) for row in (np.floor((heights - room).min()), np.ceil((heights + room).max()) + 1.0))
    rows, part = np.arange(first, end)[:, None], picture[first:end]
    # The distance from the line counts, not the height above it, with which a steep line would be thin.
    distance = np.abs(rows - heights) / slant
    cover = np.clip(reach + 0.5 - distance, 0.0, 1.0)[..., None]
    part[..., :3] += cover * (np.array(colour) - part[..., :3])
    part[..., 3:] = np.maximum(part[..., 3:], cover)


def _draw_path(picture, columns, rows, colour, width):
    """Draw a line through points, in any order, into a picture. columns, rows: of the points, (n,). width: half the line's width in pixels."""
    steps = np.concatenate(([0.0], np.cumsum(np.maximum(np.hypot(np.diff(columns), np.diff(rows)), 1e-9))))
    at = np.linspace(0.0, steps[-1], int(min(2.0 * steps[-1], MOST_STAMPS)) + 1)  # two stamps a pixel
    columns, rows = np.interp(at, steps, columns), np.interp(at, steps, rows)
    cover = np.zeros(picture.shape[:2])
    reach = math.ceil(width + 1.0)
    up, right = np.mgrid[-reach : reach + 1, -reach : reach + 1].reshape(2, -1, 1)
    row, column = np.floor(rows).astype(int) + up, np.floor(columns).astype(int) + right
    covered = np.clip(width + 0.5 - np.hypot(row - rows, column - columns), 0.0, 1.0)
    is_in = (covered > 0.0) & (row >= 0) & (row < HEIGHT) & (column >= 0) & (column < WIDTH)
    np.maximum.at(cover, (row[is_in], column[is_in]), covered[is_in])
    picture[..., :3] += cover[..., None] * (np.array(colour) - picture[..., :3])
    picture[..., 3] = np.maximum(picture[..., 3], cover)


def unregister():
    """Remove the preview collection with all graphs."""
    while _graphs:
        bpy.utils.previews.remove(_graphs.pop())
    _shown.clear()


def register():
    """Do nothing: the preview collection is created with the first graph."""
