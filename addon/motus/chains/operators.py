"""Operators that add chains to bones of a rig, objects in a row and points of curves, and remove them."""

import bpy

from ..core import wiring
from ..core.file import libraries
from ..core.interface import bone_entries
from ..core.interface.operators import OBJECT_OR_POSE_MODE, FindsValues, OfARig, named_or_active, object_keyword
from ..core.refusals import Refused, check_finite, check_no_tweak_mode
from ..core.translations import counted, tr
from . import properties, rows, setup, targets, told

KEYWORDS = tuple(properties.ChainsKeywords.__annotations__)


def _bones():
    return bpy.props.StringProperty(
        name="Bones",
        description="Names of the topmost bones of the chains, with commas between; empty takes the selected bones",
        options={'SKIP_SAVE'},
    )


class MOTUS_OT_chains_add(FindsValues, properties.ChainsKeywords, bpy.types.Operator):
    bl_idname = "motus.chains_add"
    bl_label = "Add Chains"
    bl_description = "Let the selected bones and all bones below them hang and swing as chains, or points of a curve, or objects in a row on the active one"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}
    needs_native = True
    redo = rows.ADDING
    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Name of the object; empty takes the active one")
    bones: _bones()
    objects: bpy.props.StringProperty(
        name="Objects",
        description="Names of objects in a row, with commas between, in place of bones: the one that stays, then those that hang on it",
        options={'SKIP_SAVE'},
    )
    spline: bpy.props.IntProperty(
        name="Spline", description="Index of the spline of a curve whose points hang; -1 for all", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    @classmethod
    def check_offer(cls, context):
        targets.wanted(context, "", "", "", -1).check_free()

    def run(self, context):
        found = targets.wanted(context, self.object, self.bones, self.objects, self.spline)
        found.check_free()
        check_finite(self, KEYWORDS)
        owner, names = found.owner, found.names
        setup.add(owner, names, self.given(KEYWORDS), found.rows, found.splines)
        self.show_used(owner.motus.chains.entries[names[0]], KEYWORDS)
        self.report({'INFO'}, counted(len(names), tr("Chain added from {bone}").format(bone=names[0]), tr("{count} chains added")))
        context.view_layer.update()
        depsgraph = context.view_layer.depsgraph
        problem = wiring.problem(setup.system(), owner, depsgraph) if owner.evaluated_get(depsgraph).is_evaluated else None
        if problem:
            self.report({'WARNING'}, told.sentence(owner, problem, context.scene))


class MOTUS_OT_chains_remove(OfARig, bpy.types.Operator):
    bl_idname = "motus.chains_remove"
    bl_label = "Remove Chains"
    bl_description = "Remove chains: in Pose Mode those of the selected bones, else all of the object, or that on which the object hangs"
    rig_with = staticmethod(targets.owner_with)

    object: object_keyword("Name of the object; empty takes the active one")
    bones: _bones()
    only_active: bpy.props.BoolProperty(
        name="Only Active", description="Act on the active entry of the list alone", default=False, options={'SKIP_SAVE', 'HIDDEN'}
    )

    def run(self, context):
        owner = targets.owner_with(context, self.object)
        targets.check_editable(owner)
        check_no_tweak_mode(owner)
        indices = self._indices(context, owner)
        count = libraries.count_from_library(owner, "motus.chains.entries")
        if any(index < count for index in indices):
            raise Refused(
                tr("{object} has these chains from its library, so that they cannot be removed here: mute them").format(object=owner.name)
            )
        setup.remove(owner, indices)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=owner.name))

    def _indices(self, context, owner):
        settings = owner.motus.chains
        if self.only_active:
            return [settings.active_entry] if settings.active_entry >= 0 else []
        names = self._names(context, owner)
        if not names:
            return range(len(settings.entries))
        found = sorted({properties.index_of(settings, name) for name in names} - {-1})
        if not found:
            raise Refused(tr("{object} has no chains").format(object=owner.name))
        return found

    def _names(self, context, owner):
        """Return names of bones or objects whose chains are meant; [] for all of the owner's."""
        if self.bones:
            return [name.strip() for name in self.bones.split(",") if name.strip()]
        obj = named_or_active(context, self.object)
        if obj != owner:
            return [obj.name]
        return [] if self.object else bone_entries.posed(context)


classes = (MOTUS_OT_chains_add, MOTUS_OT_chains_remove)
