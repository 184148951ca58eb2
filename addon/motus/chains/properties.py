"""Settings of chains in Object.motus.chains, with an entry for each chain of bones."""

import math
from functools import partial

import bpy

from ..core.file.pointers import pointed, to_object
from ..core.interface import bone_entries
from ..core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, drawn_curves, rewire, touch
from ..core.settings.declared import factor, number, switch, vector
from . import air, along

# The motion at a frame depends on the whole past, so a setting that changed over time would have to be known at all times.
_number = partial(number, tells_no_keys=True)


def _change_squash(item, context):
    # Bones that are not scaled need fewer drivers, so a change from 0 or to 0 wires the rig again.
    if isinstance(item, bpy.types.PropertyGroup) and item.is_scaled != (item.squash > 0.0):
        item.is_scaled = item.squash > 0.0
        rewire(item, context)
    touch(item, context)


_use_curve, _curve = drawn_curves.keywords(
    "Shape by Curve",
    "Draw a curve that says how much of the tip's values is reached along the chain, from its root at the left to its tip, in place of Tip Shape",
    along.show,
)


class ChainsKeywords:
    """Mixin with the properties that an entry and the operator that adds chains share. Scripts use the names as keywords."""

    frequency: _number(
        "Frequency",
        "Swings per second around the animated pose; 0 for a limp chain",
        1.5,
        min=0.0,
        max=60.0,
        soft_max=10.0,
        precision=3,
        step=5,
    )
    tip_frequency: _number(
        "Tip Frequency", "Frequency of the last bone, as a part of that of the first one", 1.0, min=0.0, max=10.0, soft_max=2.0, step=5
    )
    damping: _number(
        "Damping",
        "How soon swinging dies out: 0 swings for ever, 1 comes to rest soonest without swinging, above 1 it creeps to rest",
        0.3,
        min=0.0,
        max=100.0,
        soft_max=2.0,
        precision=3,
        step=2,
    )
    response: _number(
        "Response",
        "How the motion sets off: 0 starts slowly, 1 at once, above 1 it overshoots, below 0 it winds up to the other side first",
        0.0,
        min=-100.0,
        max=100.0,
        soft_min=-3.0,
        soft_max=3.0,
        precision=3,
        step=5,
    )
    gravity: _number("Gravity", "How much of the scene's gravity pulls the chain", 1.0, min=0.0, max=2.0, subtype='FACTOR')
    tip_shape: _number(
        "Tip Shape",
        "Where along the chain it goes over to Tip Frequency, Tip Mass and Tip Thickness: evenly at 1, near its root below 1, near its "
        "tip above 1",
        1.0,
        min=0.1,
        max=10.0,
        soft_max=4.0,
        step=5,
    )
    use_curve: _use_curve
    curve: _curve
    drag: _number(
        "Air Drag",
        "How quickly the chain takes on the air's velocity, per second: at 0 it feels neither wind nor still air, "
        "at 10 it drifts almost with the air",
        0.5,
        min=0.0,
        max=1000.0,
        soft_max=10.0,
        step=5,
    )
    tip_mass: _number(
        "Tip Mass", "Mass of the last bone, as a part of that of the first one", 1.0, min=0.01, max=100.0, soft_max=10.0, step=5
    )
    stretch: _number(
        "Stretch",
        "Part of its length by which a bone's own weight would lengthen it; without Squash bones keep their lengths, and point to where longer "
        "ones would end",
        0.0,
        min=0.0,
        max=100.0,
        soft_max=1.0,
        subtype='FACTOR',
        precision=3,
    )
    squash: _number(
        "Squash",
        "How much bones show that Stretch lengthens and shortens them: they are scaled along their length, up to five times, and across, so that "
        "they keep their volume. Bones whose children inherit their scale keep their lengths",
        0.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        update=_change_squash,
    )
    bend_limit: _number(
        "Bend Limit",
        "Largest angle to where a bone would be if it followed its parent; 180 degrees for no limit",
        math.pi,
        min=0.0,
        max=math.pi,
        subtype='ANGLE',
    )
    side_limit: _number(
        "Side Limit",
        "Largest angle sideways, along a bone's X axis, if that is less than the Bend Limit: such as for an ear, a strip or a finger",
        math.pi,
        min=0.0,
        max=math.pi,
        subtype='ANGLE',
    )
    thickness: _number(
        "Thickness", "Radius of the chain where it touches colliders and other chains", 0.0, min=0.0, max=1e5, soft_max=1.0, unit='LENGTH'
    )
    tip_thickness: _number(
        "Tip Thickness", "Thickness of the last bone, as a part of that of the first one", 1.0, min=0.0, max=10.0, soft_max=2.0, step=5
    )
    hold_end: switch("Hold End", "Keep the end of the chain where the animation has it, as its beginning", tells_no_keys=True)
    weight: factor("Weight", "Blend from the animation (0) to the hanging chain (1)", 1.0, options=ANIMATED)


KEYWORDS = tuple(name for name in ChainsKeywords.__annotations__ if name not in ("weight", "hold_end"))
"""Settings of an entry that presets and To All Selected copy."""
NUMBERS = (*(name for name in KEYWORDS if name != "curve"), "weight")
"""Settings of an entry that are numbers."""


class MOTUS_PG_chains_link(bpy.types.PropertyGroup):
    object: to_object(name="Object", description="Object of a row, which hangs on the one before it", update=rewire, override=OVERRIDABLE)


