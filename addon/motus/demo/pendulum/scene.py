"""The scene "Motus Pendulum": a fan of double pendulums half a degree apart, a single copy of one, one with different angles, and a spherical one."""

import math

import bpy
import numpy as np
from mathutils import Vector

from ..stage import lighting, materials, shapes, staging

SCENE_NAME = "Motus Pendulum"
FRAMES_PER_SECOND = 24
SECONDS = 20

COUNT = 24
LENGTHS = (1.05, 0.95)
ROD_RADIUS, BOB_RADIUS, SPACING = 0.017, 0.1, 0.012
TRAIL, FAN_TRAIL, TRAIL_RADIUS = 3.0, 0.7, 0.016  # lengths of trails in s, and their radius in m
FAN_SCALE = 1.5
PLACES = (-4.5, 0.0, 4.5)  # x of the pivots, m: the pendulum alone, the fan, the pendulum with different angles
ROSETTE = {"location": (4.5, 0.0, 3.3), "length1": 0.85, "angle1": math.radians(36.0), "velocity_sideways": 0.9}
ROSETTE_TRAIL = 6.0  # length in s
WALL_Y, FLOOR_Z, BEND = 0.75, -3.3, 1.0
AIM = Vector((0.0, 0.0, -0.1))
# Of each square lamp: name, place, watts, colour, side.
LAMPS = (
    ("Key Lamp", (-6.5, -7.5, 7.0), 3200.0, (1.0, 0.88, 0.74), 1.6),
    ("Fill Lamp", (9.0, -8.0, 1.0), 500.0, (0.62, 0.78, 1.0), 5.0),
    ("Top Lamp", (2.0, -2.5, 6.0), 420.0, (1.0, 0.80, 0.60), 3.0),
)
CAMERA_PLACE, CAMERA_LENS = Vector((0.6, -15.6, 0.3)), 41.0
VIEWS = (("AgX", "AgX - Punchy", 0.0), ("Filmic", "High Contrast", 0.0))


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND, SECONDS * FRAMES_PER_SECOND)
    hall, swings = (staging.new_collection(scene, name) for name in ("Hall", "Pendulums"))
    scene.world = _world()
    lighting.set_color_management(scene, VIEWS)
    _add_hall(hall)
    pivots = _add_pendulums(context, swings)
    _add_brackets(hall, pivots)
    _add_camera(scene, hall)
    scene.frame_set(1)
    return scene


def _world():
    """Make the world: dim light from all directions."""
    world = bpy.data.worlds.new("Motus Hall")
    if not world.use_nodes:
        world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.10, 0.12, 0.17, 1.0)
    background.inputs["Strength"].default_value = 0.7
    return world


# --- the hall --------------------------------------------------------------------------------------------------------


def _add_hall(collection):
    """Add wall, floor and lamps."""
    shapes.link_object(collection, "Wall", _wall_mesh())
    for name, place, watts, color, size in LAMPS:
        data = bpy.data.lights.new(name, "AREA")
        data.energy, data.color, data.size = watts, color, size
        lamp = shapes.link_object(collection, name, data)
        lamp.location = place
        lamp.rotation_euler = (AIM - Vector(place)).to_track_quat("-Z", "Y").to_euler()


def _wall_mesh():
    """Make the mesh of floor and wall with a rounded transition, so that no edge is visible."""
    angle = np.linspace(0.0, 0.5 * math.pi, 24)
    y = np.concatenate(([-40.0], WALL_Y - BEND * (1.0 - np.sin(angle)), [WALL_Y]))
    z = np.concatenate(([0.0], BEND * (1.0 - np.cos(angle)), [20.0])) + FLOOR_Z
    x = np.array((-40.0, 40.0))
    sections = np.stack(np.broadcast_arrays(x[:, None], y[None, :], z[None, :]), axis=-1)
    builder = shapes.MeshBuilder()
    builder.add(shapes.loft(sections, closed=False))
    plaster = materials.principled("Hall Plaster", color=(0.10, 0.12, 0.16), roughness=0.85, specular=0.15)
    return builder.build("Wall", [plaster])


def _add_brackets(collection, pivots):
    """Add a brass pin from the wall to each pivot, with a knob in front."""
    brass = materials.principled("Brass", color=(0.80, 0.55, 0.22), metallic=1.0, roughness=0.22)
    for pivot in pivots:
        front = -0.5 * COUNT * SPACING - 0.06
        builder = shapes.MeshBuilder()
        profile = (
            (0.001, front),
            (0.045, front + 0.01),
            (0.055, front + 0.03),
            (0.045, front + 0.05),
            (0.024, front + 0.055),
            (0.024, WALL_Y - 0.05),
            (0.13, WALL_Y - 0.04),
            (0.14, WALL_Y + 0.01),
        )
        builder.add(shapes.lathe(profile[::-1]))
        bracket = shapes.link_object(collection, f"{pivot.name} Pin", builder.build("Pin", [brass]))
        bracket.location = pivot.location


# --- what swings -----------------------------------------------------------------------------------------------------


def _add_pendulums(context, collection):
    """Add the demonstration's pendulums to the collection with the public operator. Returns the pivots."""
    view_layer = context.view_layer
    view_layer.active_layer_collection = view_layer.layer_collection.children[collection.name]
    if bpy.ops.motus.pendulum_add(
        kind="CHAOS",
        count=COUNT,
        location=(0.0, 0.0, 0.0),
        length1=LENGTHS[0],
        length2=LENGTHS[1],
        rod_radius=ROD_RADIUS,
        bob_radius=BOB_RADIUS,
        spacing=SPACING,
    ) != {"FINISHED"}:
        raise RuntimeError("The pendulums could not be added")
    fan, alone, other = sorted(context.selected_objects, key=lambda pivot: pivot.location.x)
    for pivot, place in zip((alone, fan, other), PLACES):
        pivot.location.x = place
        bpy.ops.motus.pendulum_trail_add(object=pivot.name, seconds=TRAIL if pivot != fan else FAN_TRAIL, thickness=TRAIL_RADIUS)
    fan.scale = FAN_SCALE, FAN_SCALE, FAN_SCALE
    return alone, fan, other, _add_rosette(context)


def _add_rosette(context):
    """Add the spherical pendulum, which draws a rosette, to the active collection. Returns the pivot."""
    if bpy.ops.motus.pendulum_add(kind="SPHERICAL", rod_radius=ROD_RADIUS, bob_radius=BOB_RADIUS, **ROSETTE) != {"FINISHED"}:
        raise RuntimeError("The spherical pendulum could not be added")
    pivot = context.object
    bpy.ops.motus.pendulum_trail_add(object=pivot.name, seconds=ROSETTE_TRAIL, thickness=TRAIL_RADIUS)
    return pivot


def _add_camera(scene, collection):
    """Add a camera in front of the middle pendulum."""
    data = bpy.data.cameras.new("Hall Camera")
    data.lens = CAMERA_LENS
    camera = shapes.link_object(collection, "Hall Camera", data)
    camera.location = CAMERA_PLACE
    camera.rotation_euler = (AIM - CAMERA_PLACE).to_track_quat("-Z", "Y").to_euler()
    scene.camera = camera
