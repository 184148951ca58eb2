"""Two lanterns of the main scene, one below the other on an arm beside the path: a double pendulum that swings in the wind."""

import math

import bpy
import numpy as np

from ..character import parts
from ..stage import materials, shapes
from ..village import props, terrain
from . import terrain as main_terrain

PLACE = (-2.75, 4.7)  # x and y of the post, m
ARM, HIGH = (0.95, 0.0), 2.95  # x and y from the post to the pivot, and the pivot's height above the ground, m
LENGTHS, ANGLES, MASSES = (0.72, 0.66), (math.radians(38.0), math.radians(-14.0)), (1.0, 0.7)
ROD, BOB = 0.007, 0.016  # radii, m
SIZES = (1.55, 1.25)
WATTS = 26.0


def build(context, collection, covered):
    """Build the post and the pendulum of two lanterns. Returns the pivot. covered: collection of objects on which snow lies."""
    ground = float(main_terrain.height(*np.array(PLACE)))
    iron = materials.principled("Forged Iron", color=(0.014, 0.014, 0.016), roughness=0.45)
    timber = terrain.mottled("Post Wood", (0.060, 0.036, 0.022), (0.12, 0.075, 0.048), 6.0)
    post = shapes.link_object(covered, "Lantern Post", _post_mesh([timber, iron]))
    post.location = (*PLACE, ground)
    pivot = _add_pendulum(context, collection, (PLACE[0] + ARM[0], PLACE[1] + ARM[1], ground + HIGH))
    lantern = _lantern_mesh([iron, props.glow("Hanging Light", 3.2)])
    for rod, size in zip(pivot.motus.pendulum.rods, SIZES):
        for part in (rod.object, rod.bob):
            part.material_slots[0].material = iron
        hanging = shapes.link_object(collection, "Hanging Lantern", lantern, rod.bob)
        hanging.scale = 3 * [size]
        data = bpy.data.lights.new("Hanging Light", "POINT")
        data.energy, data.color, data.shadow_soft_size, data.use_shadow = WATTS, props.WARM, 0.08, False
        shapes.link_object(collection, "Hanging Light", data, hanging).location.z = -0.15
    return pivot


def _add_pendulum(context, collection, place):
    """Add the double pendulum to the collection with the public operator."""
    view_layer = context.view_layer
    view_layer.active_layer_collection = view_layer.layer_collection.children[collection.name]
    if bpy.ops.motus.pendulum_add(
        kind="DOUBLE",
        location=place,
        length1=LENGTHS[0],
        length2=LENGTHS[1],
        angle1=ANGLES[0],
        angle2=ANGLES[1],
        mass1=MASSES[0],
        mass2=MASSES[1],
        rod_radius=ROD,
        bob_radius=BOB,
    ) != {"FINISHED"}:
        raise RuntimeError("The lanterns could not be hung up")
    pivot = context.object
    pivot.name = "Lantern Hook"
    return pivot


def _post_mesh(slots):
    """Make the mesh of a post with an arm, a strut, and a hook at the arm's end. slots: materials."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.beam((0.13, 0.13, HIGH + 0.62), (0.0, 0.0, 0.5 * (HIGH + 0.62) - 0.3), 0.015), smooth=False)
    builder.add(shapes.beam((ARM[0] + 0.34, 0.10, 0.11), (0.5 * ARM[0] + 0.02, 0.0, HIGH + 0.11), 0.012), smooth=False)
    line = np.array([(0.05 + 0.50 * s, 0.0, HIGH - 0.46 + 0.52 * s**0.8) for s in np.linspace(0.0, 1.0, 8)])
    builder.add(parts.tube(line, 0.035, sides=8))
    builder.add(shapes.upright(shapes.lathe(((0.010, 0.06), (0.010, 0.0), (0.02, -0.012), (0.004, -0.02)), 12), (ARM[0], 0.0, HIGH)), 1)
    return builder.build("Lantern Post", slots)


def _lantern_mesh(slots):
    """Make the mesh of a lantern that hangs from the origin. slots: materials."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.upright(shapes.lathe(((0.004, 0.0), (0.020, -0.015), (0.105, -0.075), (0.085, -0.085)), 6)), 0, smooth=False)
    builder.add(shapes.upright(shapes.lathe(((0.066, -0.085), (0.054, -0.225)), 6)), 1, smooth=False)
    builder.add(shapes.upright(shapes.lathe(((0.070, -0.222), (0.070, -0.245), (0.030, -0.265), (0.003, -0.268)), 6)), 0, smooth=False)
    for angle in shapes.ring(6):
        line = [(radius * math.cos(angle), radius * math.sin(angle), z) for radius, z in ((0.070, -0.083), (0.063, -0.16), (0.060, -0.226))]
        builder.add(parts.tube(np.array(line), 0.005, sides=6))
    return builder.build("Hanging Lantern", slots)
