"""A small railway on the shore of the lake: its line, and a train whose vehicles hang on two points of it each, as on bogies."""

import math
from typing import NamedTuple

import bpy
import numpy as np

from ..flying import flight
from ..places import landscape
from ..stage import materials, shapes

KNOTS = 18  # points of the line around the lake
SHORE = 0.30  # distance of the line from the shore, in the lake's radii
REACH = np.arange(60.0, 420.0)  # m from the lake's middle at which the shore is looked for
LEVEL = 4.6  # height of the rails' feet, m
CLEAR = 7.0  # m on each side of the line without trees or houses
SPACING = 1.5  # m from one sleeper to the next
COARSE = 8  # of as many points of the line, one says whether a place is anywhere near

GAUGE, RAIL_WIDTH, RAIL_HEIGHT = 1.3, 0.12, 0.16  # m
SLEEPER = (2.2, 0.35, 0.18)  # m, across, along, up
# The embankment from its left foot to its right one: m to the side and up.
BANK = ((-7.6, -6.0), (-1.7, -0.12), (1.7, -0.12), (7.6, -6.0))

SPEED = 13.0  # m/s
START = 0.95  # share of the line at which the engine is at first
WAGONS, LENGTH, WIDTH, WHEELBASE, GAP = 5, 8.4, 2.5, 5.6, 9.2  # m
FLOOR, WHEEL = 0.95, 0.42  # m: height of the floors above the rails, radius of the wheels
COLORS = ((0.62, 0.07, 0.06), (0.86, 0.72, 0.44))  # of every second wagon


class Line(NamedTuple):
    """The line: its curve, and points along it at about equal distances with the directions to their right, (n, 3) each."""

    curve: bpy.types.Object
    points: np.ndarray
    right: np.ndarray

    def is_clear(self, x, y):
        """Return for each place of the arrays x and y whether it is beside the line, and not on it."""
        places, found = np.column_stack((x, y)), np.ones(len(x), bool)
        # A place that is on the line is near one of the few points, too, and few places are.
        near = _apart(places, self.points[::COARSE]) <= CLEAR + COARSE * SPACING
        found[near] = _apart(places[near], self.points) > CLEAR
        return found


def _apart(places, points):
    """Return the distance (n,) of places (n, 2) from the nearest of some points (m, 2 or more), seen from above."""
    return np.hypot(places[:, None, 0] - points[:, 0], places[:, None, 1] - points[:, 1]).min(axis=1)


def add_line(collection):
    """Add the curve of the line, level and all around the lake. Returns the Line."""
    turn = 2.0 * math.pi * np.arange(KNOTS) / KNOTS
    directions = np.column_stack((np.cos(turn), np.sin(turn)))
    radii = np.array([_shore(direction) for direction in directions])
    radii = (np.roll(radii, 1) + 2.0 * radii + np.roll(radii, -1)) / 4.0
    knots = directions * radii[:, None] + landscape.LAKE_CENTRE
    curve = flight.add_course(collection, [(x, y, LEVEL) for x, y in knots.tolist()], is_cyclic=True)
    curve.name = curve.data.name = "Railway"
    way = np.array([chord[0] for chord in flight.chords(curve.data.splines[0])])
    passed = np.append(0.0, np.cumsum(np.linalg.norm(np.roll(way, -1, axis=0) - way, axis=1)))
    wanted = np.linspace(0.0, passed[-1], round(passed[-1] / SPACING), endpoint=False)
    points = np.column_stack([np.interp(wanted, passed, np.append(axis, axis[0])) for axis in way.T])
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    return Line(curve, points, np.cross(along / np.linalg.norm(along, axis=1)[:, None], (0.0, 0.0, 1.0)))


def _shore(direction):
    """Return the distance from the lake's middle, m, beyond which there is only land in a direction."""
    x, y = (REACH[:, None] * direction + landscape.LAKE_CENTRE).T
    return REACH[np.flatnonzero(landscape.lake_distance(x, y) < SHORE)[-1]]


