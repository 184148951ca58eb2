"""Operators that set up a chroma key, measure its screen again, change it, and remove it."""

import bpy

from ..core.interface.operators import OBJECT_MODE, Operator
from ..core.interface.rows import Row, Rows, is_given
from ..core.refusals import Refused, check_finite
from ..core.translations import tr
from . import analysis, compositor, footage, group, masks, plane, scene_settings, settings, setup, viewing
from .properties import LIMITS, UNDERNEATH, VIEWS


def _number(keyword):
    one = settings.BY_KEYWORD[keyword]
    if one.is_whole:
        return bpy.props.IntProperty(
            name=one.label,
            description=one.description,
            default=one.default,
            min=one.least,
            max=one.most,
            soft_max=20,
            soft_min=max(one.least, -20),
            subtype='PIXEL',
        )
    return bpy.props.FloatProperty(
        name=one.label, description=one.description, default=one.default, min=one.least, max=one.most, subtype='FACTOR'
    )


class MOTUS_OT_chroma_key_setup(Operator, bpy.types.Operator):
    bl_idname = "motus.chroma_key_setup"
    bl_label = "Set Up Chroma Key"
    bl_description = "Make the green or blue screen of a clip or image transparent, and lay something underneath, in the compositor"
    modes = OBJECT_MODE
    needs_native = True
    redo = (
        Rows(("underneath", "view", "use_scene", "use_plane", Row("plane_distance", when=lambda op: op.use_plane)), title="Set Up"),
        Rows(
            (
                Row("color", when=is_given("color")),
                Row("black", when=is_given("black")),
                Row("white", when=is_given("white")),
                "balance",
                "gain",
                "smooth",
                "core",
                "grow",
                "feather",
                "despill",
                "despill_limit",
                "luminance",
                "light_wrap",
            ),
            title="Key",
        ),
    )

    clip: bpy.props.StringProperty(
        name="Clip", options={'SKIP_SAVE'}, description="Footage: name of an image or movie clip of this file, or path of a file"
    )
    background: bpy.props.StringProperty(
        name="Background",
        options={'SKIP_SAVE'},
        description="Name of the clip or image, or path of the file, that is laid underneath; empty for the render",
    )
    mask: bpy.props.StringProperty(
        name="Garbage Mask", options={'SKIP_SAVE'}, description="Name of a mask, within which all is made transparent"
    )
    camera: bpy.props.StringProperty(
        name="Camera", options={'SKIP_SAVE'}, description="Name of the camera that the plane stands before; empty takes the scene's"
    )
    filepath: bpy.props.StringProperty(
        name="File", subtype='FILE_PATH', options={'SKIP_SAVE'}, description="Path of the footage, as the file browser gives it"
    )
    directory: bpy.props.StringProperty(subtype='DIR_PATH', options={'HIDDEN', 'SKIP_SAVE'})
    files: bpy.props.CollectionProperty(type=bpy.types.OperatorFileListElement, options={'HIDDEN', 'SKIP_SAVE'})
    filter_image: bpy.props.BoolProperty(default=True, options={'HIDDEN', 'SKIP_SAVE'})
    filter_movie: bpy.props.BoolProperty(default=True, options={'HIDDEN', 'SKIP_SAVE'})
    filter_folder: bpy.props.BoolProperty(default=True, options={'HIDDEN', 'SKIP_SAVE'})
    underneath: bpy.props.EnumProperty(
        name="Underneath", description="What lies behind the subject, where the screen was", items=UNDERNEATH, default='RENDER'
    )
    view: bpy.props.EnumProperty(name="View", description="Picture that the compositor shows", items=VIEWS, default=group.COMPOSITE)
    use_scene: bpy.props.BoolProperty(
        name="Set Scene",
        default=True,
        description="Give the scene the footage's size, frames and frame rate, and colours that leave the footage as it is",
    )
    use_plane: bpy.props.BoolProperty(
        name="Viewport Plane",
        default=False,
        description="Show the key in the viewport too, on a plane that fills the camera's view and is not rendered",
    )
    plane_distance: bpy.props.FloatProperty(
        name="Plane Distance",
        description="Distance from the camera to the plane",
        default=plane.DISTANCE,
        min=0.001,
        soft_max=1000.0,
        subtype='DISTANCE',
    )
    color: bpy.props.FloatVectorProperty(
        name="Screen Color",
        description="Colour of the screen; by default it is found in the footage",
        subtype='COLOR',
        size=3,
        default=(0.05, 0.45, 0.08),
        min=0.0,
        soft_max=1.0,
        options={'SKIP_SAVE'},
    )
    black: _number("black")
    white: _number("white")
    balance: _number("balance")
    smooth: _number("smooth")
    grow: _number("grow")
    feather: _number("feather")
    despill: _number("despill")
    gain: _number("gain")
    core: _number("core")
    despill_limit: bpy.props.EnumProperty(
        name="Despill Limit",
        description="What limits the screen's green or blue on the subject, from the two other colors of each pixel",
        items=LIMITS,
    )
    luminance: _number("luminance")
    light_wrap: bpy.props.FloatProperty(
        name=settings.WRAP,
        description="How much of the background's light falls around the subject's edge",
        default=0.0,
        min=0.0,
        max=1.0,
        subtype='FACTOR',
    )

    _is_by_hand = False

    @classmethod
    def check_offer(cls, context):
        setup.check_free(context.scene)

    def invoke(self, context, _event):
        if self.clip or self.filepath:
            return self.execute(context)
        self._is_by_hand = True
        context.window_manager.fileselect_add(self)
        return {'RUNNING_MODAL'}

    def run(self, context):
        try:
            self._set_up(context)
        finally:
            footage.drop_unused()
        if self._is_by_hand:
            viewing.show(context)

    def _set_up(self, context):
        scene = context.scene
        setup.check_free(scene)
        check_finite(self, ("color",))
        image = self._image()
        underneath, background = self._background()
        mask, camera = self._mask(), self._camera(scene) if self.use_plane else None
        color = tuple(self.color) if self.is_given("color") else None
        found = analysis.measure(image, color, self.balance, self.gain)
        black, white = analysis.clip_levels(found[1])
        levels = self.black if self.is_given("black") else black, self.white if self.is_given("white") else white

        noted = scene.motus.chroma
        tree = compositor.prepared(scene, noted)
        key = compositor.insert(scene, tree, group.build(footage.size(image)[0]), image, background, underneath, mask, noted)
        noted.background = background
        for one in settings.OF_KEYING:
            settings.assign(key, one, settings.LIMITS[self.despill_limit] if one.keyword == "limit" else getattr(self, one.keyword))
        key.inputs[settings.WRAP].default_value = self.light_wrap
        noted.view = self.view
        if self.use_scene:
            scene_settings.take(scene, image, noted)
        if camera is not None:
            noted.plane = plane.add(scene, camera, image, plane.Key(found[0], *levels, self.balance, self.gain), self.plane_distance)
        setup.note_gaps(scene, image, background)
        setup.apply_measured(key, noted, found, levels)
        self.report(
            {'INFO'},
            tr("{object} is keyed by its {kind} screen").format(
                object=image.name, kind=tr("blue") if found[0][2] > found[0][1] else tr("green")
            ),
        )
        _warn(self, scene)

    def _image(self):
        names = [one.name for one in self.files if one.name]
        if names and not self.clip:
            return footage.find_chosen(self.directory, names)
        if not (self.clip or self.filepath):
            raise Refused(tr("Name a clip, an image or a file"))
        return footage.find(self.clip or self.filepath)

    def _background(self):
        """Return (what lies behind the keyed footage, its image or None) as the operator's keywords say."""
        if self.background:
            if self.is_given("underneath") and self.underneath != 'FOOTAGE':
                raise Refused(tr("With a background, footage lies underneath"))
            return 'FOOTAGE', footage.find(self.background)
        if self.underneath == 'FOOTAGE' and not self._is_by_hand:
            raise Refused(tr("Name the clip or image that is laid underneath"))
        return self.underneath, None  # the user chooses the footage in the panel

    def _mask(self):
        return _mask_named(self.mask) if self.mask else None

    def _camera(self, scene):
        found = bpy.data.objects.get(self.camera) if self.camera else scene.camera
        if found is None or found.type != 'CAMERA':
            raise Refused(tr("The plane needs a camera to stand before"))
        return found


