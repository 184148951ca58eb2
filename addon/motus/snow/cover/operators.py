"""Operators that add and remove snow covers, edit their lists, and compute them with a progress bar."""

import bpy

from ...core import wiring
from ...core.declare import Problem, is_owner
from ...core.file.pointers import pointed
from ...core.interface.operators import OBJECT_MODE, FindsValues, OfAnObject, Operator, object_keyword, select_only
from ...core.interface.over_frames import Job
from ...core.interface.rows import Rows
from ...core.refusals import Refused, check_finite, check_local, check_unbaked, named
from ...core.scenery import gathered
from ...core.settings import lists
from ...core.translations import tr
from .. import colliders
from . import build, rows, sources, work
from .properties import KEYWORDS, SnowCoverKeywords

_COVER = "Name of the snow cover; empty takes the active object"


def _names(name, description):
    return bpy.props.StringProperty(name=name, description=description, options={'SKIP_SAVE'})


def _listed(names):
    """List the objects whose names a text gives, separated by commas. Raises Refused if a name has no object."""
    return [named(name.strip()) for name in names.split(",") if name.strip()]


class MOTUS_OT_snow_cover_add(FindsValues, SnowCoverKeywords, bpy.types.Operator):
    bl_idname = "motus.snow_cover_add"
    bl_label = "Add Snow Cover"
    bl_description = "Let the flakes that land on the selected meshes stay there, as a layer of snow that grows"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    surfaces: _names("Surfaces", "Names of the mesh objects that snow lies on, between commas; empty takes the selected ones")
    collection: _names("Collection", "Name of a collection on whose meshes snow lies too")
    emitters: _names("Emitters", "Names of the emitters of snow, between commas; empty takes the selected ones, or all of the scene")
    movers: _names("Movers", "Names of mesh objects that leave marks in the snow, between commas")
    lands: bpy.props.BoolProperty(
        name="Flakes Land",
        description="Let flakes of emitters that have no collider land on all the surfaces and on the collection",
        default=True,
    )

    modes = OBJECT_MODE
    needs_native = True
    redo = (*rows.ALL, Rows(("lands",)))

    @classmethod
    def check_offer(cls, context):
        _surfaces(context, "", "")
        _emitters(context, "")

    def run(self, context):
        check_finite(self, KEYWORDS)
        surfaces, collection = _surfaces(context, self.surfaces, self.collection)
        emitters = _emitters(context, self.emitters)
        movers = _listed(self.movers)
        for obj in movers:
            _check_mover(obj)
        keywords = self.given(KEYWORDS)
        cover = build.new_cover(context)
        settings = cover.motus.snow_cover
        for name, value in keywords.items():
            setattr(settings, name, value)
        settings.collection = collection
        for entries, objects in ((settings.surfaces, surfaces), (settings.emitters, emitters), (settings.movers, movers)):
            for obj in objects:
                lists.add_numbered(entries, "Object").object = obj
        if self.lands:
            _let_land(emitters, surfaces, collection)
        build.wire(cover)
        select_only(context, cover)
        self.show_used(settings, KEYWORDS)
        wiring.report_problems(self, context, build.system(), [cover])


def _surfaces(context, names, collection_name):
    """Return (mesh objects, collection or None) that snow is to lie on: those that are named, or else the selected meshes.

    Raises Refused if there are no faces that snow can lie on.
    """
    collection = None
    if collection_name:
        collection = bpy.data.collections.get(collection_name)
        if collection is None:
            raise Refused(tr("There is no collection {collection}").format(collection=collection_name))
    if names:
        found = _listed(names)
        for obj in found:
            _check_surface(obj)
    else:
        found = [] if collection else [obj for obj in context.selected_objects if _has_faces(obj)]
    if not found and not (collection and any(_has_faces(one.object) for one in gathered.meshes(collection))):
        raise Refused(tr("Select the meshes that snow is to lie on"))
    return found, collection


def _has_faces(obj):
    return sources.is_surface(obj) and bool(obj.data.polygons or obj.modifiers)


def _check_surface(obj):
    if not sources.is_surface(obj):
        raise Refused(tr("Snow cannot lie on {object}").format(object=obj.name))
    if not _has_faces(obj):
        raise Refused(tr("{object} has no faces").format(object=obj.name))


def _emitters(context, names):
    if names:
        found = _listed(names)
        for obj in found:
            _check_emitter(obj)
        return found
    found = [obj for obj in context.selected_objects if sources.is_emitter(obj)] or [
        obj for obj in context.scene.objects if sources.is_emitter(obj)
    ]
    if not found:
        raise Refused(tr("It does not snow in this scene: add snow first"))
    return found


def _check_emitter(obj):
    if not sources.is_emitter(obj):
        raise Refused(tr("{object} is no emitter of snow").format(object=obj.name))


def _check_mover(obj):
    if not sources.is_surface(obj):
        raise Refused(tr("{object} cannot leave marks: it is no mesh").format(object=obj.name))


def _let_land(emitters, surfaces, collection):
    """Make surfaces and a collection the colliders of each emitter that has none; linked emitters are left unchanged.

    collection: collection of colliders that the emitters get, or None. surfaces: list of objects.
    """
    for emitter in emitters:
        snow = emitter.motus.snow
        if emitter.library or colliders.are_any(snow):
            continue
        snow.colliders = collection
        snow.collider = surfaces[0] if surfaces else None
        for surface in surfaces[1:]:
            lists.add_numbered(snow.more_colliders, "Collider").object = surface


