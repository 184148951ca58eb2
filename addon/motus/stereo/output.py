"""Operator that sets the file format in which a scene saves the images of both eyes."""

import bpy

from ..core.interface.operators import Operator
from ..core.interface.rows import Row, Rows, is_one_of
from ..core.refusals import Refused
from ..core.translations import tr
from . import around, combining, rig, targets
from .operators import OfARig

FORMATS = (
    ('PAIR', "Pair", "A file for each eye"),
    ('SIDEBYSIDE', "Side by Side", "Both eyes in one image, the left eye's on the left"),
    ('TOPBOTTOM', "Top-Bottom", "Both eyes in one image, one above the other"),
    ('ANAGLYPH', "Anaglyph", "Both eyes on top of each other, for coloured glasses"),
    ('INTERLACE', "Interlaced", "The rows of one image belong to the left and the right eye in turns"),
)


def _is_around(settings):
    return settings.use_360


class MOTUS_OT_stereo_output(OfARig, Operator, bpy.types.Operator):
    bl_idname = "motus.stereo_output"
    bl_label = "Stereo Output"
    bl_description = "Set how the images of both eyes are written"
    redo = (
        Rows(
            (
                "format",
                Row("squeeze", when=is_one_of("format", 'SIDEBYSIDE', 'TOPBOTTOM')),
                Row("glasses", when=is_one_of("format", 'ANAGLYPH')),
                "use_360",
                Row("use_180", when=_is_around),
            )
        ),
    )

    format: bpy.props.EnumProperty(name="Format", description="How the images are written", items=FORMATS, default='SIDEBYSIDE')
    squeeze: bpy.props.BoolProperty(name="Squeezed", description="Squeeze both images together into the size of one", default=False)
    glasses: combining.glasses_keyword()
    use_360: bpy.props.BoolProperty(
        name="360 Degrees",
        description="Make the camera a panorama of 360 degrees, if the render engine can; by default the camera's type is kept",
        default=False,
        options={'SKIP_SAVE'},
    )

    use_180: bpy.props.BoolProperty(
        name="Front Half",
        description="Show the half of the panorama that is in front of the camera alone: VR180",
        default=False,
        options={'SKIP_SAVE'},
    )

    def invoke(self, context, _event):
        if self.is_given("format"):
            return self.execute(context)
        try:
            self._camera(context)
        except Refused as refusal:
            return self.refuse(refusal)
        return context.window_manager.invoke_props_dialog(self)

    def _camera(self, context):
        camera = targets.rig_for(context, self.object)
        targets.check_removable(camera)
        if not self.is_given("use_360"):
            self.use_360 = bool(camera.motus.stereo.before_type)
            if not self.is_given("use_180"):
                self.use_180 = self.use_360 and around.width(camera.data) < 2.0 * around.FULL - 1e-3
        return camera

    def run(self, context):
        camera = self._camera(context)
        scene = context.scene
        is_new = self.use_360 and not camera.motus.stereo.before_type
        if is_new and scene.render.engine != 'CYCLES':
            raise Refused(tr("Only Cycles can see all around in stereo: choose that as the render engine first"))
        if is_new and camera.motus.stereo.convergence == 'BUDGET':
            raise Refused(tr("A camera that sees all around has no budget of depth: choose another convergence first"))
        self._set_format(scene)
        if self.use_360:
            around.begin(camera.motus.stereo, scene, camera.data, around.HALF if self.use_180 else around.FULL)
        else:
            around.end(camera.motus.stereo, camera.data)
        label = next(label for identifier, label, _ in FORMATS if identifier == self.format)
        self.report({'INFO'}, tr("Both eyes are written as: {format}").format(format=bpy.app.translations.pgettext_iface(label)))

    def _set_format(self, scene):
        render = scene.render
        rig.begin_multiview(scene)
        render.views_format = 'STEREO_3D'
        for view in render.stereo_views:
            view.use = True
        image = render.image_settings
        image.views_format = 'INDIVIDUAL' if self.format == 'PAIR' else 'STEREO_3D'
        if self.format == 'PAIR':
            return
        both = image.stereo_3d_format
        both.display_mode = self.format
        both.anaglyph_type, both.interlace_type = self.glasses, 'ROW_INTERLEAVED'
        both.use_sidebyside_crosseyed = both.use_interlace_swap = False
        if self.format in {'SIDEBYSIDE', 'TOPBOTTOM'}:
            both.use_squeezed_frame = self.squeeze


classes = (MOTUS_OT_stereo_output,)