class MOTUS_PG_chains_entry(ChainsKeywords, drawn_curves.DrawnCurve, bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(
        name="Bone",
        description="Topmost bone of the chain, which has the bones below it, down to where another chain or system begins",
        update=rewire,
        override=OVERRIDABLE,
    )
    links: bpy.props.CollectionProperty(type=MOTUS_PG_chains_link, name="Objects", override=EXTENDABLE)
    spline: bpy.props.IntProperty(
        name="Spline",
        description="Index of the spline of a curve whose points hang; -1 for bones and objects",
        default=-1,
        min=-1,
        options={'HIDDEN'},
    )
    is_muted: switch("Mute", "Switch this chain off", options=ANIMATED)
    is_scaled: bpy.props.BoolProperty(name="Scaled", description="Squash is not 0", options={'HIDDEN'}, override=OVERRIDABLE)


def is_bone(entry):
    """Whether the chain of an entry is one of bones, not of objects in a row or of a spline's points."""
    return not entry.links and entry.spline < 0


def index_of(settings, name):
    """Return the index of the entry whose chain has the bone of this name, or which has this name itself; -1 if there is none."""
    rig = settings.id_data
    if rig.pose is None or name not in rig.pose.bones:
        return settings.entries.find(name)
    upwards = (name, *(one.name for one in rig.data.bones[name].parent_recursive))
    return next((index for index in map(settings.entries.find, upwards) if index >= 0 and is_bone(settings.entries[index])), -1)


def index_with(settings, obj):
    """Return the index of the entry whose row has an object; -1 if there is none."""
    found = (place for place, entry in enumerate(settings.entries) if any(pointed(link, "object") == obj for link in entry.links))
    return next(found, -1)


class MOTUS_PG_chains_pin(bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(name="Bone", description="Bone of a chain whose tail is held", update=rewire, override=OVERRIDABLE)
    target: to_object(name="Target", description="Object that holds the bone's tail, at its origin", update=rewire, override=OVERRIDABLE)
    target_bone: bpy.props.StringProperty(
        name="Target Bone",
        description="Bone of the target whose head holds; empty takes the target's origin",
        update=rewire,
        options=set(),
        override=OVERRIDABLE,
    )
    weight: factor(
        "Weight",
        "1 holds the bone fast, 0 not at all; between them a spring draws it to the target, softly where the weight is small",
        1.0,
        options=ANIMATED,
    )
    is_muted: switch("Mute", "Switch this pin off", tells_no_keys=True)


class MOTUS_PG_chains(SystemSettings, bpy.types.PropertyGroup):
    influence: factor("Influence", "How much all chains of the object act; 0 leaves all to its animation", 1.0, options=ANIMATED)
    wind: vector("Wind", "Velocity of the air, which chains with Air Drag feel", options=ANIMATED, subtype='VELOCITY', unit='VELOCITY')
    gusts: _number("Gusts", "How much the wind rises and falls: 1 lets it fall to a calm at times", 0.0, min=0.0, max=2.0, subtype='FACTOR')
    gust_frequency: _number(
        "Gust Frequency", "Approximate number of gusts per second", 0.3, min=0.001, max=1000.0, soft_max=5.0, precision=3, step=5
    )
    wind_from: to_object(
        name="Wind From",
        description="Emitter of snow whose wind, with its gusts, the chains feel beside their own",
        also=lambda _settings, obj: air.blows(obj),
        update=rewire,
        override=OVERRIDABLE,
    )
    inherit: _number(
        "Inherit Motion",
        "How much of the motion of the object itself the chains feel: at 0 they come along as if it stood still, such as in a car",
        1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
    )
    settle: _number(
        "Settle",
        "Time, at most, in which chains come to rest in their first pose before the scene begins",
        2.0,
        min=0.0,
        max=1000.0,
        soft_max=10.0,
        unit='TIME_ABSOLUTE',
    )
    use_loop: switch("Loop", "Let the motion close without a seam over the scene's frames, where the animation does", tells_no_keys=True)
    use_cuts: switch("Reset at Cuts", "Start anew at rest at each marker of the scene whose name begins with \"cut\"", tells_no_keys=True)
    colliders: bpy.props.PointerProperty(
        type=bpy.types.Collection,
        name="Colliders",
        description="Collection with what chains do not enter. An empty displayed as a sphere is a ball, or a capsule if it is scaled "
        "unevenly; each other empty is a plane that is solid below its X and Y axes. Deforming bones of armatures are capsules as thick as "
        "their envelopes. Meshes that keep their shape are surfaces",
        update=rewire,
        override=OVERRIDABLE,
    )
    use_touch: switch(
        "Touch Each Other",
        "Keep the chains of this object apart by the thickness of both, as far as they are apart on the scene's first frame",
        tells_no_keys=True,
    )
    friction: _number(
        "Friction",
        "How much colliders, and chains that touch, hold back what slides along them",
        0.5,
        min=0.0,
        max=100.0,
        soft_max=2.0,
        step=5,
    )
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_chains_entry, name="Chains", override=EXTENDABLE)
    chosen_entry: bpy.props.IntProperty(name="Chosen Entry", options={'HIDDEN'})
    active_entry: bone_entries.active_property("Active Entry", index_of)
    pins: bpy.props.CollectionProperty(type=MOTUS_PG_chains_pin, name="Pins", override=EXTENDABLE)
    active_pin: bpy.props.IntProperty(name="Active Pin", options=set(), override=OVERRIDABLE)


classes = (MOTUS_PG_chains_link, MOTUS_PG_chains_entry, MOTUS_PG_chains_pin, MOTUS_PG_chains)
