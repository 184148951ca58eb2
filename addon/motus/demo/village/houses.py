"""The houses of the village: log cabins with lit windows and chimneys, and a chapel with a steeple."""

import math
from typing import NamedTuple

import bpy
import numpy as np

from ..stage import materials, shapes
from . import props, terrain

OVERHANG, THICK = 0.5, 0.12  # overhang and thickness of roofs, m
WINDOW_HEIGHT, FRONT = 1.35, 0.12


class House(NamedTuple):
    """One house of the village; lengths in metres.

    place: x and y on the ground. turn: radians about Z. size: width, depth and height of the walls. rise: height of the roof
    above the walls. windows, door: their places along the front, from its middle.
    """

    place: tuple
    turn: float
    size: tuple
    rise: float
    windows: tuple
    door: float
    chimney: tuple = ()  # x, y from the middle
    is_chapel: bool = False


HOUSES = (
    House((4.6, 12.2), 0.34, (4.6, 3.6, 2.3), 1.9, (-1.15, 1.15), 0.0, (1.25, 0.55)),
    House((-6.4, 13.6), -0.38, (5.4, 4.0, 2.5), 2.2, (-1.7, 0.1), 1.6, (-1.5, 0.6)),
    House((-0.9, 24.5), 0.06, (4.2, 6.0, 3.2), 2.9, (-1.25, 1.25), 0.0, is_chapel=True),
    House((10.6, 21.0), 0.5, (5.0, 3.8, 2.2), 1.8, (-1.3, 0.4), 1.6, (1.4, -0.4)),
    House((-11.8, 22.5), -0.6, (4.4, 3.6, 2.2), 1.9, (-0.9, 1.0), 0.05, (-1.0, 0.5)),
)


def build(collection, covered):
    """Add all houses: roofs and sills, on which snow lies, to the collection `covered`, and the walls to `collection`."""
    wood = materials.principled("Log Wood", color=(0.085, 0.045, 0.026), roughness=0.8, specular=0.2)
    trim = materials.principled("Trim Wood", color=(0.26, 0.17, 0.11), roughness=0.75, specular=0.2)
    shingle = terrain.mottled("Shingles", (0.055, 0.042, 0.038), (0.11, 0.085, 0.07), 5.0)
    stone = terrain.mottled("Chimney Stone", (0.07, 0.065, 0.065), (0.17, 0.16, 0.155), 6.0)
    glow = props.glow("Window Light", 2.6)
    for number, house in enumerate(HOUSES):
        walls, roof = shapes.MeshBuilder(), shapes.MeshBuilder()
        _add_walls(walls, house)
        _add_front(walls, roof, house)
        _add_roof(roof, house)
        if house.chimney:
            _add_chimney(roof, house)
        if house.is_chapel:
            _add_steeple(walls, roof, house)
        body = shapes.link_object(collection, f"House {number + 1}", walls.build("House", [wood, trim, glow]))
        top = shapes.link_object(covered, f"Roof {number + 1}", roof.build("Roof", [shingle, trim, stone]))
        for part in (body, top):
            part.location = (*house.place, terrain.ground_at(*house.place) - 0.05)
            part.rotation_euler.z = house.turn
        _add_light(collection, body, house)


def _add_walls(builder, house):
    """Add walls of beams that lie on each other, and gables."""
    width, depth, high = house.size
    count = round(high / 0.26)
    for row in range(count):
        z = (row + 0.5) * high / count
        for side in (-0.5, 0.5):
            builder.add(shapes.beam((width + 0.3, 0.22, high / count), (0.0, side * depth, z), 0.05), smooth=False)
            builder.add(shapes.beam((0.22, depth + 0.3, high / count), (side * width, 0.0, z), 0.05), smooth=False)
    for side in (-0.5, 0.5):
        along, across = (depth, width) if house.is_chapel else (width, depth)
        corners = np.array(
            ((side * along, -0.5 * across, high), (side * along, 0.5 * across, high), (side * along, 0.0, high + house.rise))
        )
        if house.is_chapel:
            corners = terrain.turned(corners, 0.5 * math.pi)
        builder.add((corners, [(0, 1, 2) if side > 0 else (0, 2, 1)]), smooth=False)


def _add_roof(builder, house):
    """Add the two slopes of a roof. Those of the chapel face its sides, those of the houses face front and back."""
    width, depth, high = house.size
    along, across = (depth, width) if house.is_chapel else (width, depth)
    for side in (-1.0, 1.0):
        vertices, faces = _slope(side, along, across, high, house.rise)
        builder.add((terrain.turned(vertices, 0.5 * math.pi) if house.is_chapel else vertices, faces), smooth=False)


