"""Operators that add a stereo rig to a camera, fit it to a screen, and remove it."""

import bpy

from ..core import wiring
from ..core.interface.operators import OBJECT_MODE, FindsValues, Operator, object_keyword
from ..core.interface.rows import Rows
from ..core.refusals import Refused, check_evaluated, check_finite
from ..core.translations import tr
from . import budget, lens, rig, rows, samples, screens, targets
from .properties import KEYWORDS, StereoKeywords

MODES = (
    ('OFFAXIS', "Off-Axis", "The eyes look the same way, and their images are shifted"),
    ('PARALLEL', "Parallel", "The eyes look the same way: all is in front of the screen"),
    ('TOE', "Toe-In", "The eyes are turned towards each other, which moves corners up and down"),
)
LENGTHS = "interocular", "distance", "near", "far"
"""Keywords of the operator whose default values are lengths in metres."""
PARALLAXES = "near_parallax", "far_parallax"
LEFT_OUT = 0.01
"""Share of the sampled depths that is ignored at the near end, and again at the far end."""


class OfARig:
    """Mixin of the operators that change the stereo rig of a camera."""

    object: object_keyword("Name of the camera; empty takes the active one, or the scene's")

    @classmethod
    def check_offer(cls, context):
        targets.check_removable(targets.rig_for(context, ""))


class MOTUS_OT_stereo_rig_add(FindsValues, StereoKeywords, bpy.types.Operator):
    bl_idname = "motus.stereo_rig_add"
    bl_label = "Add Stereo Rig"
    bl_description = "Give a camera a left and a right eye, whose distances are set for an audience in front of a screen"
    modes = OBJECT_MODE
    needs_native = True
    redo = (Rows(("mode",), title="Add"), *rows.ADDING)

    object: object_keyword("Name of the camera; empty takes the active one, or the scene's")
    focus: bpy.props.StringProperty(
        name="Focus",
        description="Name of the object that lies on the screen; if Convergence is Object, empty takes the object that is selected beside "
        "the camera",
        options={'SKIP_SAVE'},
    )
    mode: bpy.props.EnumProperty(name="Mode", description="How the images meet on the screen", items=MODES, default='OFFAXIS')
    make_camera: bpy.props.BoolProperty(
        name="New Camera", description="Make a camera at the viewport's view if the scene has none", options={'SKIP_SAVE'}
    )
    for_scripts = ("make_camera",)

    @classmethod
    def check_offer(cls, context):
        if not targets.lacks_camera(context):
            targets.check_free(targets.camera_for(context, ""))

    def invoke(self, context, _event):
        self.make_camera = self.make_camera or (not self.object and targets.lacks_camera(context))
        # In the interface the rig is fitted to what the camera sees.
        if not any(self.is_given(name) for name in ("convergence", "focus", *LENGTHS, *PARALLAXES)):
            self._fit(context)
        return self.execute(context)

    def _fit(self, context):
        try:
            camera = targets.camera_for(context, self.object)
            targets.check_free(camera)
        except Refused:
            return  # the refusal is reported when the operator runs
        seen = samples.depth_range(context.scene, camera, context.evaluated_depsgraph_get(), LEFT_OUT)
        if seen:
            self.convergence = 'BUDGET'
            self.near, self.far = seen[0], samples.beyond(*seen)
            seen_by = lens.of(camera.data, context.scene.render)
            self.near_parallax, self.far_parallax = budget.parallaxes(self.near, self.far, seen_by, screens.of(self))

    def run(self, context):
        if self.make_camera and targets.lacks_camera(context):
            targets.new_camera(context)
        camera = targets.camera_for(context, self.object)
        targets.check_free(camera)
        focus = targets.focus_for(context, camera, self.focus) if self.focus or self.convergence == 'OBJECT' else None
        self._check(camera, focus)
        metre = 1.0 / context.scene.unit_settings.scale_length
        keywords = {name: getattr(self, name) * metre for name in LENGTHS} | self.given(KEYWORDS)
        if focus and not self.is_given("convergence"):
            keywords["convergence"] = 'OBJECT'
        rig.add(context.scene, camera, self.mode, focus, keywords)
        self.show_used(camera.motus.stereo, KEYWORDS)
        self._select(context, camera)
        self.report({'INFO'}, tr("{object} has a stereo rig").format(object=camera.name))
        wiring.report_problems(self, context, rig.system(), [camera])
        if not rig.renders_both_eyes(context.scene):
            self.report({'WARNING'}, rig.one_eye())

    @staticmethod
    def _select(context, camera):
        """Make the camera the active object, so that the panel shows its rig."""
        if camera.name in context.view_layer.objects:
            camera.select_set(True)
            context.view_layer.objects.active = camera

    def _check(self, camera, focus):
        check_finite(self, KEYWORDS)
        if self.convergence == 'BUDGET' and not 0.0 < self.near < self.far:
            raise Refused(tr("Near must be greater than 0, and far greater than near"))
        if self.convergence == 'BUDGET' and not self.near_parallax + self.far_parallax > 0.0:
            raise Refused(tr("Near and far parallax are both 0: there is no depth to spend"))
        if self.convergence == 'OBJECT' and focus is None:
            raise Refused(tr("Select the object that lies on the screen beside the camera, or name it"))
        if focus == camera:
            raise Refused(tr("A camera cannot be its own focus"))
        if self.convergence == 'DISTANCE' and not self.distance > 0.0:
            raise Refused(tr("The convergence distance must be greater than 0"))


class MOTUS_OT_stereo_fit(OfARig, Operator, bpy.types.Operator):
    bl_idname = "motus.stereo_fit"
    bl_label = "Fit to Screen"
    bl_description = "Set the parallax of the budget to a comfortable one for this screen, with no more depth than looks natural"
    modes = OBJECT_MODE
    needs_native = True

    def run(self, context):
        camera = targets.rig_for(context, self.object)
        targets.check_removable(camera)
        check_evaluated(camera, context.view_layer)
        settings = camera.motus.stereo
        if camera.data.type != 'PERSP':
            raise Refused(tr("{object} is no perspective camera").format(object=camera.name))
        check_finite(settings, ("near", "far", "screen_width", "screen_distance", "eye_separation"))
        if not 0.0 < settings.near < settings.far:
            raise Refused(tr("Near must be greater than 0, and far greater than near"))
        seen_by = lens.of(camera.evaluated_get(context.view_layer.depsgraph).data, context.scene.render)
        settings.near_parallax, settings.far_parallax = budget.parallaxes(settings.near, settings.far, seen_by, screens.of(settings))


class MOTUS_OT_stereo_rig_remove(OfARig, Operator, bpy.types.Operator):
    bl_idname = "motus.stereo_rig_remove"
    bl_label = "Remove Stereo Rig"
    bl_description = "Remove the stereo rig, and restore the camera"
    modes = OBJECT_MODE

    def run(self, context):
        camera = targets.rig_for(context, self.object)
        targets.check_removable(camera)
        rig.remove(camera)


classes = (MOTUS_OT_stereo_rig_add, MOTUS_OT_stereo_fit, MOTUS_OT_stereo_rig_remove)
