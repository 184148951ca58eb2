"""Settings of Look At: the property group Object.motus.look_at, with a list of entries, one for each head of a rig."""

import math
from functools import partial

import bpy

from ..core.file.pointers import to_object
from ..core.interface import bone_entries
from ..core.measures.axes import AXES
from ..core.settings import ANIMATED, EXTENDABLE, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import choice, factor, number, switch, whole
from . import facing

FORWARDS = (
    ('AUTO', "Automatic", "Where the rig faces at rest, by Forward; an eye that points there looks along its bone"),
    *AXES,
)
ANY_BODY_LENGTH = -1
"""Value of the operator's keyword body_length for which the operator finds the number of spine bones."""


_weight = partial(factor, options=ANIMATED)
_axis = partial(choice, update=rewire)


def _limit(name, description, degrees):
    return number(name, description, math.radians(degrees), ANIMATED, min=0.0, max=math.pi, subtype='ANGLE')


def _side(name, description):
    return _limit(name, description, 180.0)


SIDE_LIMITS = tuple(f"{part}_{side}_limit" for part in ("head", "eyes") for side in ("left", "right", "up", "down"))
"""Names of the settings that limit the parts of a turn of head and eyes in each direction."""


class LookAtKeywords:
    """Mixin with the properties that entries and the operator motus.look_at_add share; scripts give them by these names as keywords."""

    weight: _weight("Weight", "How much eyes, head and body turn to the target; 0 leaves the animation as it is", 1.0)
    body_weight: _weight("Body", "Share of the turn that the spine takes, spread over its bones", 0.3)
    head_weight: _weight("Head", "Share of what the body leaves that the head takes", 1.0)
    eyes_weight: _weight("Eyes", "Share of what the head leaves that the eyes take", 0.0)
    clamp: _weight(
        "Clamp", "Limit of the whole turn to a target: 0 lets it go all around, 0.5 up to 90 degrees to each side, 1 not at all", 0.5
    )
    body_limit: _limit("Body Limit", "Largest turn of all spine bones together", 60.0)
    head_limit: _limit("Head Limit", "Largest turn of the head against the spine", 80.0)
    eyes_limit: _limit("Eyes Limit", "Largest turn of the eyes against the head", 35.0)
    head_left_limit: _side("Head Left", "Largest part of the head's turn to its own left; 180 degrees: none but Head Limit")
    head_right_limit: _side("Head Right", "Largest part of the head's turn to its own right; 180 degrees: none but Head Limit")
    head_up_limit: _side("Head Up", "Largest part of the head's turn upwards; 180 degrees: none but Head Limit")
    head_down_limit: _side("Head Down", "Largest part of the head's turn downwards; 180 degrees: none but Head Limit")
    eyes_left_limit: _side("Eyes Left", "Largest part of the eyes' turn to the character's left; 180 degrees: none but Eyes Limit")
    eyes_right_limit: _side("Eyes Right", "Largest part of the eyes' turn to the character's right; 180 degrees: none but Eyes Limit")
    eyes_up_limit: _side("Eyes Up", "Largest part of the eyes' turn upwards; 180 degrees: none but Eyes Limit")
    eyes_down_limit: _side("Eyes Down", "Largest part of the eyes' turn downwards; 180 degrees: none but Eyes Limit")
    use_saccades: switch("Saccades", "Let the eyes jump a little about what they look at, as those of people do", update=rewire)
    saccade_amplitude: number(
        "Amplitude",
        "How far the eyes look past the target, at most, when they jump",
        math.radians(2.0),
        ANIMATED,
        min=0.0,
        max=math.pi,
        soft_max=math.radians(20.0),
        subtype='ANGLE',
    )
    saccade_rate: number(
        "Rate", "Jumps of the eyes a second, on average", 2.0, tells_no_keys=True, min=0.0, max=100.0, soft_max=5.0, update=rewire
    )
    use_blinks: switch("Blinks", "Let the eyelids blink now and then, and along with large turns of the gaze", update=rewire)
    blink_rate: number(
        "Blinks a Minute", "Blinks at random times, on average", 15.0, tells_no_keys=True, min=0.0, max=600.0, soft_max=60.0, update=rewire
    )
    blink_angle: number(
        "Blink at Turns",
        "Turn of the gaze, within a fifth of a second, from which on a blink goes along; 180 degrees: none do",
        math.radians(33.0),
        tells_no_keys=True,
        min=0.0,
        max=math.pi,
        subtype='ANGLE',
        update=rewire,
    )
    eyes_seed: whole(
        "Seed",
        "Number from which the times of jumps and blinks follow: give each character another one",
        0,
        tells_no_keys=True,
        min=0,
        update=rewire,
    )
    forward: _axis("Forward", "Axis of the rig that points where the character faces at rest", AXES, facing.FORWARD)
    up: _axis("Up", "Axis of the rig that points from the feet to the head at rest", AXES, facing.UP)
    head_forward: _axis("Head Forward", "Axis of the head bone that points where the face looks", FORWARDS, 'AUTO')
    eyes_forward: _axis("Eyes Forward", "Axis of the eye bones that points where they look", FORWARDS, 'AUTO')


