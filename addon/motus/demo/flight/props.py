"""Props along the flight: gates on the course, balloons in the bends and a village by the lake."""

import math

import bpy
import numpy as np

from ..flying import flight
from ..places import landscape
from ..stage import materials, shapes

GATE_RADIUS, GATE_THICKNESS, GATE_STRIPES = 8.5, 0.4, 16
GATES = 8
# Of each balloon: x, y, height above the ground, size, first and second colour.
BALLOONS = (
    (205.0, -5.0, 30.0, 1.0, (0.80, 0.13, 0.04), (0.92, 0.80, 0.56)),
    (-20.0, 265.0, 52.0, 1.1, (0.90, 0.42, 0.05), (0.10, 0.20, 0.36)),
    (-190.0, 40.0, 34.0, 0.9, (0.06, 0.30, 0.42), (0.92, 0.82, 0.60)),
    (60.0, -270.0, 60.0, 1.2, (0.86, 0.62, 0.08), (0.62, 0.07, 0.06)),
    (330.0, 190.0, 70.0, 1.0, (0.92, 0.84, 0.66), (0.62, 0.07, 0.06)),
)
BALLOON_RADIUS = 8.0
LIFT, RISES = 3.5, 0.12  # m by which balloons rise and sink, and how often a second
# Profile of the balloon from the crown to the mouth: (radius, height), in balloon radii.
BALLOON_PROFILE = (
    (0.01, 1.0),
    (0.42, 0.92),
    (0.80, 0.62),
    (0.99, 0.16),
    (0.97, -0.22),
    (0.72, -0.72),
    (0.36, -1.18),
    (0.24, -1.3),
)
VILLAGE_CENTRE, VILLAGE_RADIUS, HOUSES = (-30.0, -178.0), 75.0, 38


def build(collection, course, length, haze, is_clear):
    """Add gates, balloons and the village.

    length: of the course, m. haze: node group of the haze. is_clear: a function of arrays x and y that says where houses may stand.
    """
    add_gates(collection, course, length, haze)
    for index, (x, y, height, size, first, second) in enumerate(BALLOONS):
        ground = float(landscape.height(np.array([x]), np.array([y]))[0])
        mesh = _balloon_mesh(f"Balloon {index + 1}", first, second, haze)
        balloon = shapes.link_object(collection, mesh.name, mesh)
        balloon.location = (x, y, max(ground, landscape.WATER_LEVEL) + height)
        balloon.scale = (size,) * 3
        _float(balloon, index)
    add_village(collection, haze, is_clear)


def add_gates(collection, course, length, haze):
    """Add striped rings that Follow Path keeps on the course, so that they move if the course is edited."""
    mesh = _gate_mesh(haze)
    for index in range(GATES):
        gate = shapes.link_object(collection, f"Gate {index + 1}", mesh)
        flight.follow(
            gate,
            course,
            timing="MANUAL",
            offset=length * (index + 0.5) / GATES,
            orientation="WORLD_UP",
            forward_axis="POS_Y",
            up_axis="POS_Z",
        )


