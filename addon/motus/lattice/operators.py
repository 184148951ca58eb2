"""Operators that fit a lattice, reset its points, and remove it."""

import bpy

from ..core.interface.operators import OBJECT_MODE, OBJECT_OR_EDIT_MODE, Operator, object_keyword, select_only
from ..core.interface.rows import Row, Rows, is_given
from ..core.refusals import Refused, check_finite, named
from ..core.translations import tr
from . import fitting, pulling, removal, resting, shape_keys, targets
from .properties import FitKeywords

KEYWORDS = tuple(FitKeywords.__annotations__)


class MOTUS_OT_lattice_fit(Operator, FitKeywords, bpy.types.Operator):
    bl_idname = "motus.lattice_fit"
    bl_label = "Fit Lattice"
    bl_description = (
        "Lay a lattice around the selected objects, or the selected vertices in Edit Mode, and let it deform them; the meshes themselves "
        "are not changed"
    )
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    objects: bpy.props.StringProperty(
        name="Objects",
        options={'SKIP_SAVE'},
        description="Names of the objects with commas between, or a collection's name; empty takes the selected objects",
    )
    vertex_group: bpy.props.StringProperty(
        name="Vertex Group", description="Deform only the vertices of the vertex group of this name", options={'SKIP_SAVE'}
    )

    modes = OBJECT_OR_EDIT_MODE
    needs_native = True
    redo = (Rows(KEYWORDS),)

    @classmethod
    def check_offer(cls, context):
        if context.mode != 'EDIT_MESH':
            for obj in _any(targets.objects_for(context, "")):
                targets.check_fittable(obj)

    def run(self, context):
        lattice, objects = self._fit(context)
        select_only(context, lattice)
        self.report(
            {'INFO'}, tr("{lattice} deforms {objects}").format(lattice=lattice.name, objects=", ".join(obj.name for obj in objects))
        )

    def _fit(self, context):
        check_finite(self, ("margin",))
        is_editing = context.mode == 'EDIT_MESH'
        if is_editing and not self.objects:
            vertices = targets.selected_vertices(context)
            objects = list(vertices)
        else:
            objects = targets.objects_for(context, self.objects)
            vertices = targets.group_vertices(objects, self.vertex_group) if self.vertex_group else {}
        for obj in _any(objects):
            targets.check_fittable(obj)
            if vertices:
                targets.check_grouped(obj)
        keywords = {name: getattr(self, name) for name in KEYWORDS}
        if is_editing:
            # Edit Mode's undo steps hold the mesh alone; the whole set-up is to be one undo step.
            bpy.ops.object.mode_set(mode='OBJECT')
        try:
            return fitting.fit(context, objects, vertices, keywords), objects
        except Refused:
            if is_editing:
                bpy.ops.object.mode_set(mode='EDIT')
            raise


def _any(objects):
    if not objects:
        raise Refused(tr("Select a mesh, a curve, a surface, a text or a lattice"))
    return objects


class MOTUS_OT_lattice_remove(Operator, bpy.types.Operator):
    bl_idname = "motus.lattice_remove"
    bl_label = "Remove Lattice"
    bl_description = "Remove fitted lattices: the objects get their shape without a lattice back, or keep the deformation"

    objects: bpy.props.StringProperty(
        name="Objects",
        options={'SKIP_SAVE'},
        description="Names of the objects with commas between, or a collection's name; empty takes the selected objects",
    )
    modifier: bpy.props.StringProperty(
        name="Modifier",
        description="Name of the lattice's modifier; empty takes all lattice modifiers that Motus has added",
        options={'SKIP_SAVE'},
    )
    use_apply: bpy.props.BoolProperty(name="Apply", description="Keep the deformation when the lattice is removed", options={'SKIP_SAVE'})

    modes = OBJECT_MODE
    needs_native = True
    redo = (Rows(("use_apply",)),)

    @classmethod
    def check_offer(cls, context):
        _fitted(context)

    def run(self, context):
        uses = _fitted(context, self.objects, self.modifier)
        removal.check_removable(uses, self.use_apply)
        bent = [obj.name for obj, _ in uses if obj.type in {'CURVE', 'SURFACE'}] if self.use_apply else []
        names = ", ".join(obj.name for obj, _ in uses)
        removal.remove(context, uses, self.use_apply)
        self.report({'INFO'}, tr("{objects} without a lattice").format(objects=names))
        if bent:
            self.report(
                {'WARNING'},
                tr("Of {objects} the control points keep the deformation: what lies between them can look different").format(
                    objects=", ".join(bent)
                ),
            )


