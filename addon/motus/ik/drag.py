"""The operator that drags a chain by any of its points."""

import math

import bpy
from bpy_extras.view3d_utils import region_2d_to_location_3d
from mathutils import Vector

from ..core.translations import tr
from . import grab, picking, status, targets
from .operators import OfARig, in_a_mode_of_objects, refused
from .targets import Refused

REACHED = 1e-4
"""Share of the bone's length within which the point counts as brought there."""


class MOTUS_OT_ik_drag(OfARig, bpy.types.Operator):
    bl_idname = "motus.ik_drag"
    bl_label = "Drag Chain"
    bl_description = "Take hold of a bone at any point; the chain follows the mouse"
    bl_options = {'REGISTER', 'UNDO'}

    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the bone that is pulled; empty takes the active one", options={'SKIP_SAVE'})
    factor: bpy.props.FloatProperty(
        name="Factor", description="Where along the bone it is held, from its head (0) to its tail (1)", default=1.0,
        min=0.0, max=1.0, subtype='FACTOR', options={'SKIP_SAVE'})
    location: bpy.props.FloatVectorProperty(
        name="Location", description="Where that point is pulled to, in the world", size=3, subtype='XYZ',
        unit='LENGTH', options={'SKIP_SAVE'})
    chain_length: bpy.props.IntProperty(
        name="Chain Length", default=0, min=0, max=255,
        description="How many bones without inverse kinematics follow; 0 takes those that are connected up to a branch")

    poll = classmethod(in_a_mode_of_objects)

    def execute(self, context):
        try:
            rig = targets.rig_for(context, self.object)
            bone = targets.bone_for(context, rig, self.bone)
            if not self.properties.is_property_set("location"):
                raise Refused(tr("Say where to: location is missing"))
            targets.check_finite(self, ("factor",))
            if not all(map(math.isfinite, self.location)):
                raise Refused(tr("{keyword} is not a finite number").format(keyword="location"))
            held = grab.grab(context, rig, bone, self.factor, self.chain_length)
        except Refused as refusal:
            return refused(self, refusal)
        held.pull(Vector(self.location))
        self._key(context, held)
        context.view_layer.update()
        left = (grab.point_on(rig, context.view_layer.depsgraph, bone, self.factor) - Vector(self.location)).length
        if left > REACHED * rig.data.bones[bone].length * rig.matrix_world.median_scale:
            self.report({'WARNING'}, tr("The point stays {length} away").format(length=status.length(context, left)))
        return {'FINISHED'}

    def invoke(self, context, event):
        if context.window is None or self.properties.is_property_set("location"):
            return self.execute(context)
        self._held = None
        try:
            self.object = targets.rig_for(context, self.object).name
            if event.type == 'LEFTMOUSE' and event.value == 'PRESS' and not self._take(context, event):
                return {'CANCELLED', 'PASS_THROUGH'}
        except Refused as refusal:
            return refused(self, refusal)
        context.workspace.status_text_set(
            tr("Press the left mouse button on a bone and drag it; Esc or the right button cancels"))
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type in {'ESC', 'RIGHTMOUSE'} and event.value == 'PRESS':
            self.cancel(context)
            return {'CANCELLED'}
        if self._held is None:
            return self._wait(context, event)
        if event.type == 'MOUSEMOVE':
            self._follow(event)
        elif event.type == 'LEFTMOUSE' and event.value == 'RELEASE':
            context.workspace.status_text_set(None)
            if not self._has_moved:
                return {'CANCELLED'}
            self._key(context, self._held)
            return {'FINISHED'}
        return {'RUNNING_MODAL'}

    def cancel(self, context):
        context.workspace.status_text_set(None)
        if self._held:
            self._held.restore()

    def _wait(self, context, event):
        if event.type != 'LEFTMOUSE' or event.value != 'PRESS':
            return {'PASS_THROUGH'}  # the view can be turned in the meantime
        try:
            self._take(context, event)
        except Refused as refusal:
            self.cancel(context)
            return refused(self, refusal)
        # A press beside all bones is meant for what lies there.
        return {'RUNNING_MODAL'} if self._held else {'PASS_THROUGH'}

    def _take(self, context, event):
        """Take hold of the bone under the mouse; returns whether there is one."""
        found = picking.view_at(context.window, event.mouse_x, event.mouse_y)
        if found is None:
            return False
        region, view = found
        rig = targets.named(self.object)
        mouse = Vector((event.mouse_x - region.x, event.mouse_y - region.y))
        picked = picking.pick(context, rig, region, view, mouse)
        if picked is None:
            return False
        self.bone, self.factor = picked.bone, picked.factor
        self._held = grab.grab(context, rig, picked.bone, picked.factor, self.chain_length)
        self._has_moved = False
        self._region, self._view = region, view
        # The mouse keeps its distance from the point, so that nothing jumps.
        self._offset = picked.place - mouse
        self._pressed = event.mouse_x, event.mouse_y
        return True

    def _follow(self, event):
        if not self._has_moved and (event.mouse_x, event.mouse_y) == self._pressed:
            return
        self._has_moved = True
        mouse = Vector((event.mouse_x - self._region.x, event.mouse_y - self._region.y))
        self.location = region_2d_to_location_3d(self._region, self._view, mouse + self._offset, self._held.point)
        self._held.pull(Vector(self.location))

    @staticmethod
    def _key(context, held):
        tools = context.scene.tool_settings
        if not tools.use_keyframe_insert_auto:
            return
        options = {'INSERTKEY_REPLACE'} if tools.auto_keying_mode == 'REPLACE_KEYS' else set()
        if context.preferences.edit.use_keyframe_insert_available:
            options.add('INSERTKEY_AVAILABLE')
        for thing, path in zip(held.things, held.paths):
            group = thing.name if isinstance(thing, bpy.types.PoseBone) else "Object Transforms"
            thing.keyframe_insert(path, options=options, group=group)


classes = (MOTUS_OT_ik_drag,)