KEYWORDS = tuple(LookAtKeywords.__annotations__)


class MOTUS_PG_look_at_eye(bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(name="Eye", description="Bone of the eye, below the head", update=rewire, override=OVERRIDABLE)


class MOTUS_PG_look_at_lid(bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(name="Eyelid", description="Bone of the eyelid, below the head", update=rewire, override=OVERRIDABLE)
    angle: number(
        "Angle",
        "Angle about the bone's X axis by which this eyelid shuts the eye",
        math.radians(40.0),
        tells_no_keys=True,
        min=-math.pi,
        max=math.pi,
        subtype='ANGLE',
        update=rewire,
    )


_target_weight = partial(
    number,
    default=1.0,
    options=ANIMATED,
    min=0.0,
    soft_max=1.0,
)


class MOTUS_PG_look_at_target(bpy.types.PropertyGroup):
    object: to_object(name="Object", description="Object to look at as well", update=rewire, override=OVERRIDABLE)
    bone: bpy.props.StringProperty(
        name="Bone", description="Bone of the target to look at; empty takes its origin", update=rewire, override=OVERRIDABLE
    )
    weight: _target_weight(
        "Weight",
        "How much the head looks to this further target, against the weights of the others; the animation takes what all are short of 1",
    )


class MOTUS_PG_look_at_entry(LookAtKeywords, bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(name="Head", description="Bone of the head", update=rewire, override=OVERRIDABLE)
    target: to_object(name="Target", description="Object to look at", update=rewire, override=OVERRIDABLE)
    target_bone: bpy.props.StringProperty(
        name="Bone", description="Bone of the target to look at; empty takes its origin", update=rewire, override=OVERRIDABLE
    )
    target_weight: _target_weight(
        "Target Weight",
        "How much the head looks to this target, against the weights of the further ones; the animation takes what all are short of 1",
    )
    extra_targets: bpy.props.CollectionProperty(type=MOTUS_PG_look_at_target, name="Further Targets", override=EXTENDABLE)
    active_extra_target: bpy.props.IntProperty(name="Active Further Target", options=set())
    body_length: bpy.props.IntProperty(
        name="Spine Bones",
        description="Number of bones, down the spine from the parent of the head, that turn along with it, the neck among them; 0 turns "
        "the head alone",
        default=0,
        min=0,
        max=255,
        update=rewire,
        options=set(),
        override=OVERRIDABLE,
    )
    eyes: bpy.props.CollectionProperty(type=MOTUS_PG_look_at_eye, name="Eyes", override=EXTENDABLE)
    lids: bpy.props.CollectionProperty(type=MOTUS_PG_look_at_lid, name="Eyelids", override=EXTENDABLE)
    shut_object: to_object(name="Face", description="Mesh object with a shape key that shuts the eyes", update=rewire, override=OVERRIDABLE)
    shut_key: bpy.props.StringProperty(
        name="Shape Key", description="Shape key that shuts the eyes, which blinks drive", update=rewire, override=OVERRIDABLE
    )
    is_muted: bpy.props.BoolProperty(
        name="Mute",
        description="Switch the entry off: the head keeps its own animation",
        default=False,
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )


def _entry_with(settings, bone):
    """Index of the entry whose head or eye is the bone of this name; -1 if there is none."""
    index = settings.entries.find(bone)
    return index if index >= 0 else next((index for index, entry in enumerate(settings.entries) if bone in entry.eyes), -1)


class MOTUS_PG_look_at(SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(
        name="Influence",
        description="How much all heads of the rig turn to their targets; 0 leaves the rig to its animation",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        options=ANIMATED,
        override=OVERRIDABLE,
        update=touch,
    )
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_look_at_entry, name="Entries", override=EXTENDABLE)
    chosen_entry: bpy.props.IntProperty(name="Chosen Entry", options={'HIDDEN'})
    active_entry: bone_entries.active_property("Active Entry", _entry_with)
