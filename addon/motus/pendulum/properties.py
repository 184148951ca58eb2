"""Settings of pendulums in Object.motus.pendulum of the pivot, and of trails in Object.motus.pendulum_trail of the trail object."""

import math
from functools import partial

import bpy

from ..core.file.pointers import to_object
from ..core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import number, switch
from . import parts

KINDS = (
    ('SINGLE', "Single", "One rod with a bob"),
    ('DOUBLE', "Double", "A second rod hangs on the first one's bob"),
    ('SPHERICAL', "Spherical", "One rod with a bob that swings to all sides"),
)


def _fit(settings, context):
    if isinstance(settings, SystemSettings):
        parts.fit(settings.id_data)
    touch(settings, context)


_number = partial(number, tells_no_keys=True)
_switch = partial(switch, tells_no_keys=True)


class PendulumKeywords:
    """Mixin with the properties that a pendulum and the operator that adds one share. Scripts use the names as keywords.

    Most of these properties cannot have keys: the whole motion follows from them, so it would be a different motion on every frame.
    """

    length1: _number(
        "Upper Length",
        "Length of the upper rod, before the pivot's scale",
        1.0,
        soft_min=0.1,
        soft_max=10.0,
        subtype='DISTANCE',
        update=_fit,
    )
    length2: _number(
        "Lower Length",
        "Length of the lower rod, before the pivot's scale",
        1.0,
        soft_min=0.1,
        soft_max=10.0,
        subtype='DISTANCE',
        update=_fit,
    )
    mass1: _number(
        "Upper Mass",
        "Mass of the upper bob: only how many times that of the lower bob it is makes a difference",
        1.0,
        soft_min=0.1,
        soft_max=10.0,
        unit='MASS',
    )
    mass2: _number("Lower Mass", "Mass of the lower bob", 1.0, soft_min=0.1, soft_max=10.0, unit='MASS')
    angle1: _number(
        "Upper Angle",
        "Angle of the upper rod when the motion starts, from hanging down",
        math.radians(120.0),
        soft_min=-math.pi,
        soft_max=math.pi,
        subtype='ANGLE',
    )
    angle2: _number(
        "Lower Angle",
        "Angle of the lower rod when the motion starts, from hanging down",
        math.radians(90.0),
        soft_min=-math.pi,
        soft_max=math.pi,
        subtype='ANGLE',
    )
    heading: _number(
        "Heading",
        "Direction in which a spherical pendulum is drawn out when the motion starts, about the pivot's Z axis from X",
        0.0,
        soft_min=-math.pi,
        soft_max=math.pi,
        subtype='ANGLE',
    )
    angle_step: _number(
        "Angle Step",
        "Difference of the lower angle from one pendulum of the fan to the next",
        math.radians(0.5),
        soft_min=-0.1,
        soft_max=0.1,
        step=5,
        subtype='ANGLE',
    )
    velocity1: _number(
        "Upper Velocity",
        "Angular velocity of the upper rod when the motion starts, per second",
        0.0,
        soft_min=-20.0,
        soft_max=20.0,
        subtype='ANGLE',
    )
    velocity2: _number(
        "Lower Velocity",
        "Angular velocity of the lower rod when the motion starts, per second",
        0.0,
        soft_min=-20.0,
        soft_max=20.0,
        subtype='ANGLE',
    )
    velocity_sideways: _number(
        "Sideways Velocity",
        "Angular velocity of a spherical pendulum across its heading when the motion starts, per second",
        0.0,
        soft_min=-20.0,
        soft_max=20.0,
        subtype='ANGLE',
    )
    use_scene_gravity: _switch("Scene Gravity", "Take the strength of the scene's gravity", True)
    gravity: _number("Gravity", "Acceleration by gravity along the pivot's -Z axis", 9.81, soft_min=0.0, soft_max=30.0, unit='ACCELERATION')
    damping: _number(
        "Damping",
        "How quickly swinging dies out, per second: small swings fall to a third in 2.2 seconds at 1, in 22 at 0.1; 0 swings for ever",
        0.0,
        soft_min=0.0,
        soft_max=2.0,
    )
    use_limits: _switch("Limits", "Keep velocities and accelerations below limits that no real pendulum has", False)
    most_velocity: _number("Velocity Limit", "Largest angular velocity, per second", 10.0, soft_min=0.1, soft_max=50.0, subtype='ANGLE')
    most_acceleration: _number(
        "Acceleration Limit", "Largest change of the angular velocity, per second", 100.0, soft_min=1.0, soft_max=1000.0, subtype='ANGLE'
    )
    use_pivot_motion: _switch(
        "Driven Pivot", "Let the pivot's own motion swing the pendulum, rather than carry it along alone", False, update=rewire
    )
    start_frame: _number("Start", "Frame at which the motion starts; before it the pendulum waits", 1.0, step=100)
    speed: _number(
        "Speed",
        "Speed of the pendulum's time; it may be keyed, and a negative speed runs backwards",
        1.0,
        ANIMATED,
        soft_min=0.0,
        soft_max=4.0,
    )
    is_playing: _switch("Playing", "Whether the pendulum's time runs; keyed off it stands still", True, ANIMATED)
    influence: _number(
        "Influence",
        "How much the pendulum turns its rods; 0 lets them hang as they are placed",
        1.0,
        ANIMATED,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
    )


