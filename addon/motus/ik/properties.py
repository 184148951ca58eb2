"""Settings of inverse kinematics: the property group Object.motus.ik, with a list of entries, one for each chain of a rig."""

import math
from functools import partial

import bpy

from ..core.file.pointers import to_object
from ..core.interface import bone_entries
from ..core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import factor, number
from . import chains
from .checking import results as check_results

LONGEST_CHAIN = 255

BENDS = (
    ('TOWARDS', "Towards", "The middle of the chain bends towards the pole"),
    ('AWAY', "Away", "The middle of the chain bends away from the pole"),
)


def _change_stretch(item, context):
    # A chain that cannot stretch needs fewer drivers, so a change from 0 or to 0 wires the rig again.
    if isinstance(item, bpy.types.PropertyGroup) and item.is_elastic != (item.stretch > 0.0):
        item.is_elastic = item.stretch > 0.0
        rewire(item, context)
    touch(item, context)


# Options of settings that are read when the rig is wired, not at every frame.
_WIRED = {"update": rewire, "options": set()}


_number = partial(number, options=ANIMATED)
_factor = partial(factor, options=ANIMATED)


def _angle(name, description, **options):
    return _number(name, description, 0.0, soft_min=-math.pi, soft_max=math.pi, subtype='ANGLE', **options)


def _object(name, description):
    return to_object(name=name, description=description, update=rewire, override=OVERRIDABLE)


def _bone(description):
    return bpy.props.StringProperty(name="Bone", description=description, update=rewire, options=set(), override=OVERRIDABLE)


class IkKeywords:
    """Mixin with the properties that entries and the operator motus.ik_add share; scripts give them by these names as keywords."""

    chain_length: bpy.props.IntProperty(
        name="Chain Length",
        description="Bones in the chain, counted upwards; 0 takes all of them up to the root",
        default=2,
        min=0,
        max=LONGEST_CHAIN,
        update=rewire,
        options=ANIMATED,
        override=OVERRIDABLE,
    )
    use_tail: bpy.props.BoolProperty(
        name="Use Tail",
        description="The bone's tail goes to the target; off, its head does, and the chain ends with the bone above it",
        default=True,
        update=rewire,
        options=set(),
        override=OVERRIDABLE,
    )
    bend: bpy.props.EnumProperty(
        name="Bend",
        description="Which side of the line from root to target the chain bends to",
        items=BENDS,
        default='TOWARDS',
        override=OVERRIDABLE,
        update=touch,
        options=ANIMATED,
    )
    pole_angle: _angle("Pole Angle", "Turns the chain about the line from its root to the target")
    hinge_angle: _angle(
        "Bend Axis",
        "Which way a chain bends whose animated pose is straight: 0 about the X axis of its first bone, 90 degrees about the Z axis",
    )
    softness: _factor(
        "Softness",
        "Share of the chain's length over which it slows down before it is straight, so that the joint does "
        "not snap; 0 follows the target to the last",
        0.0,
    )
    stretch: _factor(
        "Stretch",
        "How far bones lengthen towards a target that is out of reach: 0 keeps their lengths, 1 reaches the target",
        0.0,
        update=_change_stretch,
    )
    volume: _factor("Keep Volume", "How far bones that lengthen get thinner by that, so that they keep their volume", 0.0)
    use_limits: bpy.props.BoolProperty(
        name="Use Limits",
        description="Keep the limits that the bones have for inverse kinematics",
        default=False,
        override=OVERRIDABLE,
        update=touch,
        options=ANIMATED,
    )
    position_weight: _factor("Position", "Blend from the animated pose (0) to the one that reaches the target (1)", 1.0)
    rotation_weight: _factor("Rotation", "How far the last bone takes the target's orientation; the rest of the chain still reaches", 0.0)
    rotation_offset: bpy.props.FloatVectorProperty(
        name="Offset",
        description="Turns the last bone away from the target's orientation, in the target's own space",
        size=3,
        subtype='EULER',
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )
    target_blend: _number(
        "Blend",
        "Which target the chain goes to: 0 is its target, 1 the first of the further targets, 2 the second; numbers between are on the "
        "way from one to the next",
        0.0,
        min=0.0,
        soft_max=4.0,
    )
    tolerance: _number(
        "Tolerance",
        "Distance from the target that counts as reached, as a fraction of the chain's length",
        1e-6,
        min=1e-12,
        max=1.0,
        soft_min=1e-7,
        soft_max=0.01,
        precision=7,
        **_WIRED,
    )
    iterations: bpy.props.IntProperty(
        name="Iterations",
        description="Number of iterations after which the search for a chain of more than two bones stops",
        default=100,
        min=1,
        max=10000,
        soft_max=500,
        override=OVERRIDABLE,
        **_WIRED,
    )
    is_muted: bpy.props.BoolProperty(
        name="Mute",
        description="Switch the chain off: it keeps its own animation",
        default=False,
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )


KEYWORDS = tuple(IkKeywords.__annotations__)


class MOTUS_PG_ik_target(bpy.types.PropertyGroup):
    object: _object("Object", "Object that the chain can go to as well")
    bone: _bone("Bone of the object; empty takes its origin")


class MOTUS_PG_ik_entry(IkKeywords, check_results.CheckResults, bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(name="Bone", description="Bone at the end of the chain", update=rewire, override=OVERRIDABLE)
    target: _object("Target", "Object that the end of the chain goes to")
    target_bone: _bone("Bone of the target; empty takes its origin")
    extra_targets: bpy.props.CollectionProperty(type=MOTUS_PG_ik_target, name="Further Targets", override=EXTENDABLE)
    active_extra_target: bpy.props.IntProperty(name="Active Further Target", options=set())
    pole: _object(
        "Pole", "Object that the middle of the chain bends towards; without a pole the chain bends in the plane of the animated pose"
    )
    pole_bone: _bone("Bone of the pole; empty takes its origin")
    floor: _object("Floor", "Object below whose plane the end of the chain does not go: through its origin, along its X and Y axes")
    floor_height: _number(
        "Height", "Distance above the floor at which the end of the chain stops", 0.0, subtype='DISTANCE', soft_min=-1.0, soft_max=1.0
    )
    floor_margin: _number(
        "Margin", "Distance over which the end of the chain slows down before it stops", 0.0, subtype='DISTANCE', min=0.0, soft_max=1.0
    )
    is_elastic: bpy.props.BoolProperty(name="Elastic", description="Stretch is not 0", options={'HIDDEN'}, override=OVERRIDABLE)


class MOTUS_PG_ik(SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(
        name="Influence",
        description="How much all chains of the rig act; 0 leaves the rig to its animation",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        options=ANIMATED,
        override=OVERRIDABLE,
        update=touch,
    )
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_ik_entry, name="Chains", override=EXTENDABLE)
    chosen_entry: bpy.props.IntProperty(name="Chosen Chain", options={'HIDDEN'})
    active_entry: bone_entries.active_property("Active Chain", lambda settings, bone: chains.entry_with(settings.id_data, bone))


classes = (MOTUS_PG_ik_target, MOTUS_PG_ik_entry, MOTUS_PG_ik)
