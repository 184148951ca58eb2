"""Operators that add chains to bones of a rig, and remove them."""

import bpy

from ..core import wiring
from ..core.file import libraries
from ..core.interface import bone_entries
from ..core.interface.operators import FindsValues, OfARig, named_or_active
from ..core.refusals import Refused, check_finite, check_local, check_no_tweak_mode, check_unbaked
from ..core.translations import counted, tr
from . import groups, properties, rows, setup, told

KEYWORDS = tuple(properties.ChainsKeywords.__annotations__)


def rig_with(context, name):
    """Return the rig of this name, or the active object if the name is empty. Raises Refused if it has no chains."""
    rig = named_or_active(context, name)
    if rig.type != 'ARMATURE' or not rig.motus.chains.entries:
        raise Refused(tr("{object} has no chains").format(object=rig.name))
    return rig


def _check_editable(rig):
    check_local(rig)
    check_unbaked(rig, rig.motus.chains)


def _bones():
    return bpy.props.StringProperty(
        name="Bones",
        description="Names of the topmost bones of the chains, with commas between; empty takes the selected bones",
        options={'SKIP_SAVE'},
    )


class MOTUS_OT_chains_add(FindsValues, OfARig, properties.ChainsKeywords, bpy.types.Operator):
    bl_idname = "motus.chains_add"
    bl_label = "Add Chains"
    bl_description = "Let the selected bones, and all bones below them, hang and swing as chains"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}
    needs_native = True
    redo = rows.ADDING
    rig_with = staticmethod(named_or_active)

    bones: _bones()

    @classmethod
    def check_offer(cls, context):
        rig, tops = cls._wanted(context, "", "")
        _check_editable(rig)
        cls._check_free(rig, tops)

    def run(self, context):
        rig, tops = self._wanted(context, self.object, self.bones)
        _check_editable(rig)
        check_finite(self, KEYWORDS)
        self._check_free(rig, tops)
        setup.add(rig, tops, self.given(KEYWORDS))
        self.show_used(rig.motus.chains.entries[tops[0]], KEYWORDS)
        self.report({'INFO'}, counted(len(tops), tr("Chain added from {bone}").format(bone=tops[0]), tr("{count} chains added")))
        context.view_layer.update()
        depsgraph = context.view_layer.depsgraph
        problem = wiring.problem(setup.system(), rig, depsgraph) if rig.evaluated_get(depsgraph).is_evaluated else None
        if problem:
            self.report({'WARNING'}, told.sentence(rig, problem, context.scene))

    @staticmethod
    def _wanted(context, name, bones):
        """Return (rig, names of the topmost bones of its chains). Raises Refused if there is no rig, or no bone is named or selected."""
        rig = named_or_active(context, name)
        if rig.type != 'ARMATURE':
            raise Refused(tr("{object} is not an armature").format(object=rig.name))
        names = bone_entries.names_in(rig, bones) if bones else bone_entries.posed(context) if not name else []
        if not names:
            raise Refused(tr("Select the topmost bones of the chains"))
        chosen = set(names)
        return rig, [one for one in names if chosen.isdisjoint(bone.name for bone in rig.data.bones[one].parent_recursive)]

    @staticmethod
    def _check_free(rig, tops):
        """Raise Refused if bones of the chains are driven by a different system or chain, or move with what they hang on."""
        present = (
            {entry.name for entry in rig.motus.chains.entries if not groups.is_missing(rig, entry)} if rig.is_property_set("motus") else ()
        )
        bones = {top: [bone.name for bone in groups.bones_of(rig, top)] for top in dict.fromkeys((*present, *tops))}
        bone_entries.check_apart(bones)
        for top in tops:
            bone_entries.check_free(rig, bones[top], setup.system())
            parent = rig.pose.bones[top].parent
            if wiring.depends(rig, parent.name if parent else "", rig, bones[top]):
                raise Refused(tr("What {bone} hangs on moves with it").format(bone=top))


class MOTUS_OT_chains_remove(OfARig, bpy.types.Operator):
    bl_idname = "motus.chains_remove"
    bl_label = "Remove Chains"
    bl_description = "Remove chains from bones: from the selected ones in Pose Mode, else all of the rig"
    rig_with = staticmethod(rig_with)

    bones: _bones()
    only_active: bpy.props.BoolProperty(
        name="Only Active", description="Act on the active entry of the list alone", default=False, options={'SKIP_SAVE', 'HIDDEN'}
    )

    def run(self, context):
        rig = rig_with(context, self.object)
        _check_editable(rig)
        check_no_tweak_mode(rig)
        indices = self._indices(context, rig)
        count = libraries.count_from_library(rig, "motus.chains.entries")
        if any(index < count for index in indices):
            raise Refused(
                tr("{object} has these chains from its library, so that they cannot be removed here: mute them").format(object=rig.name)
            )
        setup.remove(rig, indices)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=rig.name))

    def _indices(self, context, rig):
        settings = rig.motus.chains
        if self.only_active:
            return [settings.active_entry] if settings.active_entry >= 0 else []
        names = (
            [name.strip() for name in self.bones.split(",") if name.strip()]
            if self.bones
            else []
            if self.object
            else bone_entries.posed(context)
        )
        if not names:
            return range(len(settings.entries))
        found = sorted({properties.index_of_bone(settings, name) for name in names} - {-1})
        if not found:
            raise Refused(tr("{object} has no chains").format(object=rig.name))
        return found


classes = (MOTUS_OT_chains_add, MOTUS_OT_chains_remove)
