"""Systems that make points, for the tests of the wiring: sparks that fly up from a target, and the trails behind them.

Spark i is born at i / rate seconds, and lives for `lifetime`. Its trail are the places where it was within the last TRAIL seconds.
"""

import dataclasses

import bpy
import numpy as np

import support

core = support.addon("core.declare")
settings = support.addon("core.settings")
TRAIL, TRAIL_POINTS = 0.3, 4

NO_RATE = core.Problem("The sparks have no rate")


class MOTUS_PG_sparks(settings.SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(default=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    target: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    rate: bpy.props.FloatProperty(default=100.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    lifetime: bpy.props.FloatProperty(default=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})


def alive(seconds, rate, lifetime):
    """Numbers of the sparks that there are, and their ages."""
    numbers = np.arange(max(0.0, np.ceil((seconds - lifetime) * rate)), np.floor(seconds * rate) + 1)
    return numbers, seconds - numbers / rate


def fly(numbers, ages, origin):
    """Positions and velocities of sparks, float32 (n, 3)."""
    ways = np.stack((np.cos(numbers), np.sin(numbers), np.full(len(numbers), 2.0)), axis=1)
    speeds = ways - np.outer(9.81 * ages, (0.0, 0.0, 1.0))
    positions = origin + ways * ages[:, None] - np.outer(0.5 * 9.81 * ages**2, (0.0, 0.0, 1.0))
    return positions.astype(np.float32), speeds.astype(np.float32)


def solve_sparks(context, target, rate, lifetime):
    if rate <= 0.0:
        return NO_RATE
    numbers, ages = alive(context.frame / context.fps, rate, lifetime)
    points = context.points(len(numbers))
    count = len(points["position"])
    numbers, ages = numbers[:count], ages[:count]
    points["position"][:], points["velocity"][:] = fly(numbers, ages, np.array(target.translation) if target else np.zeros(3))
    points["age"][:] = ages
    points["radius"][:] = 0.01 + 0.01 * ages
    points["color"][:] = np.stack((ages, 1.0 - ages, numbers % 7, np.ones(count)), axis=1)
    points["turn"][:] = np.stack((np.cos(ages), np.sin(ages), 0.0 * ages, 0.0 * ages), axis=1)
    points["id"][:] = numbers
    return core.OK


def solve_trails(context, target, rate, lifetime):
    if rate <= 0.0:
        return NO_RATE
    numbers, ages = alive(context.frame / context.fps, rate, lifetime)
    numbers = np.repeat(numbers, TRAIL_POINTS)
    ages = np.maximum(0.0, np.subtract.outer(ages, np.linspace(0.0, TRAIL, TRAIL_POINTS)).ravel())
    points = context.points(len(numbers))
    points["position"][:], _ = fly(numbers, ages, np.array(target.translation) if target else np.zeros(3))
    points["curve"][:] = numbers
    points["radius"][:] = 0.01 + 0.01 * ages
    points["color"][:] = np.stack((ages, 1.0 - ages, numbers % 7, np.ones(len(ages))), axis=1)
    return core.OK


SPARKS = core.System(
    name="sparks",
    label="Sparks",
    settings=MOTUS_PG_sparks,
    classes=(MOTUS_PG_sparks,),
    inputs=(core.Matrix("target", of="target"), core.Setting("rate"), core.Setting("lifetime")),
    solve=solve_sparks,
    problems=(NO_RATE,),
    makes_points=core.Points(
        attributes=(
            ("velocity", 'VECTOR'),
            ("age", 'FLOAT'),
            ("radius", 'FLOAT'),
            ("color", 'COLOR'),
            ("turn", 'QUATERNION'),
            ("id", 'INT'),
        ),
        capacity=1 << 20,
    ),
    unbakeable="Sparks have nothing to bake",
)
TRAILS = dataclasses.replace(
    SPARKS,
    name="trails",
    label="Trails",
    classes=(),
    solve=solve_trails,
    makes_points=core.Points(attributes=(("curve", 'INT'), ("radius", 'FLOAT'), ("color", 'COLOR')), shape='TUBES', space='LOCAL'),
)
LINES = dataclasses.replace(TRAILS, name="lines", label="Lines", makes_points=dataclasses.replace(TRAILS.makes_points, shape='CURVES'))


def make(system, owner, **values):
    """Attach one of the systems to an owner; returns its settings."""
    group = getattr(owner.motus, system.name)
    for name, value in values.items():
        setattr(group, name, value)
    support.addon("core.wiring").attach(system, owner)
    return group