def _slope(side, along, across, high, rise):
    x = 0.5 * along + OVERHANG
    drop = rise / (0.5 * across)
    eave, ridge = 0.5 * across + OVERHANG, high + rise
    low = ridge - drop * eave
    vertices = np.array(
        [(end * x, side * far, level + up) for end in (-1.0, 1.0) for far, level in ((0.0, ridge), (eave, low)) for up in (0.0, THICK)]
    )
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, faces if side < 0 else [face[::-1] for face in faces]


def _add_front(walls, ledges, house):
    """Add lit panes between frames and a door to `walls`, and sills, on which snow lies, to `ledges`."""
    front = -0.5 * house.size[1] - FRONT
    for x in house.windows:
        walls.add(shapes.box((0.78, 0.02, 0.78), (x, front, WINDOW_HEIGHT)), 2, smooth=False)
        for across, up, size in (
            (0.0, 0.43, (0.98, 0.08, 0.09)),
            (0.0, -0.43, (1.02, 0.16, 0.09)),
            (0.43, 0.0, (0.09, 0.08, 0.8)),
            (-0.43, 0.0, (0.09, 0.08, 0.8)),
            (0.0, 0.0, (0.04, 0.06, 0.8)),
            (0.0, 0.0, (0.8, 0.06, 0.04)),
        ):
            walls.add(shapes.box(size, (x + across, front - 0.02, WINDOW_HEIGHT + up)), 1, smooth=False)
        ledges.add(shapes.box((1.06, 0.24, 0.05), (x, front - 0.08, WINDOW_HEIGHT - 0.49)), 1, smooth=False)
    walls.add(shapes.box((0.85, 0.06, 1.75), (house.door, front, 0.9)), 1, smooth=False)
    walls.add(shapes.box((0.30, 0.07, 0.30), (house.door, front - 0.01, 1.4)), 2, smooth=False)
    ledges.add(shapes.box((1.2, 0.7, 0.16), (house.door, front - 0.35, 0.1)), 2, smooth=False)


def _add_chimney(builder, house):
    x, y = house.chimney
    top = house.size[2] + house.rise + 0.55
    builder.add(shapes.box((0.55, 0.55, 2.2), (x, y, top - 1.1)), 2, smooth=False)
    builder.add(shapes.box((0.72, 0.72, 0.14), (x, y, top + 0.07)), 2, smooth=False)


def _add_steeple(walls, roof, house):
    """Add a tower in front of the house, with lit windows and a pointed roof."""
    front, wide, high = -0.5 * house.size[1] - 0.6, 1.9, house.size[2] + 3.4
    walls.add(shapes.box((wide, wide, high), (0.0, front, 0.5 * high)), smooth=False)
    for z in (1.5, high - 1.1):
        walls.add(shapes.box((0.55, 0.04, 1.0), (0.0, front - 0.5 * wide - 0.01, z)), 2, smooth=False)
        walls.add(shapes.box((0.05, 0.06, 1.0), (0.0, front - 0.5 * wide - 0.02, z)), 1, smooth=False)
    half = 0.5 * wide + 0.3
    corners = [(x * half, front + y * half, high + lift) for lift in (-0.1, 0.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    # The roof is of triangles, which the builder cannot add in one part with quads.
    squares = [(3, 2, 1, 0), *((i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i) for i in range(4))]
    faces = [face for a, b, c, d in squares for face in ((a, b, c), (a, c, d))] + [(4 + i, 4 + (i + 1) % 4, 8) for i in range(4)]
    roof.add((np.array([*corners, (0.0, front, high + 2.9)]), faces), smooth=False)
    walls.add(shapes.sphere(0.12, (0.0, front, high + 3.0), segments=12, rings=8), 1)


def _add_light(collection, body, house):
    """Add the light that falls from the windows onto the snow."""
    data = bpy.data.lights.new("Window Light", "AREA")
    data.energy, data.color = 260.0, props.WARM
    data.shape, data.size, data.size_y = "RECTANGLE", 2.6, 0.8
    lamp = shapes.link_object(collection, "Window Light", data, parent=body)
    lamp.location = sum(house.windows) / len(house.windows), -0.5 * house.size[1] - 0.4, WINDOW_HEIGHT
    lamp.rotation_euler.x = math.radians(-75.0) + math.pi