def build(collection, line, haze):
    """Add the track of a Line, and its train. haze: node group of the haze."""
    shapes.link_object(collection, "Track", _track_mesh(line, haze))
    engine = shapes.link_object(collection, "Engine", _engine_mesh(haze))
    meshes = [_wagon_mesh(f"Wagon {index + 1}", color, haze) for index, color in enumerate(COLORS)]
    wagons = [shapes.link_object(collection, f"Wagon {index + 1}", meshes[index % len(meshes)]) for index in range(WAGONS)]
    result = bpy.ops.motus.path_train_add(
        objects=",".join(vehicle.name for vehicle in (engine, *wagons)),
        curve=line.curve.name,
        gap=GAP,
        timing="SPEED",
        speed=SPEED,
        offset=START * flight.course_length(line.curve),
        start_frame=flight.FIRST_FRAME,
        extend="LOOP",
        orientation="WORLD_UP",
        wheelbase=WHEELBASE,
        height=RAIL_HEIGHT,
        forward_axis="POS_Y",
        up_axis="POS_Z",
    )
    if result != {"FINISHED"}:
        raise RuntimeError("The train could not be put on its rails")


def _track_mesh(line, haze):
    """Make the mesh of embankment, sleepers and rails."""
    points, right, up = line.points, line.right, np.array((0.0, 0.0, 1.0))
    builder = shapes.MeshBuilder()

    def extrude(outline, slot):
        sections = points[:, None] + np.array([side * right + height * up for side, height in outline]).transpose(1, 0, 2)
        builder.add(shapes.loft(np.concatenate((sections, sections[:1])), closed=False), slot, smooth=False)

    extrude(BANK, 0)
    vertices, faces = shapes.box(SLEEPER)
    for place, side in zip(points, right):
        builder.add((vertices @ np.array((side, np.cross(up, side), up)) + place, faces), 1, smooth=False)
    for side in (-0.5 * GAUGE, 0.5 * GAUGE):
        a, b = side - 0.5 * RAIL_WIDTH, side + 0.5 * RAIL_WIDTH
        extrude(((a, 0.0), (a, RAIL_HEIGHT), (b, RAIL_HEIGHT), (b, 0.0)), 2)
    return builder.build(
        "Track",
        [
            materials.principled("Gravel", haze, color=(0.33, 0.29, 0.24), roughness=0.95),
            materials.principled("Sleepers", haze, color=(0.10, 0.065, 0.04), roughness=0.9),
            materials.principled("Rail Steel", haze, color=(0.30, 0.27, 0.25), roughness=0.35, metallic=0.9),
        ],
    )


def _add_wheels(builder, slot):
    """Add two bogies of two axles each."""
    profile = ((0.0, 0.06), (0.9, 0.06), (1.0, 0.0), (0.9, -0.06), (0.0, -0.06))
    vertices, faces = shapes.lathe(np.array(profile) * (WHEEL, 1.0), 20)
    wheel = vertices[:, (1, 0, 2)], faces[:, ::-1]
    for bogie in (-0.5 * WHEELBASE, 0.5 * WHEELBASE):
        builder.add(shapes.beam((1.5, 2.0, 0.3), (0.0, bogie, WHEEL + 0.16), 0.05), slot, smooth=False)
        for axle in (-0.65, 0.65):
            for side in (-0.5 * GAUGE, 0.5 * GAUGE):
                builder.add((wheel[0] + (side, bogie + axle, WHEEL), wheel[1]), slot)


