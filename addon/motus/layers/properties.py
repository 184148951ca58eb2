"""Settings of the animation layers in Object.motus.layers, with an entry for each layer, the lowest layer first."""

from functools import partial

import bpy

from ..core.settings import ANIMATED, EXTENDABLE, NO_KEYS, OVERRIDABLE, SystemSettings, rewire, touch
from ..core.settings.declared import choice, number

MODES = (
    ('OVERRIDE', "Override", "The layer takes the place of what lies beneath it"),
    ('ADDITIVE', "Additive", "The difference between the action and its reference is added to what lies beneath"),
)
REFERENCES = (
    ('FIRST', "First Frame", "The action is compared with its own first frame"),
    ('FRAME', "Frame", "The action is compared with its pose at a frame of its own"),
    ('REST', "Rest Pose", "The action is compared with the rig's rest pose"),
    ('ACTION', "Other Action", "The action is compared with a pose of a different action"),
)
AFTERS = (
    ('STOP', "Stop", "The layer ends with its action"),
    ('HOLD', "Hold", "The last pose stays"),
    ('REPEAT', "Repeat", "The action begins again; its last frame is its first one"),
)
KINDS = (
    ('BONE', "Bone", "A bone", 'BONE_DATA', 0),
    ('COLLECTION', "Collection", "The bones of a bone collection, or of a bone group before Blender 4", 'GROUP_BONE', 1),
)
MOST_LAYERS = 64
"""Greatest number of layers of a rig: each layer takes time on every frame."""


_frames = partial(number, tells_no_keys=True, step=100, precision=1)


class LayerKeywords:
    """Mixin with the properties that a layer and the operator that adds layers share. Scripts use the names as keywords."""

    mode: choice("Mode", "How the layer acts on what lies beneath it", MODES, 'OVERRIDE')
    weight: bpy.props.FloatProperty(
        name="Weight",
        description="How much the layer acts; 0 leaves what lies beneath as it is",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        update=touch,
        options=ANIMATED,
        override=OVERRIDABLE,
    )
    start: _frames("Start", "Frame of the scene on which the action begins to play", 1.0)
    speed: bpy.props.FloatProperty(
        name="Speed",
        description="How fast the action plays; a negative speed plays it backwards, from its last frame" + NO_KEYS,
        default=1.0,
        soft_min=-4.0,
        soft_max=4.0,
        update=touch,
        options=set(),
        override=OVERRIDABLE,
    )
    after: choice("After", "What follows the last frame of the action", AFTERS, 'STOP')
    blend_in: _frames("Blend In", "Number of frames from the start over which the weight grows", 0.0, min=0.0)
    blend_out: _frames("Blend Out", "Number of frames before the end over which the weight of a layer that stops fades", 0.0, min=0.0)
    reference: choice("Reference", "Pose that an additive layer is compared with", REFERENCES, 'FIRST')
    reference_frame: _frames(
        "Reference Frame", "Frame of the action, or of the other action, whose pose an additive layer is compared with", 1.0
    )
    in_armature: bpy.props.BoolProperty(
        name="Steady in Armature",
        description="Blend rotations as they are in the armature, so that hips outside of the mask do not swing the bones in it",
        default=False,
        update=touch,
        options=set(),
        override=OVERRIDABLE,
    )
    feather: bpy.props.IntProperty(
        name="Feather",
        description="Number of bones from the border of the mask over which the weight rises" + NO_KEYS,
        default=0,
        min=0,
        soft_max=8,
        max=255,
        update=touch,
        options=set(),
        override=OVERRIDABLE,
    )
    use_range: bpy.props.BoolProperty(
        name="Frame Range",
        description="Play a part of the action, and not all of its frames",
        default=False,
        update=touch,
        options=set(),
        override=OVERRIDABLE,
    )
    first_frame: _frames("First", "First frame of the part of the action that is played", 1.0)
    last_frame: _frames("Last", "Last frame of the part of the action that is played", 25.0)


KEYWORDS = tuple(LayerKeywords.__annotations__)


class MOTUS_PG_layers_mask(bpy.types.PropertyGroup):
    """Item of a layer's mask: a bone or bone collection. If several items include one bone, the last item's weight counts."""

    name: bpy.props.StringProperty(name="Name", description="Name of the bone or the collection", update=rewire, override=OVERRIDABLE)
    kind: choice("Kind", "Whether the name is that of a bone or of a collection", KINDS, 'BONE', update=rewire)
    with_children: bpy.props.BoolProperty(
        name="With Children", description="All bones below count as well", default=True, update=rewire, options=set(), override=OVERRIDABLE
    )
    weight: bpy.props.FloatProperty(
        name="Weight",
        description="How much the layer acts on these bones" + NO_KEYS,
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        update=touch,
        options=set(),
        override=OVERRIDABLE,
    )


class MOTUS_PG_layers_entry(LayerKeywords, bpy.types.PropertyGroup):
    name: bpy.props.StringProperty(name="Layer", description="Name of the layer", override=OVERRIDABLE)
    action: bpy.props.PointerProperty(
        type=bpy.types.Action, name="Action", description="Action that the layer plays", update=touch, override=OVERRIDABLE
    )
    reference_action: bpy.props.PointerProperty(
        type=bpy.types.Action,
        name="Reference Action",
        description="Action whose pose at the reference frame an additive layer is compared with",
        update=touch,
        override=OVERRIDABLE,
    )
    slot: bpy.props.StringProperty(
        name="Slot",
        description="Slot of the action, where it has several; empty takes the first one that animates bones of the rig",
        update=touch,
        override=OVERRIDABLE,
    )
    mask: bpy.props.CollectionProperty(type=MOTUS_PG_layers_mask, name="Mask", override=EXTENDABLE)
    active_mask: bpy.props.IntProperty(name="Active Mask", options=set())
    is_muted: bpy.props.BoolProperty(
        name="Mute", description="Switch the layer off", default=False, update=touch, options=ANIMATED, override=OVERRIDABLE
    )
    is_solo: bpy.props.BoolProperty(
        name="Solo",
        description="Play only the layers whose Solo is on, as long as it is on for any",
        default=False,
        update=touch,
        options=set(),
        override=OVERRIDABLE,
    )
    is_edited: bpy.props.BoolProperty(name="Edited", description="The layer's action is shown and keyed in the editors", options={'HIDDEN'})
    is_open: bpy.props.BoolProperty(
        name="Open", description="The layer's frame range was set for as long as the layer is edited", options={'HIDDEN'}
    )


class MOTUS_PG_layers(SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(
        name="Influence",
        description="How much all layers of the rig act; 0 leaves it to its own animation",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        options=ANIMATED,
        override=OVERRIDABLE,
        update=touch,
    )
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_layers_entry, name="Layers", override=EXTENDABLE)
    active_entry: bpy.props.IntProperty(name="Active Layer", options=set())
    kept_channels: bpy.props.StringProperty(
        name="Kept Channels", description="Values of bones' channels when the editing of a layer began", options={'HIDDEN'}
    )
