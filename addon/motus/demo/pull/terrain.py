"""A tray with a sea from which a landscape rises: a grid with many pins (pulls with a strength that can be keyed)."""

import math

import bpy
import numpy as np

from ..places import landscape
from ..stage import keying, materials, shapes

WIDTH, DEPTH, SPACING = 4.0, 3.2, 0.02  # of the grid, m
PLACE, TURN = (1.42, 0.72, 0.0), math.radians(-9.0)  # of the tray on the table
BED, SEA = 0.14, 0.25  # heights in the tray, m
FRAME_WIDTH, FRAME_HEIGHT = 0.15, 0.31


def _ring(centre, radius, count, turn):
    """List `count` places (x, y) at equal distances on a circle. turn: angle of the first place, in radians."""
    angles = turn + 2.0 * math.pi * np.arange(count) / count
    return [(centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)) for angle in angles.tolist()]


# Of each pin: name, place in the tray, radius, height, falloff, further settings.
PINS = (
    ("Mainland", (0.50, 0.36), 1.20, 0.21, "SMOOTH", {}),
    ("Summit", (0.56, 0.50), 1.05, 1.14, "SHARP", {}),
    ("East Peak", (1.02, 0.36), 0.80, 0.50, "SHARP", {}),
    ("West Peak", (0.08, 0.74), 0.74, 0.52, "SHARP", {}),
    ("North Peak", (0.80, 0.94), 0.64, 0.42, "SHARP", {}),
    ("Foothill", (-0.14, 0.36), 0.50, 0.16, "GAUSSIAN", {}),
    ("Headland", (1.38, -0.04), 0.58, 0.24, "GAUSSIAN", {}),
    ("Volcano Foot", (-1.08, -0.24), 0.90, 0.21, "SMOOTH", {}),
    ("Volcano", (-1.08, -0.24), 0.72, 0.62, "SHARP", {}),
    ("Crater", (-1.08, -0.26), 0.20, -0.27, "SPHERE", {}),
    ("Northern Island", (-1.18, 0.96), 0.62, 0.28, "GAUSSIAN", {}),
    ("Northern Hill", (-0.94, 0.90), 0.42, 0.16, "SMOOTH", {}),
    ("Mesa", (1.30, -0.84), 0.60, 0.62, "SPHERE", {"use_maximum": True, "maximum": 0.29}),
    ("Mesa Step", (1.35, -0.80), 0.32, 0.42, "SPHERE", {"use_maximum": True, "maximum": 0.45}),
    ("Atoll", (0.06, -1.08), 0.46, 0.24, "SMOOTH", {}),
    ("Lagoon", (0.06, -1.08), 0.30, -0.22, "SMOOTH", {}),
    ("Needle", (0.72, -1.06), 0.11, 0.38, "ROOT", {}),
    ("Small Needle", (0.60, -1.22), 0.08, 0.25, "ROOT", {}),
    *(("Ridge", place, 0.34, 0.15, "SHARP", {}) for place in _ring((0.54, 0.46), 0.46, 5, 0.2)),
    *(("Gully", place, 0.30, -0.14, "SHARP", {}) for place in _ring((0.54, 0.46), 0.44, 5, 0.83)),
    *(("Flank", place, 0.22, -0.07, "SHARP", {}) for place in _ring((-1.08, -0.24), 0.34, 6, 0.5)),
)
RELIEF = 110  # pulls that roughen the bed before it rises
RELIEF_SEED = 41
RISE, FALL = 52, 166  # frames at which the first pin begins to rise, and to sink
SPREAD = 26  # frames from the start of the first pin's motion to the start of the last pin's motion
RISING = ((0, 0.0), (15, 1.12), (23, 0.96), (30, 1.0))
FALLING = ((0, 1.0), (22, 0.0))

