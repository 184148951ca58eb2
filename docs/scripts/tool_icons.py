"""Draws the icons of the toolbar: python3 docs/scripts/tool_icons.py writes ICONS below addon/motus/.

Blender's icon geometry: the letters VCO and a zero byte, width and height, an unused offset of two bytes; then the
corners of all triangles (two bytes each, from the lower left), then their colours (RGBA, one byte each).
"""

import itertools
import math
import struct
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "addon" / "motus"
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
    for (x0, y0), (x1, y1) in itertools.pairwise(points):
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
    for (upper0, lower0), (upper1, lower1) in itertools.pairwise(edges):
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


def bone(head, tail):
    """A bone of an armature, as Blender draws it."""
    along = (tail[0] - head[0], tail[1] - head[1])
    length = math.hypot(*along)
    wide = (-along[1] / length * 26.0, along[0] / length * 26.0)
    neck = (head[0] + 0.22 * along[0], head[1] + 0.22 * along[1])
    corners = (head, (neck[0] - wide[0], neck[1] - wide[1]), tail, (neck[0] + wide[0], neck[1] + wide[1]))
    return quad(corners, (BODY,) * 4)


def disc(middle, radius, color):
    """A round joint."""
    rim = [
        (middle[0] + radius * math.cos(angle), middle[1] + radius * math.sin(angle))
        for angle in (2.0 * math.pi * step / STEPS for step in range(STEPS))
    ]
    return [(place, color) for first, second in zip(rim, rim[1:] + rim[:1]) for place in (middle, first, second)]


def drag_chain():
    """Content of the icon of Drag Chain: two bones, held at their end by an arrow's foot."""
    hip, knee, foot = (44.0, 40.0), (70.0, 156.0), (168.0, 160.0)
    found = bone(hip, knee) + bone(knee, foot)
    for joint in (hip, knee):
        found += disc(joint, 14.0, BODY)
    found += stroke([foot, (214.0, 200.0)]) + disc(foot, 17.0, WHITE)
    return geometry(found + [(place, WHITE) for place in ((240.0, 226.0), (188.0, 214.0), (226.0, 174.0))])


ICONS = {"pull/window/icons/pick_pull.dat": pick_pull, "ik/dragging/icons/drag_chain.dat": drag_chain}


def main(folder):
    """Writes the icons into `folder`."""
    for name, drawn in ICONS.items():
        path = Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(drawn())


if __name__ == "__main__":
    main(*(sys.argv[1:] or [FOLDER]))
