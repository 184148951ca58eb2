"""The operator that builds a demo scene, and its menu."""

from importlib import import_module

import bpy

from ..core.interface.operators import Operator
from ..core.interface.rows import Rows
from ..core.interface.view.viewports import space_for
from ..core.refusals import Refused
from ..core.translations import tr
from .scenes import SCENES


class MOTUS_OT_demo_scene(Operator, bpy.types.Operator):
    bl_idname = "motus.demo_scene"
    bl_label = "Demo Scene"
    bl_description = "Build an example of a system in a new scene and show it; your own scenes stay as they are"

    system: bpy.props.EnumProperty(
        name="System",
        description="The system to show",
        items=tuple((scene.identifier, scene.label, scene.description) for scene in SCENES),
        default="PATH",
    )
    redo = (Rows(("system",)),)

    @classmethod
    def description(cls, _context, properties):
        return tr(next(scene.description for scene in SCENES if scene.identifier == properties.system))

    @classmethod
    def check_place(cls, context):
        super().check_place(context)
        if context.window is None:
            raise Refused(tr("A window is needed to show the new scene"))

    def run(self, context):
        previous, known = context.window.scene, set(bpy.data.scenes)
        try:
            # The module and NumPy are imported only when a scene is built, because most users never build one.
            folder = next(scene.name for scene in SCENES if scene.identifier == self.system)
            scene = import_module(f"{__package__}.{folder}").build(context)
        except RuntimeError as error:  # an operator that the scene's build() calls has refused
            _discard(context.window, previous, set(bpy.data.scenes) - known)
            raise Refused(tr("The demo scene could not be finished: {error}").format(error=error)) from error
        if space := space_for(context):
            space.region_3d.view_perspective = 'CAMERA'
        self.report({"INFO"}, tr("Built {scene}").format(scene=scene.name))


def _discard(window, previous, unfinished):
    """Remove the unfinished scenes with their objects, and show the previous scene in the window."""
    window.scene = previous
    for scene in unfinished:
        for thing in list(scene.objects):
            bpy.data.objects.remove(thing)
        for collection in list(scene.collection.children_recursive):
            bpy.data.collections.remove(collection)
        bpy.data.scenes.remove(scene)


class MOTUS_MT_demo(bpy.types.Menu):
    bl_label = "Demo Scene"

    def draw(self, _context):
        for scene in SCENES:
            self.layout.operator(MOTUS_OT_demo_scene.bl_idname, text=scene.label, text_ctxt="*").system = scene.identifier


classes = (MOTUS_OT_demo_scene, MOTUS_MT_demo)