SAND, MEADOW, WOODLAND = (0.62, 0.50, 0.30), (0.20, 0.30, 0.055), (0.070, 0.145, 0.040)
ROCK, SNOW = (0.215, 0.180, 0.160), (0.84, 0.86, 0.90)
# Height over the sea from -0.15 to 1.05 m, as a fraction, with the ground's colour there.
HEIGHTS = (
    (0.00, (0.012, 0.085, 0.140)),
    (0.045, (0.020, 0.130, 0.180)),
    (0.095, (0.10, 0.36, 0.37)),
    (0.123, SAND),
    (0.152, SAND),
    (0.185, MEADOW),
    (0.30, MEADOW),
    (0.43, WOODLAND),
    (0.56, WOODLAND),
    (0.64, ROCK),
    (0.73, ROCK),
    (0.79, SNOW),
)


def build(context, collection):
    """Add a tray with a sea and a land, and pins that raise the land into hills over time. Returns the land's object."""
    tray = shapes.link_object(collection, "Tray", _tray_mesh())
    tray.location, tray.rotation_euler.z = PLACE, TURN
    sea = shapes.link_object(collection, "Sea", _sea_mesh(), tray)
    sea.location.z = SEA
    land = _add_grid(context, collection)
    land.parent, land.location = tray, (0.0, 0.0, BED)
    land.data.materials.append(_ground_material())
    context.view_layer.update()
    _roughen(land)
    for name, (x, y), radius, height, falloff, more in PINS:
        _check(
            bpy.ops.motus.pin_add(
                object=land.name,
                name=name,
                location=(x, y, 0.0),
                displacement=(0.0, 0.0, height),
                radius=radius,
                falloff=falloff,
                unit="LOCAL",
                distance="STRAIGHT",
                mirror=set(),
                strength=0.0,
                **more,
            ),
            land,
        )
    _key(land)
    return land


def _check(result, land):
    if result != {"FINISHED"}:
        raise RuntimeError(f"{land.name} could not be pulled")


# --- the land --------------------------------------------------------------------------------------------------------


def _add_grid(context, collection):
    """Add a flat grid with the operator motus.grid_add, and move it to the collection."""
    columns, rows = round(WIDTH / SPACING) + 1, round(DEPTH / SPACING) + 1
    _check(
        bpy.ops.motus.grid_add(
            width=columns, height=rows, spacing=SPACING, align="WORLD", location=(0.0, 0.0, 0.0), rotation=(0.0, 0.0, 0.0)
        ),
        collection,
    )
    land = context.view_layer.objects.active
    if context.mode != "OBJECT":  # the user's preferences start new objects in Edit Mode
        bpy.ops.object.mode_set(mode="OBJECT")
    for other in list(land.users_collection):
        other.objects.unlink(land)
    collection.objects.link(land)
    land.name = land.data.name = "Land"
    context.view_layer.objects.active = land
    return land


def _roughen(land):
    """Make the bed uneven by small permanent pulls at repeatable random places."""
    for index in range(RELIEF):
        x, y, size, way = (_luck(index, salt) for salt in range(4))
        radius = 0.10 + 0.24 * size * size
        place = ((x - 0.5) * (WIDTH - 2.0 * radius), (y - 0.5) * (DEPTH - 2.0 * radius), 0.0)
        _check(
            bpy.ops.motus.pick_pull(
                object=land.name,
                location=place,
                displacement=(0.0, 0.0, (way - 0.45) * 0.30 * radius),
                radius=radius,
                unit="LOCAL",
                falloff="SHARP",
                distance="STRAIGHT",
                accumulate=True,
                mirror=set(),
            ),
            land,
        )


def _luck(index, salt):
    """Return a repeatable random value in [0, 1). index: of the pull. salt: tells apart the several random values of one pull."""
    return float(landscape.lattice(np.int64(index), np.int64(salt), RELIEF_SEED))


def _key(land):
    """Key the strengths of the pins: they rise one after another from the near left to the far right, and sink in that order."""
    places = np.array([pin[1] for pin in PINS])
    order = places @ np.array((0.8, 0.6))
    delays = SPREAD * (order - order.min()) / (order.max() - order.min())
    for pin, delay in zip(land.motus.pull.pins, delays):
        keys = [(RISE + delay + frame, value) for frame, value in RISING]
        keys += [(FALL + 0.5 * delay + frame, value) for frame, value in FALLING]
        keying.key_cycle(pin, "strength", keys)