def _wagon_mesh(name, color, haze):
    """Make the mesh of a coach with a light roof and a row of windows. Its origin is on the rails, below its middle."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.beam((WIDTH, LENGTH, 1.25), (0.0, 0.0, FLOOR + 0.62), 0.06), 0, smooth=False)
    builder.add(shapes.box((WIDTH - 0.12, LENGTH - 0.2, 0.8), (0.0, 0.0, FLOOR + 1.62)), 3, smooth=False)
    for place in np.linspace(-0.5 * LENGTH + 0.2, 0.5 * LENGTH - 0.2, 7):
        builder.add(shapes.box((WIDTH - 0.02, 0.3, 0.82), (0.0, place, FLOOR + 1.62)), 0, smooth=False)
    angle = np.linspace(0.0, np.pi, 13)
    arch = np.column_stack((-0.5 * (WIDTH + 0.24) * np.cos(angle), 0.55 * np.sin(angle)))
    ends = [[(x, y, FLOOR + 2.0 + z) for x, z in arch] for y in (-0.5 * LENGTH - 0.1, 0.5 * LENGTH + 0.1)]
    builder.add(shapes.loft(ends), 1)
    for end, order in zip(ends, (1, -1)):
        middle = np.mean(end, axis=0)
        fan = np.array([(0, index, index + 1) for index in range(1, len(end))])
        builder.add((np.vstack((middle, end)), fan[:, ::order]), 1, smooth=False)
    for buffers in (-0.5 * LENGTH, 0.5 * LENGTH):
        builder.add(shapes.box((0.3, GAP - LENGTH, 0.2), (0.0, buffers, FLOOR)), 2, smooth=False)
    _add_wheels(builder, 2)
    return builder.build(
        name,
        [
            materials.principled(name, haze, color=color, roughness=0.4),
            materials.principled(f"{name} Roof", haze, color=(0.78, 0.76, 0.70), roughness=0.6),
            *_dark(haze),
        ],
    )


def _engine_mesh(haze):
    """Make the mesh of a small steam engine, with its boiler along +Y."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.beam((WIDTH - 0.3, LENGTH, 0.4), (0.0, 0.0, FLOOR + 0.1), 0.08), 2, smooth=False)
    boiler = ((0.0, 3.9), (0.72, 3.9), (0.86, 3.7), (0.86, 2.7), (0.9, 2.68), (0.9, 2.5), (0.86, 2.48), (0.86, -1.6), (0.0, -1.6))
    vertices, faces = shapes.lathe(boiler, 28)
    builder.add((vertices + (0.0, 0.0, FLOOR + 1.25), faces), 0)
    for place, profile in (
        (3.0, ((0.0, 1.35), (0.34, 1.35), (0.42, 1.2), (0.24, 0.75), (0.24, 0.0))),
        (1.2, ((0.0, 0.62), (0.22, 0.56), (0.36, 0.34), (0.36, 0.0))),
    ):
        builder.add(shapes.upright(shapes.lathe(profile, 20), (0.0, place, FLOOR + 1.95)), 1)
    builder.add(shapes.beam((WIDTH - 0.2, 2.2, 1.5), (0.0, -2.7, FLOOR + 0.95), 0.06), 0, smooth=False)
    for x in (-0.5 * WIDTH + 0.2, 0.5 * WIDTH - 0.2):
        for y in (-3.65, -1.75):
            builder.add(shapes.box((0.14, 0.14, 1.0), (x, y, FLOOR + 2.1)), 0, smooth=False)
    builder.add(shapes.beam((WIDTH + 0.1, 2.6, 0.16), (0.0, -2.7, FLOOR + 2.66), 0.06), 1, smooth=False)
    builder.add(shapes.box((WIDTH - 0.5, 0.25, 0.45), (0.0, 0.5 * LENGTH, FLOOR)), 1, smooth=False)
    _add_wheels(builder, 2)
    return builder.build(
        "Engine",
        [
            materials.principled("Engine Green", haze, color=(0.025, 0.11, 0.055), roughness=0.3),
            materials.principled("Engine Red", haze, color=(0.55, 0.04, 0.03), roughness=0.4),
            *_dark(haze),
        ],
    )


def _dark(haze):
    """Return the materials of undercarriages and of windows."""
    return (
        materials.principled("Undercarriage", haze, color=(0.03, 0.03, 0.032), roughness=0.55),
        materials.principled("Window", haze, color=(0.05, 0.09, 0.12), roughness=0.1),
    )
