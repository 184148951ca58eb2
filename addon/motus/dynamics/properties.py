"""Settings of dynamics in Object.motus.dynamics, with an entry for each bone or property that has dynamics, or the object itself."""

from functools import partial

import bpy

from ..core.interface import bone_entries
from ..core.settings import ANIMATED, EXTENDABLE, NO_KEYS, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import number
from . import filters, styles

FOLLOWS = (
    ('OWN', "Local", "The object's or bone's own location, rotation and scale; the motion of parents does not count"),
    ('WORLD', "World", "The motion in the world, that of parents included; a bone turns to where its tail has come"),
)
CHANNELS = (
    ('LOCATION', "Location", "The location follows"),
    ('ROTATION', "Rotation", "The rotation follows"),
    ('SCALE', "Scale", "The scale follows"),
)
SHAPES = (
    ('FREQUENCY', "Frequency", "Set frequency, damping and response"),
    ('OVERSHOOT', "Overshoot", "Set how far the motion overshoots, and how long it takes to settle"),
    ('SPRING', "Spring", "Set a mass on a spring and a damper"),
)

# The motion at a frame depends on the whole past, so a setting that changed over time would have to be known at all times.
_STILL = {"update": touch, "options": set(), "override": OVERRIDABLE}


_number = partial(number, tells_no_keys=True)


def _seen(name, description, key, **options):
    """Declare a float property that is computed from frequency, damping and response, and sets these when it is set.

    key: name of the number for filters.seen() and filters.put(). options: keywords of FloatProperty.
    """
    return bpy.props.FloatProperty(
        name=name,
        description=description,
        options={'SKIP_SAVE'},
        get=lambda self: filters.seen(self, key),
        set=lambda self, value: filters.put(self, key, value),
        **options,
    )


class DynamicsKeywords:
    """Mixin with the properties that an entry and the operator that adds dynamics share. Scripts use the names as keywords."""

    follow: bpy.props.EnumProperty(
        name="Follow",
        description="Which motion is followed: only that of the object or bone itself, or its motion through the world, along with its "
        "parents",
        items=FOLLOWS,
        default='OWN',
        update=rewire,
        options=set(),
        override=OVERRIDABLE,
    )
    channels: bpy.props.EnumProperty(
        name="Channels",
        description="What follows with lag and swing: location, rotation, scale",
        items=CHANNELS,
        options={'ENUM_FLAG'},
        default={'LOCATION', 'ROTATION'},
        update=rewire,
        override=OVERRIDABLE,
    )
    frequency: _number(
        "Frequency",
        "Swings per second",
        2.0,
        min=filters.LEAST_FREQUENCY,
        max=filters.GREATEST_FREQUENCY,
        soft_max=10.0,
        precision=3,
        step=5,
    )
    damping: _number(
        "Damping",
        "How soon swinging dies out: 0 swings for ever, 1 comes to rest soonest without swinging, above 1 it creeps to rest",
        0.4,
        min=0.0,
        max=filters.GREATEST_DAMPING,
        soft_max=2.0,
        precision=3,
        step=2,
    )
    response: _number(
        "Response",
        "How the motion sets off: 0 starts slowly, 1 at once, above 1 it overshoots, below 0 it winds up to the other side first",
        0.0,
        min=-filters.GREATEST_RESPONSE,
        max=filters.GREATEST_RESPONSE,
        soft_min=-3.0,
        soft_max=3.0,
        precision=3,
        step=5,
    )
    delay: _number(
        "Delay",
        "Time after which the dynamics follow the animation",
        0.0,
        min=0.0,
        max=3600.0,
        soft_max=1.0,
        unit='TIME_ABSOLUTE',
        precision=3,
    )
    weight: bpy.props.FloatProperty(
        name="Weight",
        description="Blend from the animation (0) to the dynamics (1)",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )
    use_loop: bpy.props.BoolProperty(
        name="Loop", description="Let the motion close without a seam over a range of frames" + NO_KEYS, default=False, **_STILL
    )
    loop_start: bpy.props.IntProperty(name="Start", description="First frame of the loop" + NO_KEYS, default=1, **_STILL)
    loop_end: bpy.props.IntProperty(
        name="End", description="Frame on which the loop begins again, which looks like its first one" + NO_KEYS, default=251, **_STILL
    )
    jump: _number(
        "Teleport",
        "Distance within one frame beyond which something was put elsewhere, not moved: the dynamics then start anew at rest; 0 is no "
        "such limit",
        0.0,
        min=0.0,
        unit='LENGTH',
        soft_max=100.0,
    )