KEYWORDS = tuple(PendulumKeywords.__annotations__)


PLOTS = (
    ('ANGLE', "Angle", "Angles of the rods over time"),
    ('ENERGY', "Energy", "Energy over time, and its kinetic and potential part"),
    ('PHASE', "Phase", "Phase portrait, angular velocity over angle: a swing goes round, a turn goes through"),
)


class MOTUS_PG_pendulum_rod(bpy.types.PropertyGroup):
    object: to_object(name="Object", description="Rod that the pendulum turns", update=rewire, override=OVERRIDABLE, options={'HIDDEN'})
    bob: to_object(name="Bob", description="What hangs at the end of the rod", override=OVERRIDABLE, options={'HIDDEN'})
    is_placed: bpy.props.BoolProperty(
        name="Placed", description="The bob was there before, and is given back", options={'HIDDEN'}, override=OVERRIDABLE
    )
    number: bpy.props.IntProperty(
        name="Number", description="Index of the rod in its pendulum and fan", min=0, options={'HIDDEN'}, override=OVERRIDABLE
    )
    rest: bpy.props.FloatVectorProperty(
        name="Rest",
        description="Transform of the bob at the end of its rod",
        size=16,
        options={'HIDDEN'},
        override=OVERRIDABLE,
        default=(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
    )
    before: bpy.props.FloatVectorProperty(
        name="Before", description="What a placed bob's parent inverse was", size=16, options={'HIDDEN'}, override=OVERRIDABLE
    )


class MOTUS_PG_pendulum(SystemSettings, PendulumKeywords, bpy.types.PropertyGroup):
    kind: bpy.props.EnumProperty(
        name="Kind", description="Number of rods of each pendulum", items=KINDS, options=set(), override=OVERRIDABLE
    )
    count: bpy.props.IntProperty(
        name="Count",
        description="How many pendulums swing about the pivot",
        default=1,
        min=1,
        max=parts.LARGEST_FAN,
        options=set(),
        override=OVERRIDABLE,
    )
    plot: bpy.props.EnumProperty(
        name="Plot",
        description="What the panel plots of the motion around the present frame",
        items=PLOTS,
        options=set(),
        override=OVERRIDABLE,
    )
    rods: bpy.props.CollectionProperty(type=MOTUS_PG_pendulum_rod, name="Rods", override=EXTENDABLE)
    trail: to_object(
        'MESH', name="Trail", description="Object that shows the ways of the end bobs", override=OVERRIDABLE, options={'HIDDEN'}
    )
    has_made_pivot: bpy.props.BoolProperty(
        name="Made", description="Motus has made the pivot, and removes it with the pendulum", options={'HIDDEN'}, override=OVERRIDABLE
    )


class TrailKeywords:
    """Mixin with the properties that a trail and the operator that adds trails share."""

    seconds: _number("Length", "How far back the trail goes, in seconds of the pendulum's time", 2.0, ANIMATED, soft_min=0.1, soft_max=20.0)
    fade: _number("Fade", "How much the trail vanishes towards its end", 1.0, ANIMATED, min=0.0, max=1.0, subtype='FACTOR')
    thickness: _number(
        "Thickness", "Radius of the trail, before the pivot's scale", 0.02, ANIMATED, min=0.0, soft_max=0.2, subtype='DISTANCE'
    )


TRAIL_KEYWORDS = tuple(TrailKeywords.__annotations__)


class MOTUS_PG_pendulum_trail(SystemSettings, TrailKeywords, bpy.types.PropertyGroup):
    pivot: to_object(
        name="Pivot", description="Pivot of the pendulum whose way the trail shows", update=rewire, override=OVERRIDABLE, options={'HIDDEN'}
    )
    rod: to_object(
        name="Rod", description="A rod of the pendulum, by which it is found if the pivot is gone", override=OVERRIDABLE, options={'HIDDEN'}
    )
    influence: _number("Influence", "Whether the trail is shown: 0 hides it", 1.0, ANIMATED, min=0.0, max=1.0, subtype='FACTOR')