def _gate_mesh(haze):
    segments = 96
    vertices, faces = shapes.torus(GATE_RADIUS, GATE_THICKNESS, segments, 12)
    around = np.arange(len(faces)) % segments
    builder = shapes.MeshBuilder()
    builder.add((vertices, faces), (around * GATE_STRIPES // segments) % 2)
    return builder.build(
        "Gate",
        [
            materials.principled("Gate Red", haze, color=(0.72, 0.03, 0.02), roughness=0.45),
            materials.principled("Gate White", haze, color=(0.90, 0.86, 0.78), roughness=0.45),
        ],
    )


def _balloon_mesh(name, first, second, haze):
    """Make the mesh of a hot-air balloon with gores in two colours. The origin is the middle of the envelope."""
    gores, per_gore = 16, 4
    curve = shapes.smooth_profile_points(BALLOON_PROFILE, 26) * BALLOON_RADIUS
    vertices, faces = shapes.lathe(curve, gores * per_gore)
    # Gores swell between their seams.
    angle = np.arctan2(vertices[:, 2], vertices[:, 0])
    swell = 1.0 + 0.025 * np.abs(np.sin(angle * gores / 2.0))
    vertices[:, (0, 2)] *= swell[:, None]
    gore = (np.arange(len(faces)) % (gores * per_gore)) // per_gore
    builder = shapes.MeshBuilder()
    builder.add((vertices[:, (0, 2, 1)] * (1.0, -1.0, 1.0), faces), gore % 2)
    basket_top = -1.3 * BALLOON_RADIUS - 3.2
    builder.add(shapes.box((1.5, 1.5, 1.2), (0.0, 0.0, basket_top - 0.6)), 2, smooth=False)
    for x in (-0.7, 0.7):
        for y in (-0.7, 0.7):
            builder.add(shapes.box((0.06, 0.06, 3.4), (x, y, basket_top + 1.6)), 2, smooth=False)
    return builder.build(
        name,
        [
            materials.principled(f"{name} A", haze, color=first, roughness=0.6),
            materials.principled(f"{name} B", haze, color=second, roughness=0.6),
            materials.principled("Wicker", haze, color=(0.20, 0.11, 0.05), roughness=0.9),
        ],
    )


def _float(balloon, seed):
    """Let a balloon drift up and down on the air, by a motion driver."""
    result = bpy.ops.motus.driver_add(
        datablock=balloon.name,
        data_path="location",
        index=2,
        function="NOISE",
        base=balloon.location.z,
        amplitude=LIFT,
        speed=RISES,
        seed=seed,
    )
    if result != {"FINISHED"}:
        raise RuntimeError(f"{balloon.name} could not be given a motion driver")


def add_village(collection, haze, is_clear):
    """Add houses with red roofs and a church on the lake's southern shore, where is_clear(x, y), as one mesh object."""
    builder = shapes.MeshBuilder()
    index = np.arange(HOUSES)
    luck = [landscape.value_noise(index * 7.31 + k * 31.7, index * 3.17, landscape.SEED + 300 + k) for k in range(4)]
    distance, bearing = VILLAGE_RADIUS * np.sqrt(luck[0]), index * 2.39996
    x = VILLAGE_CENTRE[0] + distance * np.cos(bearing) * 1.5
    y = VILLAGE_CENTRE[1] + distance * np.sin(bearing) * 0.6
    z = landscape.height(x, y)
    dry = (z > 1.6) & (landscape.steepness_at(x, y) < 0.35)
    for i in index[dry & is_clear(x, y)]:
        length, width = 8.0 + 5.0 * luck[1][i], 6.0 + 1.5 * luck[2][i]
        _add_house(builder, (x[i], y[i], z[i] - 0.8), math.pi * luck[3][i], (length, width, 4.4), 3.2)
    ground = float(landscape.height(np.array([VILLAGE_CENTRE[0]]), np.array([VILLAGE_CENTRE[1]]))[0])
    _add_house(builder, (*VILLAGE_CENTRE, ground - 0.8), 0.3, (17.0, 8.0, 7.0), 5.0)
    tower = np.array((math.cos(0.3), math.sin(0.3))) * 10.0 + VILLAGE_CENTRE
    _add_house(builder, (*tower, ground - 0.8), 0.3, (5.0, 5.0, 15.0), 9.0, spire=True)
    mesh = builder.build(
        "Village",
        [
            materials.principled("Plaster", haze, color=(0.80, 0.72, 0.58), roughness=0.9),
            materials.principled("Roof Tiles", haze, color=(0.42, 0.10, 0.05), roughness=0.8),
        ],
    )
    return shapes.link_object(collection, "Village", mesh)


def _add_house(builder, place, turn, size, roof, spire=False):
    """Add a house: a box with a gable roof, or with a pyramid if `spire` is set. Material slot 0 is plaster, slot 1 tiles."""
    length, width, wall = size
    eave = 0.5
    top = wall + roof
    reach = 0.0 if spire else length / 2 + eave
    cover = [(sx * (length / 2 + eave), sy * (width / 2 + eave), wall - 0.3) for sx in (-1, 1) for sy in (-1, 1)]
    cover += [(-reach, 0.0, top), (reach, 0.0, top)]
    slopes, ends = [(0, 4, 5, 2), (1, 3, 5, 4)], [(0, 1, 4), (2, 5, 3)]
    # The wall under each end of the ridge, a little inside the roof.
    gables = [(sx * length / 2, y, z) for sx in (-1, 1) for y, z in ((-width / 2, wall), (width / 2, wall), (0.0, top - 0.5))]
    cos, sin = math.cos(turn), math.sin(turn)
    rotation = np.array(((cos, sin, 0.0), (-sin, cos, 0.0), (0.0, 0.0, 1.0)))
    walls, wall_faces = shapes.box((length, width, wall + 1.0), (0.0, 0.0, wall / 2 - 0.5))
    builder.add((walls @ rotation + place, wall_faces), 0, smooth=False)
    builder.add((np.array(cover) @ rotation + place, slopes), 1, smooth=False)
    if spire:
        builder.add((np.array(cover) @ rotation + place, ends), 1, smooth=False)
    else:
        builder.add((np.array(gables) @ rotation + place, [(0, 1, 2), (3, 5, 4)]), 0, smooth=False)
