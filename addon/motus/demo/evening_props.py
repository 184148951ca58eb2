"""What stands in the evening scene: a cabin with lit windows, a lantern by the path, and a fence."""

import math

import bpy
import numpy as np

from . import evening_land, materials, shapes

WARM = (1.0, 0.52, 0.17)
SIZE = np.array((4.6, 3.6, 2.3))  # of the cabin's walls, m
ROOF_RISE, ROOF_OVERHANG, ROOF_THICK, SNOW_THICK = 1.9, 0.5, 0.12, 0.20
TURN = 0.32  # of the cabin about Z, rad
LANTERN = (-1.35, 3.2)
FENCE = ((-2.6, 1.4), (-4.4, 2.3), (-6.2, 2.9), (-8.1, 3.1), (-10.0, 2.9))
WINDOWS = ((-1.15, -0.5), (1.15, -0.5))  # (x, side of the wall)


def build(collection, snow):
    """All of it. snow: the material of what lies on it."""
    _add_cabin(collection, snow)
    _add_lantern(collection, snow)
    _add_fence(collection, snow)


def _glow(name, strength):
    material, shader, output = materials.new_material(name)
    light = shader.add("ShaderNodeEmission", {"Color": (*WARM, 1.0), "Strength": strength})
    materials.finish(material, shader, output, light.outputs[0])
    material.diffuse_color = (*WARM, 1.0)
    return material


# --- the cabin -------------------------------------------------------------------------------------------------------


def _add_cabin(collection, snow):
    wood = evening_land.covered("Cabin Wood", (0.085, 0.045, 0.026), least=0.7)
    trim = evening_land.covered("Cabin Trim", (0.30, 0.20, 0.13), least=0.7)
    stone = evening_land.covered("Chimney Stone", (0.12, 0.11, 0.11), least=0.8)
    parts = [wood, trim, snow, _glow("Window Light", 2.6), stone]
    builder = shapes.MeshBuilder()
    _add_walls(builder)
    _add_roof(builder)
    _add_windows(builder)
    builder.add(shapes.box((0.55, 0.55, 1.7), (1.25, 0.55, SIZE[2] + 1.35)), 4, smooth=False)
    builder.add(shapes.box((0.66, 0.66, 0.16), (1.25, 0.55, SIZE[2] + 2.27)), 2, smooth=False)
    cabin = shapes.link_object(collection, "Cabin", builder.build("Cabin", parts))
    x, y = evening_land.CABIN
    cabin.location = x, y, evening_land.ground_at(x, y) - 0.05
    cabin.rotation_euler.z = TURN
    for x, side in WINDOWS:
        _add_window_light(collection, cabin, x, side)


def _add_walls(builder):
    """Beams that lie upon each other, and gables."""
    count = 9
    for row in range(count):
        z = (row + 0.5) * SIZE[2] / count
        for side in (-0.5, 0.5):
            builder.add(shapes.beam((SIZE[0] + 0.3, 0.22, SIZE[2] / count), (0.0, side * SIZE[1], z), 0.05), smooth=False)
            builder.add(shapes.beam((0.22, SIZE[1] + 0.3, SIZE[2] / count), (side * SIZE[0], 0.0, z), 0.05), smooth=False)
    for side in (-0.5, 0.5):
        x, y, z = side * SIZE[0], 0.5 * SIZE[1], SIZE[2]
        vertices = np.array(((x, -y, z), (x, y, z), (x, 0.0, z + ROOF_RISE)))
        builder.add((vertices, [(0, 1, 2) if side > 0 else (0, 2, 1)]), smooth=False)


def _add_roof(builder):
    """Two slopes, and the snow on them."""
    for slot, lift, thick, out in ((1, 0.0, ROOF_THICK, ROOF_OVERHANG), (2, ROOF_THICK, SNOW_THICK, ROOF_OVERHANG + 0.05)):
        for side in (-1.0, 1.0):
            builder.add(_slope(side, lift, thick, out), slot, smooth=False)


