"""Five pictures of a window, cut out and numbered, three above two, the last one wide."""

import struct
import zlib

import bpy
import numpy as np

from window import window_support

from . import hand

WIDTH, HEIGHT, GAP = 420, 380, 10
WIDE = 2 * WIDTH + GAP
AROUND = 40  # pixels, from the mouse to the edges of its picture
COLUMNS, COUNT = 3, 5
PAPER = 255
INSET, RIM = (300, 220), 3
BADGE = 15  # pixels, radius
BADGE_COLOR = (255, 140, 25)
CURSOR = (
    "#",
    "##",
    "#.#",
    "#..#",
    "#...#",
    "#....#",
    "#.....#",
    "#......#",
    "#.......#",
    "#........#",
    "#.........#",
    "#......#####",
    "#...#..#",
    "#..##...#",
    "#.#  #..#",
    "##   #...#",
    "#     #..#",
    "       ##",
)
DIGITS = {
    1: ("..#..", ".##..", "..#..", "..#..", "..#..", "..#..", ".###."),
    2: (".###.", "#...#", "....#", "...#.", "..#..", ".#...", "#####"),
    3: (".###.", "#...#", "....#", "..##.", "....#", "#...#", ".###."),
    4: ("...#.", "..##.", ".#.#.", "#..#.", "#####", "...#.", "...#."),
    5: ("#####", "#....", "####.", "....#", "....#", "#...#", ".###."),
}


class Strip:
    """Collects the five pictures of a system."""

    def __init__(self):
        self._pictures = []
        self._panels = {}

    def shot(self, left, top, has_mouse=True, is_moved=False):
        """Generator: takes the next picture, whose upper left corner is so many pixels from the window's.

        has_mouse: the mouse is drawn. is_moved: a picture that would not show the mouse is moved until it does.
        """
        screen = yield from smooth_screen()
        number = len(self._pictures) + 1
        width = WIDE if number == COUNT else WIDTH
        x, y = hand.place[0], screen.shape[0] - hand.place[1]
        if has_mouse:
            paint_cursor(screen, x, y)
        if is_moved:
            left, top = min(max(left, x + AROUND - width), x - AROUND), min(max(top, y + AROUND - HEIGHT), y - AROUND)
        left, top = min(max(left, 0), screen.shape[1] - width), min(max(top, 0), screen.shape[0] - HEIGHT)
        picture = screen[top : top + HEIGHT, left : left + width].copy()
        paint_badge(picture, number)
        self._pictures.append(picture)

    def panel(self, name, left, top, right, bottom):
        """Generator: keeps a part of the window as a picture of its own."""
        screen = yield from smooth_screen()
        self._panels[name] = screen[top:bottom, left:right].copy()

    def inset(self, file, left, top):
        """Generator: lays the middle of the viewport into a corner of a picture, half as large."""
        screen = yield from smooth_screen()
        x, y = window_support.centre()
        y = screen.shape[0] - y
        found = screen[y - INSET[1] : y + INSET[1], x - INSET[0] : x + INSET[0]].astype(np.uint16)
        small = (found[::2, ::2] + found[1::2, ::2] + found[::2, 1::2] + found[1::2, 1::2]) // 4
        width, height, values = window_support.pixels(file)
        picture = np.round(np.array(values).reshape(height, width, 4)[::-1, :, :3] * 255.0).astype(np.uint8)
        picture[top - RIM : top + INSET[1] + RIM, left - RIM : left + INSET[0] + RIM] = PAPER
        picture[top : top + INSET[1], left : left + INSET[0]] = small
        file.write_bytes(png(picture))
        print(f"docs/pictures/{file.name}", flush=True)

    def save(self, file):
        """Write the five as one PNG, and beside it those that stand alone; gives the files."""
        if not self._pictures:
            return []
        sheet = np.full((2 * HEIGHT + GAP, COLUMNS * WIDTH + (COLUMNS - 1) * GAP, 3), PAPER, np.uint8)
        for index, picture in enumerate(self._pictures):
            row, column = divmod(index, COLUMNS)
            top, left = row * (HEIGHT + GAP), column * (WIDTH + GAP)
            sheet[top : top + HEIGHT, left : left + picture.shape[1]] = picture
        pictures = {file: sheet, **{file.with_name(f"{name}.png"): found for name, found in self._panels.items()}}
        for path, pixels in pictures.items():
            path.write_bytes(png(coarse(pixels)))
        return list(pictures)


def coarse(pixels):
    """64 shades of each colour, which are enough, and pack better."""
    return pixels & 0xFC | pixels >> 6


def smooth_screen():
    """Generator: the window with smooth edges, which take most of the time where they are drawn in software."""
    system = bpy.context.preferences.system
    system.viewport_aa = '8'
    yield 0.2
    yield
    screen = window_support.screen().copy()
    system.viewport_aa = 'OFF'
    return screen


def paint_cursor(screen, x, y):
    """Draw the mouse with its point at (x, y), from the upper left."""
    colors = {"#": 0, ".": 255}
    for row, line in enumerate(CURSOR):
        for column, pixel in enumerate(line):
            place = y + row, x + column
            if pixel in colors and place[0] < screen.shape[0] and place[1] < screen.shape[1]:
                screen[place] = colors[pixel]


def paint_badge(picture, number):
    """Draw the number of a picture into its upper left corner."""
    middle = BADGE + 5
    rows, columns = np.ogrid[: 2 * middle, : 2 * middle]
    distance = np.hypot(rows - middle, columns - middle)
    cover = np.clip(BADGE + 0.5 - distance, 0.0, 1.0)[..., None]
    corner = picture[: 2 * middle, : 2 * middle]
    corner[:] = corner * (1.0 - cover) + np.array(BADGE_COLOR) * cover
    for row, line in enumerate(DIGITS[number]):
        for column, pixel in enumerate(line):
            if pixel == "#":
                top, left = middle - 7 + 2 * row, middle - 5 + 2 * column
                corner[top : top + 2, left : left + 2] = 0


def png(pixels):
    """The content of a PNG file; each line has the filter that leaves least."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = pixels.shape
    padded = np.zeros((height + 1, width + 1, 3), np.int16)
    padded[1:, 1:] = pixels
    here, left, up = padded[1:, 1:], padded[1:, :-1], padded[:-1, 1:]
    filtered = [(here - other).astype(np.uint8) for other in (0, left, up)]
    costs = np.array([np.abs(one.astype(np.int8).astype(np.int16)).sum(axis=(1, 2)) for one in filtered])
    chosen = costs.argmin(axis=0)
    lines = b"".join(bytes([kind]) + filtered[kind][row].tobytes() for row, kind in enumerate(chosen))
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(lines, 9))
        + chunk(b"IEND", b"")
    )
