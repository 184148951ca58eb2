"""The operator motus.hand_over, and its entry in File > Export."""

import bpy

from ..core.interface.over_frames import IntoFile, frame_range
from ..core.interface.rows import Rows
from ..core.refusals import Refused, check_finite
from ..core.translations import tr
from . import found, handing
from .formats import ITEMS, check

MARGIN = 1.0
"""Frames that are recorded before the start and after the end, for motion blur."""


class MOTUS_OT_hand_over(IntoFile, bpy.types.Operator):
    bl_idname = "motus.hand_over"
    bl_label = "Hand Over"
    bl_description = "Write a copy of the file in which all that Motus moves is plain Blender, and which plays without the add-on"
    bl_options = {'REGISTER'}

    filter_glob: bpy.props.StringProperty(default="*.blend", options={'HIDDEN', 'SKIP_SAVE'})
    start: bpy.props.IntProperty(name="Start", description="First frame; the scene's where it is not given", options={'SKIP_SAVE'})
    end: bpy.props.IntProperty(name="End", description="Last frame; the scene's where it is not given", options={'SKIP_SAVE'})
    step: bpy.props.FloatProperty(
        name="Step",
        description="Frames from one sample of the motion to the next; keys are set only where the motion needs them",
        default=0.25,
        min=0.01,
        max=1.0,
    )
    formats: bpy.props.EnumProperty(
        name="Formats",
        description="Further files for other programs, beside the .blend, by Blender's own exporters",
        items=ITEMS,
        options={'ENUM_FLAG'},
        default=set(),
    )
    redo = (Rows(("start", "end", "step", "formats")),)

    chosen = ("filepath", "start", "end", "step", "formats")

    def suggested(self, context):
        self.start, self.end = context.scene.frame_start, context.scene.frame_end
        name = bpy.path.display_name_from_filepath(bpy.data.filepath) or "untitled"
        return f"{name} Handed Over.blend"

    def begin(self, context):
        frames = self._frames(context.scene)
        path = handing.target(self.filepath)
        handing.program()
        check(self.formats)
        found.check(context.view_layer)
        self._written = path
        span = round(frames[0] + MARGIN), round(frames[-1] - MARGIN)
        return len(frames), handing.hand_over(context.scene, context.view_layer, path, frames, self.formats, span)

    def _frames(self, scene):
        check_finite(self, ("step",))
        first = self.start if self.is_given("start") else scene.frame_start
        last = self.end if self.is_given("end") else scene.frame_end
        if first == last:
            raise Refused(tr("One frame is no motion: let the end frame come after the start frame"))
        return frame_range(first - MARGIN, last + MARGIN, self.step)

    def result(self, _context):
        self.report({'INFO'}, tr("Handed over to {path}").format(path=self._written))


def _draw_export(menu, _context):
    menu.layout.operator_context = 'INVOKE_DEFAULT'
    menu.layout.operator(MOTUS_OT_hand_over.bl_idname, text="Motus Hand Over (.blend)")


class ExportMenu:
    """The operator's entry in File > Export."""

    @staticmethod
    def register():
        bpy.types.TOPBAR_MT_file_export.append(_draw_export)

    @staticmethod
    def unregister():
        bpy.types.TOPBAR_MT_file_export.remove(_draw_export)


classes = (MOTUS_OT_hand_over,)
