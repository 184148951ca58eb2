"""Properties of the operator motus.driver_add: the driver function and its arguments."""

import bpy

from ..core.interface.rows import Row, Rows, is_not, is_one_of
from . import expressions, places

WHICH = (
    ('THETA1', "Upper Angle", "Angle of the upper rod"),
    ('THETA2', "Lower Angle", "Angle of the lower rod, from hanging down too"),
    ('OMEGA1', "Upper Velocity", "Angular velocity of the upper rod"),
    ('OMEGA2', "Lower Velocity", "Angular velocity of the lower rod"),
)


class DriverKeywords:
    """Mixin of operators, with the properties that choose a driver function and give its arguments."""

    function: bpy.props.EnumProperty(
        name="Motion",
        description="Motion that the property is given",
        items=[(one.identifier, one.label, one.description) for one in expressions.FUNCTIONS],
        default='PENDULUM',
    )
    base: bpy.props.FloatProperty(
        name="Base", description="Value that the motion is added to; by default the property's own value", options={'SKIP_SAVE'}
    )
    amplitude: bpy.props.FloatProperty(name="Amplitude", description="Factor that the motion is multiplied by", default=1.0)
    start: bpy.props.FloatProperty(name="Start", description="Frame at which the motion begins", subtype='TIME')
    theta: bpy.props.FloatProperty(name="Angle", description="Angle at the start, from hanging down", subtype='ANGLE', default=0.5)
    omega: bpy.props.FloatProperty(name="Push", description="Angular velocity at the start, per second", subtype='ANGLE')
    length: bpy.props.FloatProperty(
        name="Length",
        description="Length of the rod: a long pendulum swings slowly",
        subtype='DISTANCE',
        default=1.0,
        min=0.0,
        soft_min=0.01,
    )
    which: bpy.props.EnumProperty(name="Value", description="Value of the double pendulum that the property is given", items=WHICH)
    theta1: bpy.props.FloatProperty(
        name="Upper Angle", description="Angle of the upper rod at the start, from hanging down", subtype='ANGLE', default=2.0
    )
    theta2: bpy.props.FloatProperty(
        name="Lower Angle", description="Angle of the lower rod at the start, from hanging down", subtype='ANGLE', default=2.0
    )
    omega1: bpy.props.FloatProperty(
        name="Upper Push", description="Angular velocity of the upper rod at the start, per second", subtype='ANGLE'
    )
    omega2: bpy.props.FloatProperty(
        name="Lower Push", description="Angular velocity of the lower rod at the start, per second", subtype='ANGLE'
    )
    mass1: bpy.props.FloatProperty(name="Upper Mass", description="Mass of the upper bob", unit='MASS', default=1.0, min=0.0, soft_min=0.01)
    mass2: bpy.props.FloatProperty(name="Lower Mass", description="Mass of the lower bob", unit='MASS', default=1.0, min=0.0, soft_min=0.01)
    length1: bpy.props.FloatProperty(
        name="Upper Length", description="Length of the upper rod", subtype='DISTANCE', default=1.0, min=0.0, soft_min=0.01
    )
    length2: bpy.props.FloatProperty(
        name="Lower Length", description="Length of the lower rod", subtype='DISTANCE', default=1.0, min=0.0, soft_min=0.01
    )
    gravity: bpy.props.FloatProperty(
        name="Gravity", description="Gravity that pulls the bobs down", unit='ACCELERATION', default=9.81, min=0.0
    )
    damping: bpy.props.FloatProperty(
        name="Damping",
        description="How quickly swinging dies out, per second: small swings fall to a third in 2.2 seconds at 1, in 22 "
        "at 0.1; 0 swings for ever",
        default=0.0,
        min=0.0,
        soft_max=5.0,
    )
    speed: bpy.props.FloatProperty(
        name="Speed",
        description="Speed of time; for noise the approximate number of ups and downs per second",
        default=1.0,
        soft_min=0.0,
        soft_max=10.0,
    )
    frame_start: bpy.props.FloatProperty(name="Start", description="Frame at which the motion has the value 0", default=1.0)
    frame_end: bpy.props.FloatProperty(name="End", description="Frame at which the motion has the value 1", default=50.0)
    ease_in: bpy.props.FloatProperty(
        name="Ease In", description="Fraction of the time in which the motion speeds up", subtype='FACTOR', default=0.3, min=0.0, max=1.0
    )
    ease_out: bpy.props.FloatProperty(
        name="Ease Out", description="Fraction of the time in which the motion slows down", subtype='FACTOR', default=0.3, min=0.0, max=1.0
    )
    source: bpy.props.StringProperty(
        name="Source",
        description="Data path of the property of the same datablock whose keys are followed; empty takes the driven property's own keys",
    )
    source_index: bpy.props.IntProperty(
        name="Source Index", description="Component of the source, if the source is an array", default=0, min=0
    )
    frequency: bpy.props.FloatProperty(
        name="Frequency",
        description="Frequency: swings, waves or steps per second",
        default=1.0,
        min=0.0,
        soft_min=0.1,
        soft_max=10.0,
    )
    phase: bpy.props.FloatProperty(
        name="Phase", description="Fraction of a wave by which the motion is ahead", default=0.0, soft_min=0.0, soft_max=1.0
    )
    share: bpy.props.FloatProperty(
        name="Share", description="Fraction of a wave in which the value is the higher one", subtype='FACTOR', default=0.5, min=0.0, max=1.0
    )
    blend: bpy.props.FloatProperty(
        name="Blend",
        description="Fraction of a step in which the value goes over smoothly from the step before; 0 jumps",
        subtype='FACTOR',
        default=0.0,
        min=0.0,
        max=1.0,
    )
    loop: bpy.props.IntProperty(
        name="Loop", description="Frames after which the noise repeats without a seam; 0 never repeats", default=0, min=0
    )
    damping_ratio: bpy.props.FloatProperty(
        name="Damping Ratio", description="Damping: 0 swings for ever, 1 comes to rest without a swing", default=0.5, min=0.0, soft_max=2.0
    )
    response: bpy.props.FloatProperty(
        name="Response",
        description="Initial response: 0 starts slowly, 1 at once, above 1 overshoots, below 0 goes the other way first",
        default=0.0,
        soft_min=-2.0,
        soft_max=3.0,
    )
    seed: bpy.props.IntProperty(
        name="Seed", description="Seed of the random values: each number gives a different motion", default=0, min=0
    )


