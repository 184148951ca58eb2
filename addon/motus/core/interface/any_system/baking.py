"""The operators motus.bake and motus.unbake."""

import bpy

from ...bake import job
from ...declare import title
from ...refusals import Refused
from ...translations import counted, tr
from ..operators import Operator, named_or_active, object_keyword
from ..over_frames import OverFrames


def _objects(count):
    return counted(count, tr("1 object"), tr("{count} objects"))


class MOTUS_OT_bake(OverFrames, bpy.types.Operator):
    bl_idname = "motus.bake"
    bl_label = "Bake"
    bl_description = "Turn what Motus computes into keyframes, in an action of their own"

    object: object_keyword("Object that is driven or drives others; empty means the active one")
    system: bpy.props.StringProperty(
        name="System", description="Name of the system to bake; empty means all of the object's", options={'SKIP_SAVE'}
    )

    @classmethod
    def check_offer(cls, context):
        thing = named_or_active(context, "")
        job.owner_and_systems(thing)
        if thing.motus.bake.is_baked:
            raise Refused(tr("{object} is baked already: unbake it first").format(object=thing.name))

    def draw_below(self, context):
        super().draw_below(context)
        try:
            owner, systems = self._baked(context)
        except Refused:
            return  # the selection has changed since the dialog was opened
        labels = ", ".join(bpy.app.translations.pgettext_iface(*title(one)) for one in systems)
        column = self.layout.column(align=True)
        column.label(text=f"{owner.name}: {labels}", icon='KEYFRAME', translate=False)
        column.label(text=_objects(len(job.objects_of(owner, systems))), icon='BLANK1', translate=False)

    def _baked(self, context):
        """Find what the operator's keywords name: (owner, [System]) to bake. Raises Refused if there is nothing to bake."""
        return job.owner_and_systems(named_or_active(context, self.object), self.system)

    def steps(self, context, frames):
        owner, systems = self._baked(context)
        self._result = frames, len(job.objects_of(owner, systems))
        self._inexact = job.inexact(owner, systems)
        return job.bake(context.scene, context.view_layer, owner, systems, frames)

    def result(self, _context):
        frames, objects = self._result
        self.report(
            {'INFO'},
            tr("Baked {objects}, {frames}: {first}-{last}").format(
                objects=_objects(objects),
                frames=counted(len(frames), tr("1 frame"), tr("{count} frames")),
                first=f"{frames[0]:g}",
                last=f"{frames[-1]:g}",
            ),
        )
        if self._inexact:
            self.report(
                {'WARNING'},
                tr("Keyframes cannot undo the stretch that these bones inherit from the chain: {bones}").format(
                    bones=", ".join(self._inexact)
                ),
            )


class MOTUS_OT_unbake(Operator, bpy.types.Operator):
    bl_idname = "motus.unbake"
    bl_label = "Unbake"
    bl_description = "Take the baked keyframes away, put the object's own action back and switch the systems on again"

    object: object_keyword("Object that was baked; empty means the active one")
    system: bpy.props.StringProperty(name="System", description="Name of a system that was baked; empty means any", options={'SKIP_SAVE'})

    @classmethod
    def check_offer(cls, context):
        job.check_baked(named_or_active(context, ""))

    def run(self, context):
        baked, partial = job.unbake(named_or_active(context, self.object), self.system)
        self.report({'INFO'}, tr("Unbaked {objects}").format(objects=_objects(len(baked))))
        if partial:
            self.report(
                {'WARNING'},
                tr("Not all that these were before baking is in the file any more: {objects}").format(
                    objects=", ".join(one.name for one in partial)
                ),
            )


classes = (MOTUS_OT_bake, MOTUS_OT_unbake)