def _warn(operator, scene):
    """Report the warnings about a scene's measured screen through an operator."""
    noted = scene.motus.chroma
    for sentence in (*analysis.sentences(noted), *([noted.gap] if noted.gap else ())):
        operator.report({'WARNING'}, sentence)


class _OnKey(Operator):
    """Mixin of the operators that act on the chroma key of the scene."""

    @classmethod
    def check_offer(cls, context):
        setup.key(context.scene)


class MOTUS_OT_chroma_key_measure(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_key_measure"
    bl_label = "Measure Screen"
    bl_description = "Find the colour of the screen, and levels that make it transparent, from the footage again"
    modes = OBJECT_MODE
    needs_native = True
    redo = (Rows(("keep_color",)),)

    keep_color: bpy.props.BoolProperty(
        name="Keep Color", description="Find the levels alone, for the colour that was picked", default=False
    )

    def run(self, context):
        color = None
        if self.keep_color:
            color = setup.color_of(setup.key(context.scene))
        setup.measure(context.scene, color)
        _warn(self, context.scene)


class MOTUS_OT_chroma_key_add(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_key_add"
    bl_label = "Key Another Color"
    bl_description = "Make another colour of the footage transparent too, by a key with settings and masks of its own"
    modes = OBJECT_MODE
    needs_native = True
    redo = (Rows((Row("color", when=is_given("color")),)),)

    color: bpy.props.FloatVectorProperty(
        name="Screen Color",
        description="Colour that is keyed; by default that of the next screen that is found in the picture behind the other keys",
        subtype='COLOR',
        size=3,
        default=(0.05, 0.45, 0.08),
        min=0.0,
        soft_max=1.0,
        options={'SKIP_SAVE'},
    )

    def run(self, context):
        check_finite(self, ("color",))
        setup.add_key(context.scene, tuple(self.color) if self.is_given("color") else None)


class MOTUS_OT_chroma_key_drop(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_key_drop"
    bl_label = "Remove Key of a Color"
    bl_description = "Remove the key that the panel shows; other keys stay"
    modes = OBJECT_MODE

    @classmethod
    def check_offer(cls, context):
        if setup.key(context.scene) == compositor.key_of(context.scene):
            raise Refused(tr("The first key goes with the whole: remove the chroma key"))

    def run(self, context):
        self.check_offer(context)
        compositor.remove_key(context.scene, setup.key(context.scene))
        context.scene.motus.chroma.active_key = 0


class MOTUS_OT_chroma_key_choose(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_key_choose"
    bl_label = "Show Key"
    bl_description = "Show the settings of this key in the panel"
    bl_options = {'INTERNAL', 'UNDO'}

    index: bpy.props.IntProperty(name="Index", description="Index of the key, from 0", default=-1, min=-1)

    def run(self, context):
        context.scene.motus.chroma.active_key = max(self.index, 0)


class MOTUS_OT_chroma_key_refresh(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_key_refresh"
    bl_label = "Upgrade Key"
    bl_description = "Give keys of older versions the present node group, with their settings, and find its levels"
    modes = OBJECT_MODE
    needs_native = True

    def run(self, context):
        setup.key(context.scene)
        setup.upgrade(context.scene)
        _warn(self, context.scene)


MASKS = (
    ('GARBAGE', settings.MASK, "Where all is clear: stands, lamps and what lies beyond the screen"),
    ('CORE', settings.CORE_MASK, "Where all is opaque: what has the screen's colour within the subject"),
)
_INPUTS = {identifier: name for identifier, name, _ in MASKS}


class MOTUS_OT_chroma_mask_add(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_mask_add"
    bl_label = "Add Mask"
    bl_description = "Add a mask or a picture to the key, whose white part becomes transparent or stays opaque"
    modes = OBJECT_MODE
    redo = (Rows(("kind",)),)

    kind: bpy.props.EnumProperty(name="Kind", description="Effect of the mask's white part", items=MASKS)
    mask: bpy.props.StringProperty(
        name="Mask", options={'SKIP_SAVE'}, description="Name of a mask of this file; without it a new one is made, to be drawn on"
    )
    picture: bpy.props.StringProperty(
        name="Picture",
        options={'SKIP_SAVE'},
        description="Name of an image, or path of a file, whose white part counts, in place of a mask",
    )

    def run(self, context):
        scene = context.scene
        key = setup.key(scene)
        if self.mask and self.picture:
            raise Refused(tr("Name a mask or a picture, not both"))
        if settings.place_of_input(key, _INPUTS[self.kind]) is None:
            raise Refused(tr("The key is of an older version: upgrade it first"))
        if self.picture:
            found = footage.find(self.picture)
        elif self.mask:
            found = _mask_named(self.mask)
        else:
            found = masks.new(_INPUTS[self.kind], footage.size(setup.image_of(scene)), self.kind == 'GARBAGE')
            self.report({'INFO'}, tr("Move the corners of {object} in an Image Editor, in the mode Mask").format(object=found.name))
        compositor.add_mask(scene, key, _INPUTS[self.kind], found)


class MOTUS_OT_chroma_mask_remove(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_mask_remove"
    bl_label = "Remove Mask"
    bl_description = "Remove this mask from the key; the mask stays in the file"
    modes = OBJECT_MODE
    redo = (Rows(("kind",)),)

    kind: bpy.props.EnumProperty(name="Kind", description="Kind of the mask that is removed", items=MASKS)

    def run(self, context):
        compositor.remove_mask(context.scene, setup.key(context.scene), _INPUTS[self.kind])


def _mask_named(name):
    if name not in bpy.data.masks:
        raise Refused(tr("There is no mask {object}").format(object=name))
    return bpy.data.masks[name]


class MOTUS_OT_chroma_key_show(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_key_show"
    bl_label = "Show in Viewport"
    bl_description = "Show the key in the viewport, through the scene's camera; a second time restores the previous view"
    bl_options = {'UNDO'}

    def run(self, context):
        setup.key(context.scene)
        if viewing.is_shown(context):
            viewing.hide(context)
        else:
            viewing.show(context)


class MOTUS_OT_chroma_key_remove(_OnKey, bpy.types.Operator):
    bl_idname = "motus.chroma_key_remove"
    bl_label = "Remove Chroma Key"
    bl_description = "Remove the key's nodes and its plane, and restore the compositor and the scene"
    modes = OBJECT_MODE

    def run(self, context):
        setup.key(context.scene)
        if viewing.is_shown(context):
            viewing.hide(context)
        setup.remove(context.scene)


classes = (
    MOTUS_OT_chroma_key_setup,
    MOTUS_OT_chroma_key_measure,
    MOTUS_OT_chroma_key_add,
    MOTUS_OT_chroma_key_drop,
    MOTUS_OT_chroma_key_choose,
    MOTUS_OT_chroma_key_refresh,
    MOTUS_OT_chroma_mask_add,
    MOTUS_OT_chroma_mask_remove,
    MOTUS_OT_chroma_key_show,
    MOTUS_OT_chroma_key_remove,
)