NAMES = tuple(DriverKeywords.__annotations__)

_ORDER = (
    "which",
    "theta",
    "theta1",
    "theta2",
    "length",
    "length1",
    "length2",
    "omega",
    "omega1",
    "omega2",
    "mass1",
    "mass2",
    "gravity",
    "damping",
    "frame_start",
    "frame_end",
    "ease_in",
    "ease_out",
    "speed",
    "frequency",
    "phase",
    "share",
    "blend",
    "seed",
    "loop",
    "damping_ratio",
    "response",
)


def _row(name):
    return Row(name, when=is_one_of("function", *(one.identifier for one in expressions.FUNCTIONS if name in one.arguments)))


def _follows(operator):
    return expressions.BY_IDENTIFIER[operator.function].follows


REDO = (
    Rows((Row("channel", when=is_not("channel", places.BY_PATH)), "function", *map(_row, _ORDER))),
    Rows(
        (
            Row("start", when=is_one_of("function", *(one.identifier for one in expressions.FUNCTIONS if one.has_start))),
            Row("base", when=lambda operator: operator.is_given("base") and not _follows(operator)),
            Row("amplitude", when=lambda operator: not _follows(operator)),
        )
    ),
)
"""Rows of properties in the operator's dialog and in its Adjust Last Operation panel."""


def given(operator):
    """Return {name: value} of the operator's keywords that choose a driver function and give its arguments."""
    return {name: getattr(operator, name) for name in NAMES}