def cover_for(context, name):
    """Return the snow cover of this name, or the active object if the name is empty.

    Raises Refused if the object is no snow cover, is linked, or is baked.
    """
    found = named(name) if name else context.object
    if found is None or not is_owner(build.system(), found):
        raise Refused(tr("This is no snow cover"))
    check_local(found)
    check_unbaked(found, found.motus.snow_cover)
    return found


class MOTUS_OT_snow_cover_remove(Operator, bpy.types.Operator):
    bl_idname = "motus.snow_cover_remove"
    bl_label = "Remove Snow Cover"
    bl_description = "Take lying snow away; surfaces and falling snow stay"

    object: object_keyword("Name of the snow cover; empty takes the selected ones")

    modes = OBJECT_MODE

    @classmethod
    def check_offer(cls, context):
        cls._found(context, "")

    def run(self, context):
        found = self._found(context, self.object)
        names = ", ".join(cover.name for cover in found)
        for cover in found:
            build.remove(cover)
        self.report({'INFO'}, tr("Removed {objects}").format(objects=names))

    @staticmethod
    def _found(context, name):
        if name:
            return [cover_for(context, name)]
        selected = context.selected_objects or [one for one in [context.object] if one]
        found = [one for one in selected if is_owner(build.system(), one)]
        if not found:
            raise Refused(tr("This is no snow cover"))
        return [cover_for(context, cover.name) for cover in found]


class _OnCover(OfAnObject):
    """Base of operators that change one snow cover: the one that `object` names, or the active object."""

    object: object_keyword(_COVER)
    found = staticmethod(cover_for)


class _InList(_OnCover):
    """Base of operators that add objects to, or remove them from, a cover's list of surfaces, emitters or movers."""

    what: bpy.props.EnumProperty(
        name="List",
        description="List that the objects are added to or removed from",
        items=(
            ('SURFACES', "Surfaces", "Surfaces that snow lies on"),
            ('EMITTERS', "Snow", "Emitters that snow falls from"),
            ('MOVERS', "Marks", "Objects that leave marks"),
        ),
        options={'SKIP_SAVE'},
    )
    for_scripts = ("what",)

    def entries(self, cover):
        """Return the list (collection property) of a cover's settings that the operator changes."""
        return getattr(cover.motus.snow_cover, self.what.lower())


_SUITING = {
    'SURFACES': (sources.is_surface, _check_surface),
    'EMITTERS': (sources.is_emitter, _check_emitter),
    'MOVERS': (sources.is_surface, _check_mover),
}
"""For each list of a cover: whether an object suits it, and the check that refuses other objects."""


class MOTUS_OT_snow_cover_entry_add(_InList, bpy.types.Operator):
    bl_idname = "motus.snow_cover_entry_add"
    bl_label = "Add to Snow Cover"
    bl_description = "Add the objects that are named, or the selected ones, to those that snow lies on, falls from, or shows marks of"

    objects: _names("Objects", "Names of objects, between commas; empty takes the selected ones")

    def run(self, context):
        cover = self.found(context, self.object)
        entries = self.entries(cover)
        known = [pointed(entry, "object") for entry in entries]
        is_wanted, check = _SUITING[self.what]
        if self.objects:
            found = _listed(self.objects)
            for obj in found:
                check(obj)
        else:
            found = [obj for obj in context.selected_objects if is_wanted(obj)]
        found = [obj for obj in found if obj not in known]
        if not found:
            raise Refused(tr("Nothing is selected that is not in the list"))
        for obj in found:
            lists.add_numbered(entries, "Object").object = obj
        build.settle(cover)


class MOTUS_OT_snow_cover_entry_remove(_InList, bpy.types.Operator):
    bl_idname = "motus.snow_cover_entry_remove"
    bl_label = "Remove from Snow Cover"
    bl_description = "Take an object off the list"

    index: bpy.props.IntProperty(
        name="Index", description="Index of the object in the list; -1 for the last one", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    def run(self, context):
        cover = self.found(context, self.object)
        entries = self.entries(cover)
        index = self.index if self.index >= 0 else len(entries) - 1
        if not 0 <= index < len(entries):
            raise Refused(tr("The list has no such object"))
        lists.remove(entries, index)
        wiring.touch(build.system(), cover)
        build.settle(cover)


class MOTUS_OT_snow_cover_work_out(Job, bpy.types.Operator):
    bl_idname = "motus.snow_cover_work_out"
    bl_label = "Calculate Snow"
    bl_description = "Calculate where all flakes land, which takes some time for so many; then every frame is shown at once"

    object: object_keyword(_COVER)

    def begin(self, context):
        self._cover = cover_for(context, self.object).name
        self._plan = work.asked(self._cover)
        if self._plan is None:
            raise Refused(tr("There is nothing to calculate"))
        return work.part_count(self._plan), work.steps(self._cover, self._plan)

    def result(self, context):
        wiring.touch(build.system(), cover_for(context, self._cover))
        found = work.known(self._cover, self._plan)
        if isinstance(found, Problem):
            raise Refused(tr(found.sentence))


classes = (
    MOTUS_OT_snow_cover_add,
    MOTUS_OT_snow_cover_remove,
    MOTUS_OT_snow_cover_entry_add,
    MOTUS_OT_snow_cover_entry_remove,
    MOTUS_OT_snow_cover_work_out,
)
