"""Operators that add and remove snow, apply presets, edit the colour gradient, and record colliders."""

import dataclasses

import bpy
from mathutils import Vector

from ..core import wiring
from ..core.file.pointers import pointed
from ..core.interface.operators import OBJECT_MODE, FindsValues, OfAnObject, Operator, object_keyword, select_only
from ..core.interface.rows import Rows
from ..core.interface.view import viewports
from ..core.measures import scene_time
from ..core.refusals import INFINITE, Refused, check_finite, check_local, check_unbaked, named, named_collection, named_mesh
from ..core.settings import lists
from ..core.translations import tr
from . import build, colliders, flakes, presets, rows
from .properties import FORMER_NAMES, KEYWORDS, FormerKeywords, SnowKeywords

ABOVE = 6.0  # height, in metres, of a new emitter above the 3D cursor or the place that the viewport shows


def _name(name, description):
    return bpy.props.StringProperty(name=name, description=description, options={'SKIP_SAVE'})


def _preset():
    return bpy.props.EnumProperty(
        name="Preset", description="Preset whose settings the emitter is given", items=presets.ITEMS, default=presets.PLAIN
    )


def _is_custom(operator):
    return operator.preset == presets.PLAIN


class MOTUS_OT_snow_add(FindsValues, SnowKeywords, FormerKeywords, bpy.types.Operator):
    bl_idname = "motus.snow_add"
    bl_label = "Add Snow"
    bl_description = "Let an emitter, or the faces of a mesh, emit flakes, without a cache"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    preset: _preset()
    surface: _name("Mesh", "Name of the mesh that emits the flakes")
    collider: _name("Collider", "Name of a mesh object that flakes land on")
    colliders: _name("Colliders", "Name of a collection whose mesh objects flakes land on")
    camera: _name("Camera", "Name of a camera in whose view the flakes are born")
    flake: _name("Flake", "Name of the object that flakes are instances of")
    flakes: _name("Flakes", "Name of the collection whose objects flakes are instances of")
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Location of the emitter; that of the 3D cursor if it is not given",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )

    modes = OBJECT_MODE
    needs_native = True
    former_keywords = FORMER_NAMES
    redo = (Rows(("preset",), title="Preset"), *(dataclasses.replace(group, when=_is_custom) for group in rows.ALL))

    def invoke(self, context, _event):
        # From a menu, without properties: the emitter gets the preset Gentle Snow, and a place above the scene.
        if not self.is_given("preset"):
            self.preset = 'GENTLE'
        if not self.is_given("location") and not self.surface:
            self.location = viewports.seen_place(context, context.scene.cursor.location) + Vector((0.0, 0.0, ABOVE))
        return self.execute(context)

    def run(self, context):
        check_finite(self, (*KEYWORDS, "location"))
        surface = named_mesh(self.surface) if self.surface else None
        collider = named_mesh(self.collider) if self.collider else None
        collection = named_collection(self.colliders) if self.colliders else None
        camera = self._camera(context)
        chosen = self._chosen()
        keywords = self.given(KEYWORDS)
        place = Vector(self.location) if self.is_given("location") else context.scene.cursor.location.copy()
        emitter = build.new_emitter(context, place)
        settings = emitter.motus.snow
        presets.put(settings, self.preset, context.scene)
        for name, value in (keywords | chosen).items():
            setattr(settings, name, value)
        if surface is not None:
            settings.shape, settings.surface = 'SURFACE', surface
        if camera is not None:
            settings.shape, settings.camera = 'CAMERA', camera
        for name, value in (("collider", collider), ("colliders", collection)):
            if value is not None:
                setattr(settings, name, value)
        try:
            _check_count(settings)
        except Refused:
            build.remove(emitter, False)
            raise
        build.wire(emitter)
        self.show_used(settings, KEYWORDS)
        select_only(context, emitter)
        wiring.report_problems(self, context, build.system(), [emitter])

    def _chosen(self):
        """Return {setting: value} for the object or collection that the operator's properties name as flakes; {} if they name none."""
        if self.flake and self.flakes:
            raise Refused(tr("Name an object or a collection, not both"))
        if self.flake:
            return {"look": 'OBJECT', "flake": named(self.flake)}
        if self.flakes:
            return {"look": 'COLLECTION', "flakes": named_collection(self.flakes)}
        return {}

    def _camera(self, context):
        """Return the camera in whose view flakes are born: the one that is named, or else the scene's camera.

        None if the emitter is not a camera's view. Raises Refused if there is no such camera.
        """
        if self.camera:
            found = named(self.camera)
            if found.type != 'CAMERA':
                raise Refused(tr("{object} is no camera").format(object=found.name))
            return found
        if self.surface or not self.is_given("shape") or self.shape != 'CAMERA':
            return None
        if context.scene.camera is None:
            raise Refused(tr("The scene has no camera"))
        return context.scene.camera


def _check_count(settings):
    """Raise Refused if an emitter's settings ask for more flakes at one time than flakes.MOST."""
    count = flakes.most(settings)
    if not count <= flakes.MOST:
        memory = f"{count * flakes.BYTES / 2**30:.3g} GB" if count < INFINITE else "∞"
        raise Refused(
            tr("{count} flakes at once would need {memory}; there can be {most}").format(
                count=f"{count:.3g}", memory=memory, most=f"{flakes.MOST:,}"
            )
        )


