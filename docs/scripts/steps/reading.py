"""Finds words on the screen, so that a script can click on what a user reads."""

import functools

import blf
import bpy
import gpu
import numpy as np
from mathutils import Matrix

LEAST_ALIKE = 0.95
"""Correlation of a label with the screen, where 1 is the same picture."""
MARGIN = 6
"""Pixels to the left and the right without another letter: "Play" is not found in "Playing"."""


def find(screen, words, within=None):
    """(x, y) of the middle of the words, from the lower left; None if they are not on the screen. The topmost ones count.

    screen: (height, width, 3) bytes from the top. within: (left, bottom, right, top), in pixels.
    """
    height, width, _ = screen.shape
    left, bottom, right, top = within or (0, 0, width, height)
    gray = screen[height - top : height - bottom, left:right].mean(axis=2)
    pattern = _drawn(words)
    if gray.shape[0] < pattern.shape[0] or gray.shape[1] < pattern.shape[1]:
        return None
    # Dark words on a bright button count as well.
    alike = np.abs(_correlation(gray, pattern))
    lines = np.flatnonzero(alike.max(axis=1) >= LEAST_ALIKE)
    if not lines.size:
        return None
    line = alike[lines[0] : lines[0] + pattern.shape[0]]
    row, column = np.unravel_index(np.argmax(line), line.shape)
    row += lines[0]
    return left + int(column) + pattern.shape[1] // 2, top - int(row) - pattern.shape[0] // 2


@functools.cache
def _drawn(words):
    """The words as the interface's font draws them: (height, width) brightness from the top."""
    preferences = bpy.context.preferences
    size = preferences.ui_styles[0].widget.points * preferences.system.ui_scale
    if bpy.app.version >= (4, 0, 0):
        blf.size(0, size)
    else:
        blf.size(0, size, 72)
    blf.color(0, 1.0, 1.0, 1.0, 1.0)
    width, height = (int(side) + 8 for side in blf.dimensions(0, words))
    height += 8
    canvas = gpu.types.GPUOffScreen(width, height)
    with canvas.bind():
        frame = gpu.state.active_framebuffer_get()
        frame.clear(color=(0.0, 0.0, 0.0, 1.0))
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            gpu.matrix.load_matrix(Matrix.Identity(4))
            gpu.matrix.load_projection_matrix(
                Matrix(((2.0 / width, 0.0, 0.0, -1.0), (0.0, 2.0 / height, 0.0, -1.0), (0.0, 0.0, -1.0, 0.0), (0.0, 0.0, 0.0, 1.0)))
            )
            blf.position(0, 4.0, 8.0, 0.0)
            blf.draw(0, words)
        pixels = np.array(frame.read_color(0, 0, width, height, 3, 0, 'UBYTE').to_list(), np.float64)
    canvas.free()
    pixels = pixels.reshape(height, width, 3).mean(axis=2)[::-1]
    rows, columns = (np.flatnonzero(pixels.max(axis=axis) > 32.0) for axis in (1, 0))
    return np.pad(pixels[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1], ((0, 0), (MARGIN, MARGIN)))


def _correlation(picture, pattern):
    """Pearson's correlation of the pattern with the picture at every place where it fits."""
    count = pattern.size
    pattern = pattern - pattern.mean()
    shape = [one + other - 1 for one, other in zip(picture.shape, pattern.shape)]
    product = np.fft.irfft2(np.fft.rfft2(picture, shape) * np.fft.rfft2(pattern[::-1, ::-1], shape), shape)
    rows, columns = pattern.shape
    product = product[rows - 1 : picture.shape[0], columns - 1 : picture.shape[1]]
    mean, squares = (_window_sums(values, rows, columns) / count for values in (picture, picture**2))
    spread = np.sqrt(np.maximum(squares - mean**2, 1.0) * count * (pattern**2).sum())
    return product / spread


def _window_sums(values, rows, columns):
    """The sum of each window of so many rows and columns."""
    sums = np.zeros((values.shape[0] + 1, values.shape[1] + 1))
    sums[1:, 1:] = values.cumsum(axis=0).cumsum(axis=1)
    return sums[rows:, columns:] - sums[:-rows, columns:] - sums[rows:, :-columns] + sums[:-rows, :-columns]