def _ground_material():
    """Material of the ground, coloured by height above the sea and by slope, both read from the deformed mesh at each frame."""
    material, shader, output = materials.new_material("Raised Ground")
    geometry = shader.add("ShaderNodeNewGeometry").outputs
    place = geometry["Position"]
    patches = shader.math("SUBTRACT", shader.noise(place, 3.4, detail=6.0), 0.5)
    above = shader.math("SUBTRACT", shader.add("ShaderNodeSeparateXYZ", {0: place}).outputs[2], SEA)
    ruffled = shader.math("ADD", above, shader.math("MULTIPLY", patches, shader.math("MULTIPLY", shader.math("MAXIMUM", above, 0.0), 0.9)))
    share = shader.math("DIVIDE", shader.math("ADD", ruffled, 0.15), 1.2, clamp=True)
    color = shader.ramp(share, HEIGHTS, interpolation="LINEAR")
    upward = shader.add("ShaderNodeSeparateXYZ", {0: geometry["Normal"]}).outputs[2]
    steep = shader.ramp(shader.math("ADD", upward, shader.math("MULTIPLY", patches, 0.25)), ((0.46, (1.0,) * 3), (0.66, (0.0,) * 3)))
    dry = shader.math("MULTIPLY", shader.math("SUBTRACT", above, 0.02), 25.0, clamp=True)
    color = shader.mix(shader.math("MULTIPLY", steep, dry), color, (*ROCK, 1.0))
    grain = shader.ramp(shader.noise(place, 26.0, detail=5.0), ((0.30, (0.72,) * 3), (0.70, (1.20,) * 3)))
    bump = shader.add("ShaderNodeBump", {"Height": shader.noise(place, 17.0, detail=8.0), "Strength": 0.55, "Distance": 0.06})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(
        shader, node, color=shader.mix(1.0, color, grain, blend="MULTIPLY"), roughness=0.92, specular=0.15, normal=bump.outputs[0]
    )
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*MEADOW, 1.0)
    return material


# --- tray and sea ----------------------------------------------------------------------------------------------------


def _tray_mesh():
    builder = shapes.MeshBuilder()
    x, y, half = WIDTH / 2.0, DEPTH / 2.0, FRAME_WIDTH / 2.0
    for sign in (-1.0, 1.0):
        builder.add(
            shapes.beam((WIDTH + 2.0 * FRAME_WIDTH, FRAME_WIDTH, FRAME_HEIGHT), (0.0, sign * (y + half), FRAME_HEIGHT / 2.0), 0.022),
            0,
            smooth=False,
        )
        builder.add(
            shapes.beam((FRAME_WIDTH, DEPTH, FRAME_HEIGHT - 0.002), (sign * (x + half), 0.0, FRAME_HEIGHT / 2.0), 0.022), 1, smooth=False
        )
    colors = ((0.135, 0.052, 0.026), (0.072, 0.026, 0.013))
    return builder.build(
        "Tray",
        [
            materials.wood("Tray Walnut", *colors, (0.8, 14.0, 14.0), roughness=0.32),
            materials.wood("Tray Walnut Ends", *colors, (14.0, 0.8, 14.0), roughness=0.32),
        ],
    )


def _sea_mesh():
    builder = shapes.MeshBuilder()
    corners = [(sx * WIDTH / 2.0, sy * DEPTH / 2.0, 0.0) for sy in (-1, 1) for sx in (-1, 1)]
    builder.add((corners, [(0, 1, 3, 2)]))
    return builder.build("Sea", [_water_material()])


def _water_material():
    """Make the material of the sea: clear, with ripples. The bed's colour shows the depth."""
    material, shader, output = materials.new_material("Tray Water")
    place = shader.add("ShaderNodeNewGeometry").outputs["Position"]
    bump = shader.add("ShaderNodeBump", {"Height": shader.noise(place, 5.0, detail=4.0), "Strength": 0.10, "Distance": 0.1})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=(0.010, 0.095, 0.125), roughness=0.05, specular=0.7, alpha=0.42, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0])
    materials.make_transparent(material)
    material.diffuse_color = (0.03, 0.17, 0.22, 0.6)
    return material