def _fitted(context, names="", modifier=""):
    """(object, modifier) for each fitted lattice that the keywords name. Raises Refused if there is none."""
    uses = [use for use in removal.uses_for(targets.objects_for(context, names)) if modifier in {"", use[1]}]
    if not uses:
        raise Refused(tr("Nothing here has a lattice that Motus has fitted"))
    return uses


class MOTUS_OT_lattice_reset(Operator, bpy.types.Operator):
    bl_idname = "motus.lattice_reset"
    bl_label = "Reset Lattice"
    bl_description = "Move the lattice's points back to rest, where they deform nothing"

    object: object_keyword("Name of the lattice; empty takes the active one")
    modes = OBJECT_MODE
    needs_native = True

    def run(self, context):
        lattice = named(self.object) if self.object else context.object
        if lattice is None or lattice.type != 'LATTICE':
            raise Refused(tr("Select a lattice"))
        pulling.check_pullable(lattice)
        removal.reset(lattice)


class _OfALattice(Operator):
    """Base class of operators on a lattice and all that it deforms (shape_keys.uses_of)."""

    object: object_keyword("Name of the object that the lattice deforms, or of the lattice; empty takes the active one")
    modifier: bpy.props.StringProperty(
        name="Modifier", description="Name of the lattice's modifier; empty takes the last lattice modifier", options={'SKIP_SAVE'}
    )

    modes = OBJECT_MODE
    needs_native = True


class MOTUS_OT_lattice_keep(_OfALattice, bpy.types.Operator):
    bl_idname = "motus.lattice_keep"
    bl_label = "Keep as Shape Key"
    bl_description = "Keep the deformation of this frame as a shape key of the mesh, whose value can be keyed; the lattice stays"

    name: bpy.props.StringProperty(name="Name", description="Name of the shape key; empty takes the lattice's name", options={'SKIP_SAVE'})
    use_reset: bpy.props.BoolProperty(
        name="Reset Lattice", description="Move the lattice's points back to rest, and let the shape key take their place", default=True
    )

    redo = (Rows((Row("name", when=is_given("name")), "use_reset")),)

    @classmethod
    def check_offer(cls, context):
        shape_keys.check(*shape_keys.uses_of(context, "", ""))

    def run(self, context):
        lattice, uses = shape_keys.uses_of(context, self.object, self.modifier)
        shape_keys.check(lattice, uses)
        if self.use_reset:
            pulling.check_pullable(lattice)
        keys = shape_keys.keep(context, uses, self.name or lattice.name, 1.0 if self.use_reset else 0.0)
        if self.use_reset:
            removal.reset(lattice)
        self.name = self.name or lattice.name
        names = ", ".join(obj.name for obj, _ in uses)
        self.report({'INFO'}, tr("{objects}: shape key {key}").format(objects=names, key=keys[0].name))


class MOTUS_OT_lattice_rest(_OfALattice, bpy.types.Operator):
    bl_idname = "motus.lattice_rest"
    bl_label = "Take as Rest"
    bl_description = "Let the lattice's points, as they stand, deform nothing: a lattice is shaped by hand around what it is to deform"

    use_regular: bpy.props.BoolProperty(
        name="Regular", description="Take the regular grid as the rest again, and put the points there", options={'SKIP_SAVE'}
    )

    redo = (Rows(("use_regular",)),)

    @classmethod
    def check_offer(cls, context):
        lattice, uses = shape_keys.uses_of(context, "", "")
        pulling.check_pullable(lattice)
        shape_keys.check_meshes(uses)

    def run(self, context):
        lattice, uses = shape_keys.uses_of(context, self.object, self.modifier)
        pulling.check_pullable(lattice)
        shape_keys.check_meshes(uses)
        context.view_layer.update()
        if self.use_regular:
            resting.clear(lattice, uses)
            return
        shape_keys.check_first(uses)
        resting.make(lattice, uses)


classes = (MOTUS_OT_lattice_fit, MOTUS_OT_lattice_remove, MOTUS_OT_lattice_reset, MOTUS_OT_lattice_keep, MOTUS_OT_lattice_rest)
