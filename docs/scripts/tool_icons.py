"""Draws the icons of the toolbar: python3 docs/scripts/tool_icons.py writes addon/motus/pull/window/icons/pick_pull.dat.

Blender's icon geometry: the letters VCO and a zero byte, width and height, an unused offset of two bytes; then the
corners of all triangles (two bytes each, from the lower left), then their colours (RGBA, one byte each).
"""

import math
import struct
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "addon" / "motus" / "pull" / "window" / "icons"
SIZE = 255
WHITE = (255, 255, 255, 255)
# The colour in which Blender's own icons show what a tool changes.
BODY = (95, 166, 255, 200)
FADING = (95, 166, 255, 30)

FLOOR, TOP = 48.0, 176.0
LEFT, RIGHT = 16.0, 239.0
STEPS = 24
THICK = 15.0


def height(share):
    """The pulled surface over its width, a share from 0 to 1: a smooth falloff about the middle."""
    t = max(0.0, 1.0 - abs(share - 0.5) / 0.42)
    return FLOOR + (TOP - FLOOR) * t * t * (3.0 - 2.0 * t)


def surface():
    """Points of the surface, from left to right."""
    return [(LEFT + (RIGHT - LEFT) * step / STEPS, height(step / STEPS)) for step in range(STEPS + 1)]


def quad(corners, colors):
    """Two triangles of four corners in order round the quad."""
    return [(corners[i], colors[i]) for i in (0, 1, 2, 0, 2, 3)]


def below(points):
    """The body under the surface, fading downwards."""
    found = []
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        corners = ((x0, 16.0), (x1, 16.0), (x1, y1), (x0, y0))
        found += quad(corners, (FADING, FADING, BODY, BODY))
    return found


def stroke(points):
    """A white line of even thickness along the surface."""
    edges = []
    for index, (x, y) in enumerate(points):
        before, after = points[max(index - 1, 0)], points[min(index + 1, len(points) - 1)]
        along = (after[0] - before[0], after[1] - before[1])
        length = math.hypot(*along)
        across = (-along[1] / length * THICK / 2.0, along[0] / length * THICK / 2.0)
        edges.append(((x + across[0], y + across[1]), (x - across[0], y - across[1])))
    found = []
    for (upper0, lower0), (upper1, lower1) in zip(edges, edges[1:]):
        found += quad((lower0, lower1, upper1, upper0), (WHITE,) * 4)
    return found


def arrow():
    """An arrow above the bump, pointing up."""
    middle = (LEFT + RIGHT) / 2.0
    tip, neck, foot = 250.0, 214.0, 192.0
    head = [((middle - 30.0, neck), WHITE), ((middle + 30.0, neck), WHITE), ((middle, tip), WHITE)]
    half = THICK / 2.0
    shaft = ((middle - half, foot), (middle + half, foot), (middle + half, neck), (middle - half, neck))
    return head + quad(shaft, (WHITE,) * 4)


def geometry(corners):
    """The file's content for a list of (point, colour), three a triangle."""
    places = b"".join(bytes(min(max(round(value), 0), SIZE) for value in point) for point, _ in corners)
    return struct.pack("<4s4B", b"VCO\0", SIZE, SIZE, 0, 0) + places + b"".join(bytes(color) for _, color in corners)


def pick_pull():
    """Content of the icon of Pick & Pull."""
    points = surface()
    return geometry(below(points) + stroke(points) + arrow())


def main(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "pick_pull.dat").write_bytes(pick_pull())


if __name__ == "__main__":
    main(*(sys.argv[1:] or [FOLDER]))
