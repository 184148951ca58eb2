"""A studio for clay: a wooden table in front of a plaster wall, lamps, and tools on the table."""

import math

import bpy
import numpy as np
from mathutils import Vector

from ..stage import lighting, materials, shapes
from . import landscape

PLANK, GAP, THICKNESS, LENGTH = 0.62, 0.012, 0.14, 26.0  # of the table's planks, m
TABLE_DEPTH = (-6.6, 4.4)
WALL_Y, WALL_BEND = 7.0, 3.0
AIM = Vector((0.2, 0.3, 0.9))  # point at which the lamps are aimed
# Light from below, from the side and from above: (half of the sine of the elevation plus 0.5, linear rgb).
WORLD_STOPS = ((0.30, (0.10, 0.075, 0.06)), (0.52, (0.30, 0.36, 0.40)), (1.0, (0.62, 0.66, 0.70)))


def build_world():
    """Make the world: dim light from all directions."""
    return lighting.build_gradient_world(
        "Motus Studio", WORLD_STOPS, 0.55, lambda shader, height: shader.math("MULTIPLY", shader.math("ADD", height, 1.0), 0.5)
    )


def build(collection):
    """Add table, wall, lamps and tools. Returns the balls of clay, the larger one first."""
    build_room(collection)
    return _add_tools(collection)


def build_room(collection):
    """Add table, wall and lamps without the tools."""
    shapes.link_object(collection, "Table", _table_mesh())
    shapes.link_object(collection, "Wall", _wall_mesh())
    for lamp in LAMPS:
        _add_lamp(collection, *lamp)


# --- light -----------------------------------------------------------------------------------------------------------

# Of each square lamp: name, place, watts, colour, side.
LAMPS = (
    ("Key Lamp", (-5.2, -4.6, 6.2), 1150.0, (1.0, 0.84, 0.66), 2.6),
    ("Rim Lamp", (4.6, 4.4, 5.4), 760.0, (1.0, 0.72, 0.45), 1.8),
    ("Fill Lamp", (6.5, -6.0, 4.0), 260.0, (0.62, 0.78, 1.0), 5.0),
)


def _add_lamp(collection, name, place, watts, color, size):
    data = bpy.data.lights.new(name, "AREA")
    data.energy, data.color, data.size = watts, color, size
    lamp = shapes.link_object(collection, name, data)
    lamp.location = place
    lamp.rotation_euler = (AIM - Vector(place)).to_track_quat("-Z", "Y").to_euler()


# --- table and wall --------------------------------------------------------------------------------------------------


def _table_mesh():
    builder = shapes.MeshBuilder()
    rows = int((TABLE_DEPTH[1] - TABLE_DEPTH[0]) / PLANK)
    for row in range(rows):
        y = TABLE_DEPTH[0] + (row + 0.5) * PLANK
        shade = float(landscape.lattice(np.int64(row), np.int64(3), 77))
        builder.add(
            shapes.beam((LENGTH, PLANK - GAP, THICKNESS), (0.0, y, -0.5 * THICKNESS), 0.012), min(int(3.0 * shade), 2), smooth=False
        )
    along_x = (0.55, 9.0, 9.0)
    return builder.build(
        "Table",
        [
            materials.wood(name, light, dark, along_x, roughness=0.38)
            for name, light, dark in (
                ("Table Oak", (0.235, 0.125, 0.062), (0.135, 0.064, 0.030)),
                ("Dark Table Oak", (0.190, 0.095, 0.046), (0.110, 0.050, 0.024)),
                ("Light Table Oak", (0.280, 0.155, 0.080), (0.165, 0.082, 0.040)),
            )
        ],
    )


def _wall_mesh():
    """Make the mesh of floor and wall with a rounded transition, so that no edge is visible."""
    angle = np.linspace(0.0, 0.5 * math.pi, 24)
    y = np.concatenate(([-30.0], WALL_Y - WALL_BEND * (1.0 - np.sin(angle)), [WALL_Y]))
    z = np.concatenate(([0.0], WALL_BEND * (1.0 - np.cos(angle)), [18.0])) - 1.6
    x = np.array((-30.0, 30.0))
    sections = np.stack(np.broadcast_arrays(x[:, None], y[None, :], z[None, :]), axis=-1)
    builder = shapes.MeshBuilder()
    builder.add(shapes.loft(sections, closed=False))
    return builder.build("Wall", [_plaster()])