def _slope(side, lift, thick, out):
    x = 0.5 * SIZE[0] + out
    drop = ROOF_RISE / (0.5 * SIZE[1])
    eave, ridge = 0.5 * SIZE[1] + out, SIZE[2] + ROOF_RISE + lift
    low = ridge - drop * eave
    vertices = np.array([(end * x, side * across, level + up) for end in (-1.0, 1.0)
                         for across, level in ((0.0, ridge), (eave, low)) for up in (0.0, thick)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, faces if side > 0 else [face[::-1] for face in faces]


def _add_windows(builder):
    """Lit panes between frames, and a door, in the front."""
    front = -0.5 * SIZE[1] - 0.12
    for x, _ in WINDOWS:
        builder.add(shapes.box((0.78, 0.02, 0.78), (x, front, 1.35)), 3, smooth=False)
        for across, up, size in ((0.0, 0.43, (0.98, 0.08, 0.09)), (0.0, -0.43, (1.02, 0.16, 0.09)), (0.43, 0.0, (0.09, 0.08, 0.8)),
                                 (-0.43, 0.0, (0.09, 0.08, 0.8)), (0.0, 0.0, (0.04, 0.06, 0.8)), (0.0, 0.0, (0.8, 0.06, 0.04))):
            builder.add(shapes.box(size, (x + across, front - 0.02, 1.35 + up)), 1, smooth=False)
        builder.add(shapes.box((1.0, 0.16, 0.07), (x, front - 0.05, 1.0)), 2, smooth=False)
    builder.add(shapes.box((0.85, 0.06, 1.75), (0.0, front, 0.9)), 1, smooth=False)
    builder.add(shapes.box((0.30, 0.07, 0.30), (0.0, front - 0.01, 1.4)), 3, smooth=False)


def _add_window_light(collection, cabin, x, side):
    """The light that falls out of a window onto the snow."""
    data = bpy.data.lights.new("Window Light", "AREA")
    data.energy, data.color, data.size = 90.0, WARM, 0.8
    lamp = shapes.link_object(collection, "Window Light", data, parent=cabin)
    lamp.location = x, side * SIZE[1] - 0.35, 1.35
    lamp.rotation_euler.x = math.radians(-75.0) + math.pi


# --- by the path -----------------------------------------------------------------------------------------------------


def _add_lantern(collection, snow):
    iron = evening_land.covered("Iron", (0.012, 0.012, 0.014), least=0.8, roughness=0.4)
    builder = shapes.MeshBuilder()
    builder.add(shapes.upright(shapes.lathe(((0.035, 2.3), (0.045, 0.35), (0.10, 0.25), (0.12, -0.3)), segments=16)))
    builder.add(shapes.upright(shapes.lathe(((0.001, 2.92), (0.05, 2.84), (0.24, 2.68), (0.20, 2.66)), segments=6)), 0, smooth=False)
    builder.add(shapes.upright(shapes.lathe(((0.001, 2.98), (0.10, 2.92), (0.23, 2.73), (0.24, 2.69)), segments=18)), 2)
    builder.add(shapes.upright(shapes.lathe(((0.13, 2.64), (0.10, 2.34)), segments=6)), 1, smooth=False)
    builder.add(shapes.upright(shapes.lathe(((0.12, 2.34), (0.05, 2.26)), segments=6)), 0, smooth=False)
    mesh = builder.build("Lantern", [iron, _glow("Lantern Light", 9.0), snow])
    lantern = shapes.link_object(collection, "Lantern", mesh)
    lantern.location = (*LANTERN, evening_land.ground_at(*LANTERN))
    data = bpy.data.lights.new("Lantern Light", "POINT")
    data.energy, data.color, data.shadow_soft_size = 210.0, WARM, 0.16
    shapes.link_object(collection, "Lantern Light", data, parent=lantern).location.z = 2.5


def _add_fence(collection, snow):
    """Posts with caps of snow, and rails between them."""
    builder = shapes.MeshBuilder()
    places = np.array([(x, y, evening_land.ground_at(x, y)) for x, y in FENCE])
    for place in places:
        builder.add(shapes.box((0.13, 0.13, 1.15), place + (0.0, 0.0, 0.45)), smooth=False)
        builder.add(shapes.sphere(0.12, place + (0.0, 0.0, 1.03), (1.0, 1.0, 0.7), segments=12, rings=8), 1)
    for start, end in zip(places, places[1:]):
        for z in (0.42, 0.80):
            builder.add(_rail(start, end, z, 0.05, 0.09))
            builder.add(_rail(start, end, z + 0.09, 0.065, 0.05), 1)
    wood = evening_land.covered("Fence Wood", (0.07, 0.05, 0.04), least=0.8)
    shapes.link_object(collection, "Fence", builder.build("Fence", [wood, snow]))


def _rail(start, end, z, width, high):
    """A bar from one post to the next."""
    along = end - start
    vertices, faces = shapes.box((float(np.hypot(along[0], along[1])), width, high))
    vertices = evening_land.turned(vertices, math.atan2(along[1], along[0]))
    share = (vertices - vertices.mean(axis=0)) @ along / (along @ along)
    vertices[:, 2] += share * along[2]
    return vertices + 0.5 * (start + end) + (0.0, 0.0, z), faces
