"""Property group of a baked object, with what unbaking needs to restore the object."""

import bpy

from ..file.pointers import to_object


class MOTUS_PG_bake(bpy.types.PropertyGroup):
    is_baked: bpy.props.BoolProperty(name="Baked", description="The object moves by baked keyframes", options={'HIDDEN'})
    owner: to_object(name="Owner", description="Object whose system was baked; empty where it is this one", options={'HIDDEN'})
    action: bpy.props.PointerProperty(
        type=bpy.types.Action, name="Baked Action", description="Action that holds the baked keyframes", options={'HIDDEN'}
    )
    frame_start: bpy.props.FloatProperty(name="Start", description="First frame of the baked keyframes", options={'HIDDEN'})
    frame_end: bpy.props.FloatProperty(
        name="End", description="Last frame of the baked keyframes; as the first one in files of older versions", options={'HIDDEN'}
    )
    previous_action: bpy.props.PointerProperty(
        type=bpy.types.Action, name="Previous Action", description="The object's own action, which unbaking puts back", options={'HIDDEN'}
    )
    previous_slot: bpy.props.StringProperty(name="Previous Slot", description="The object's slot in its own action", options={'HIDDEN'})
    kept: bpy.props.StringProperty(name="Kept", description="Values and switches as they were before baking", options={'HIDDEN'})
