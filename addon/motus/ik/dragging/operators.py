"""Operator that drags a chain by a point on any of its bones."""

import bpy
from mathutils import Vector

from ...core.blender import actions
from ...core.interface.dragging.drag import PointDrag
from ...core.interface.rows import Row, Rows, is_given
from ...core.measures import scene_time
from ...core.refusals import Refused, check_finite, check_posed, named
from ...core.translations import tr
from .. import status, targets
from ..operators import OfARig
from . import grab, picking

REACHED = 1e-4
"""Distance, as a share of the bone's length, at which the dragged point counts as brought to its place."""


class MOTUS_OT_ik_drag(PointDrag, OfARig, bpy.types.Operator):
    bl_idname = "motus.ik_drag"
    bl_label = "Drag Chain"
    bl_description = "Take hold of a bone at any point; the chain follows the mouse"

    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the bone that is pulled; empty takes the active one", options={'SKIP_SAVE'}
    )
    factor: bpy.props.FloatProperty(
        name="Factor",
        description="Point of the bone that is pulled, from its head (0) to its tail (1)",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
        options={'SKIP_SAVE'},
    )
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place in the world that the point is pulled to",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    chain_length: bpy.props.IntProperty(
        name="Chain Length",
        default=0,
        min=0,
        max=255,
        description="How many bones without inverse kinematics follow; 0 takes those that are connected up to a branch",
    )

    redo = (Rows(("factor", "chain_length", Row("location", when=is_given("location")))),)

    @classmethod
    def check_offer(cls, context):
        targets.rig_for(context, "")

    def run(self, context):
        rig = self._rig(context)
        bone = targets.bone_for(context, rig, self.bone)
        if not self.is_given("location"):
            raise Refused(tr("Say where to: location is missing"))
        check_finite(self, ("factor", "location"))
        held = grab.grab(context, rig, bone, self.factor, self.chain_length)
        held.pull(Vector(self.location))
        self._key(context, held)
        context.view_layer.update()
        left = (grab.point_on(rig, context.view_layer.depsgraph, bone, self.factor) - Vector(self.location)).length
        if left > REACHED * rig.data.bones[bone].length * rig.matrix_world.median_scale:
            self.report({'WARNING'}, tr("The point stays {length} away").format(length=status.length(context, left)))

    def invoke(self, context, event):
        if context.window is None or self.is_given("location"):
            return self.execute(context)
        try:
            self.object = self._rig(context).name
            return self._begin(context, event)
        except Refused as refusal:
            return self.refuse(refusal)

    def _rig(self, context):
        rig = targets.rig_for(context, self.object)
        check_posed(rig, context.view_layer)
        return rig

    def _show_keys(self, context):
        context.workspace.status_text_set(tr("Press the left mouse button on a bone and drag it; Esc or the right button cancels"))

    def _hold(self, context, region, view, mouse):
        picked = picking.pick(context, named(self.object), region, view, mouse)
        if picked is None:
            return None
        self.bone, self.factor = picked.bone, picked.factor
        self._held = grab.grab(context, named(self.object), picked.bone, picked.factor, self.chain_length)
        return self._held.point, picked.place

    def _move(self, place):
        self.location = place
        self._held.pull(Vector(place))

    def _click(self, _context):
        # A click selects the bone, as in Blender's own tools. The drag has taken the mouse events, so the bone is selected here.
        region = self._travel.view.region
        place = [round(self._pressed[0] - region.x), round(self._pressed[1] - region.y)]
        return bpy.ops.view3d.select('EXEC_REGION_WIN', deselect_all=True, location=place)

    def _finish(self, context):
        self._key(context, self._held)

    @staticmethod
    def _key(context, held):
        tools = context.scene.tool_settings
        if not tools.use_keyframe_insert_auto:
            return
        options = {'INSERTKEY_REPLACE'} if tools.auto_keying_mode == 'REPLACE_KEYS' else set()
        if context.preferences.edit.use_keyframe_insert_available:
            options.add('INSERTKEY_AVAILABLE')
        for one, path in zip(held.moved, held.paths):
            actions.make_local(one.object)
            one.thing.keyframe_insert(path, frame=scene_time.present(context.scene), options=options, group=one.bone or "Object Transforms")


classes = (MOTUS_OT_ik_drag,)