def emitter_for(context, name):
    """Return the emitter of this name, or the active object if the name is empty.

    Raises Refused if the object is no emitter of snow, is linked, or is baked.
    """
    found = named(name) if name else context.object
    if found is None or not build.is_emitter(found):
        raise Refused(tr("Nothing here snows"))
    check_local(found)
    check_unbaked(found, found.motus.snow)
    return found


class MOTUS_OT_snow_remove(Operator, bpy.types.Operator):
    bl_idname = "motus.snow_remove"
    bl_label = "Remove Snow"
    bl_description = "Take the snow away, with the emitter that was made for it"

    object: object_keyword("Name of the emitter; empty takes the selected ones")
    keep_object: bpy.props.BoolProperty(name="Keep Emitter", description="Keep the emitter, without its snow", default=False)

    modes = OBJECT_MODE
    redo = (Rows(("keep_object",)),)

    @classmethod
    def check_offer(cls, context):
        cls._found(context, "")

    def run(self, context):
        found = self._found(context, self.object)
        for one in found:
            emitter_for(context, one.name)
        names = ", ".join(one.name for one in found)
        for one in found:
            build.remove(one, self.keep_object)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=names))

    @staticmethod
    def _found(context, name):
        if name:
            return [emitter_for(context, name)]
        selected = context.selected_objects or [one for one in [context.object] if one]
        found = [one for one in selected if build.is_emitter(one)]
        if not found:
            raise Refused(tr("Nothing here snows"))
        return found


class _OnEmitter(OfAnObject):
    """Base of operators that change one emitter: the one that `object` names, or the active object."""

    object: object_keyword("Name of the emitter; empty takes the active object")
    found = staticmethod(emitter_for)


class MOTUS_OT_snow_preset(_OnEmitter, bpy.types.Operator):
    bl_idname = "motus.snow_preset"
    bl_label = "Kind of Snow"
    bl_description = "Give an emitter the settings of a preset"

    preset: _preset()

    redo = (Rows(("preset",)),)

    def run(self, context):
        emitter = self.found(context, self.object)
        presets.put(emitter.motus.snow, self.preset, context.scene)


class MOTUS_OT_snow_loop(_OnEmitter, bpy.types.Operator):
    bl_idname = "motus.snow_loop"
    bl_label = "Loop over the Scene"
    bl_description = "Let the snowfall repeat over the scene's frames, without a seam"

    def run(self, context):
        settings, scene = self.found(context, self.object).motus.snow, context.scene
        settings.loop_start = round(scene_time.first(scene))
        settings.loop_end = round(scene_time.keys_time(scene, scene.frame_end + 1))
        settings.use_loop = True


class MOTUS_OT_snow_stop_add(_OnEmitter, bpy.types.Operator):
    bl_idname = "motus.snow_stop_add"
    bl_label = "Add Color"
    bl_description = "Add a colour at the end of the gradient"

    def run(self, context):
        stops = self.found(context, self.object).motus.snow.stops
        last = stops[-1] if stops else None
        # A new colour is added at position 1: a last colour that is there already moves halfway to the colour before it.
        color = tuple(last.color) if last else None
        if last and last.position >= 1.0 and len(stops) > 1:
            last.position = 0.5 * (stops[-2].position + 1.0)
        stop = lists.add_numbered(stops, "Color")
        stop.position = 1.0 if color else 0.0
        if color:
            stop.color = color


class MOTUS_OT_snow_stop_remove(_OnEmitter, bpy.types.Operator):
    bl_idname = "motus.snow_stop_remove"
    bl_label = "Remove Color"
    bl_description = "Remove a colour from the gradient"

    index: bpy.props.IntProperty(
        name="Index", description="Index of the color in the list; -1 for the last one", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    def run(self, context):
        emitter = self.found(context, self.object)
        stops = emitter.motus.snow.stops
        index = self.index if self.index >= 0 else len(stops) - 1
        if not 0 <= index < len(stops):
            raise Refused(tr("The gradient has no such colour"))
        lists.remove(stops, index)
        wiring.touch(build.system(), emitter)


class MOTUS_OT_snow_colliders_record(_OnEmitter, bpy.types.Operator):
    bl_idname = "motus.snow_colliders_record"
    bl_label = "Record Colliders"
    bl_description = "Keep the colliders in the file as they are on this frame"

    def run(self, context):
        emitter = self.found(context, self.object)
        if not colliders.record(emitter, context.view_layer):
            raise Refused(tr("There is nothing with faces that flakes land on"))
        emitter.motus.snow.recorded_frame = scene_time.present(context.scene)


class MOTUS_OT_snow_colliders_clear(_OnEmitter, bpy.types.Operator):
    bl_idname = "motus.snow_colliders_clear"
    bl_label = "Clear Recorded Colliders"
    bl_description = "Forget the recorded colliders, so that flakes land on the colliders themselves again"

    def run(self, context):
        emitter = self.found(context, self.object)
        if pointed(emitter.motus.snow, "recorded") is None:
            raise Refused(tr("Nothing was recorded"))
        colliders.forget(emitter)


classes = (
    MOTUS_OT_snow_add,
    MOTUS_OT_snow_remove,
    MOTUS_OT_snow_preset,
    MOTUS_OT_snow_loop,
    MOTUS_OT_snow_stop_add,
    MOTUS_OT_snow_stop_remove,
    MOTUS_OT_snow_colliders_record,
    MOTUS_OT_snow_colliders_clear,
)