def _plaster():
    material, shader, output = materials.new_material("Plaster")
    place = shader.add("ShaderNodeTexCoord").outputs["Object"]
    color = shader.ramp(shader.noise(place, 0.55, detail=5.0), ((0.32, (0.030, 0.105, 0.118)), (0.70, (0.052, 0.160, 0.172))))
    # There is no noise bump, because EEVEE in Blender 3.4 renders single pixels of such bumps black.
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.9, specular=0.15)
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (0.04, 0.13, 0.145, 1.0)
    return material


# --- tools -----------------------------------------------------------------------------------------------------------

HANDLE = (  # profile: radius, place along the handle; m
    (0.004, 1.10),
    (0.030, 1.08),
    (0.042, 0.95),
    (0.056, 0.60),
    (0.050, 0.30),
    (0.058, 0.12),
    (0.044, 0.02),
    (0.004, 0.0),
)
FERRULE = ((0.004, 1.30), (0.026, 1.29), (0.036, 1.10), (0.036, 1.02), (0.004, 1.015))
SPATULA_HALF = ((0.0, 0.012), (0.18, 0.030), (0.42, 0.062), (0.62, 0.050), (0.74, 0.004))  # place along the blade, half width; m


def _add_tools(collection):
    """Add a loop tool, a spatula, and balls of clay, which are returned."""
    balls = []
    beech = materials.wood("Beech", (0.52, 0.33, 0.18), (0.38, 0.22, 0.11), (22.0, 2.0, 22.0), roughness=0.5)
    steel = materials.principled("Tool Steel", color=(0.70, 0.70, 0.72), metallic=1.0, roughness=0.25)
    clay = materials.principled("Spare Clay", color=(0.40, 0.135, 0.055), roughness=0.6)
    loop = _tool(collection, "Loop Tool", [beech, steel], _loop())
    loop.location, loop.rotation_euler.z = (-0.72, -2.00, 0.058), math.radians(-78.0)
    spatula = _tool(collection, "Spatula", [beech, steel], _spatula())
    spatula.location, spatula.rotation_euler.z = (-1.35, -2.42, 0.058), math.radians(-92.0)
    for index, (x, y, size) in enumerate(((-0.74, -1.45, 0.20), (-0.36, -1.66, 0.12))):
        builder = shapes.MeshBuilder()
        builder.add(shapes.sphere(size, (0.0, 0.0, 0.86 * size), (1.0, 0.95, 0.88), 40, 26))
        ball = shapes.link_object(collection, f"Clay Ball {index + 1}", builder.build("Clay Ball", [clay]))
        ball.location = (x, y, 0.0)
        balls.append(ball)
    return balls


def _tool(collection, name, slots, head):
    builder = shapes.MeshBuilder()
    builder.add(shapes.lathe(shapes.smooth_profile_points(HANDLE, 40), 28), 0)
    builder.add(shapes.lathe(FERRULE, 28), 1)
    builder.add(head, 1)
    return shapes.link_object(collection, name, builder.build(name, slots))


def _loop():
    """Make the loop of the loop tool: a wire bent to the shape of a drop, in the plane of the table."""
    around = np.linspace(0.0, 1.0, 41)
    x = 0.17 * np.sin(2.0 * math.pi * around) * np.sin(math.pi * around) ** 0.6
    y = 1.24 + 0.52 * np.sin(math.pi * around)
    angle = shapes.ring(8)
    ahead = np.gradient(np.stack((x, y), axis=1), axis=0)
    side = np.stack((-ahead[:, 1], ahead[:, 0]), axis=1) / np.linalg.norm(ahead, axis=1)[:, None]
    wide, tall = 0.010 * np.cos(angle), 0.010 * np.sin(angle)
    sections = np.stack(
        (x[:, None] + side[:, :1] * wide, y[:, None] + side[:, 1:] * wide, np.broadcast_to(tall, (len(x), len(angle)))), axis=-1
    )
    return shapes.loft(sections)


def _spatula():
    """Make the flat blade of the spatula."""
    profile = shapes.smooth_profile(SPATULA_HALF, 24)
    angle = shapes.ring(16)
    y = np.broadcast_to(1.22 + profile[:, :1], (len(profile), len(angle)))
    sections = np.stack((profile[:, 1:2] * np.cos(angle), y, 0.009 * np.sin(angle) * np.ones_like(y)), axis=-1)
    return shapes.loft(sections[::-1])