KEYWORDS = tuple(DynamicsKeywords.__annotations__)


class MOTUS_PG_dynamics_entry(DynamicsKeywords, bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(
        name="Bone",
        description="Bone that has the dynamics; empty for the object itself, or a property",
        update=rewire,
        override=OVERRIDABLE,
    )
    data_path: bpy.props.StringProperty(
        name="Property",
        description="Data path of the property that has the dynamics; empty for the object itself, or its bone",
        update=rewire,
        override=OVERRIDABLE,
        options={'HIDDEN'},
    )
    index: bpy.props.IntProperty(
        name="Index",
        description="Index of a number in an array property; -1 for all of them",
        default=-1,
        min=-1,
        update=rewire,
        options={'HIDDEN'},
        override=OVERRIDABLE,
    )
    chain: bpy.props.StringProperty(
        name="Chain", description="Topmost bone of the chain that it was added with", options={'HIDDEN'}, override=OVERRIDABLE
    )
    mass: bpy.props.FloatProperty(
        name="Mass",
        description="Mass that hangs on the spring",
        default=1.0,
        min=1e-3,
        soft_max=100.0,
        unit='MASS',
        options=set(),
        override=OVERRIDABLE,
    )
    style: bpy.props.EnumProperty(
        name="Style",
        description="Named set of frequency, damping and response",
        items=styles.ITEMS,
        options={'SKIP_SAVE'},
        get=styles.of,
        set=styles.put,
    )
    shape: bpy.props.EnumProperty(
        name="Set By",
        description="Numbers by which the motion is shown and set; the motion stays the same",
        items=SHAPES,
        default='FREQUENCY',
        options=set(),
        override=OVERRIDABLE,
    )
    overshoot: _seen(
        "Overshoot",
        "How far the motion goes beyond where it has to stop, as a part of the way there",
        "overshoot",
        min=0.0,
        max=0.95,
        subtype='FACTOR',
        precision=3,
    )
    settling: _seen(
        "Settling",
        "Time until the motion stays within 2 % of its way from where it has to stop",
        "settling",
        min=filters.LEAST_SETTLING,
        max=filters.GREATEST_SETTLING,
        soft_max=5.0,
        unit='TIME_ABSOLUTE',
        precision=3,
    )
    stiffness: _seen(
        "Stiffness",
        "Stiffness of the spring, in N/m: a stiffer one swings more quickly",
        "stiffness",
        min=1e-6,
        soft_max=1000.0,
        precision=2,
    )
    resistance: _seen(
        "Resistance",
        "Resistance of the damper, in N·s/m: a larger one ends the swinging sooner",
        "resistance",
        min=0.0,
        soft_max=100.0,
        precision=2,
    )
    is_muted: bpy.props.BoolProperty(
        name="Mute",
        description="Switch the dynamics of this entry off",
        default=False,
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )


class MOTUS_PG_dynamics(SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(
        name="Influence",
        description="How much all dynamics of the object act; 0 leaves the object to its animation",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        options=ANIMATED,
        override=OVERRIDABLE,
        update=touch,
    )
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_dynamics_entry, name="Dynamics", override=EXTENDABLE)
    chosen_entry: bpy.props.IntProperty(name="Chosen Entry", options={'HIDDEN'})
    active_entry: bone_entries.active_property("Active Entry", lambda settings, bone: settings.entries.find(bone))


classes = (MOTUS_PG_dynamics_entry, MOTUS_PG_dynamics)
