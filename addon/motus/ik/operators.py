"""Operators that add inverse kinematics to chains of bones, give chains targets and poles, and remove chains."""

from collections.abc import Sequence

import bpy

from ..core.file.pointers import pointed
from ..core.interface import bone_entries, operators
from ..core.interface.rows import Rows
from ..core.refusals import Refused, check_evaluated, check_finite, check_no_tweak_mode
from ..core.settings import lists
from ..core.translations import tr
from . import chains, rows, setup, status, targets
from .goals import control_bones, made, placing
from .properties import KEYWORDS, IkKeywords
from .switching import blend_keys, blend_trigger

MOST_SHOWN = 8
"""Largest number of targets and poles that a dialog lists by name before they are deleted."""
MADE_WIDTH = 320
"""Width of the dialog that lists targets and poles before they are deleted, in pixels at a resolution scale of 1."""


class OfARig(operators.OfARig):
    """Mixin of operators that work on an armature object on which inverse kinematics is set up."""

    rig_with = staticmethod(targets.rig_with_ik)


class OfABone(OfARig):
    """Mixin of operators that work on one chain of a rig, named by the chain's last bone."""

    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the last bone of the chain; empty takes the active one", options={'SKIP_SAVE'}
    )


class MOTUS_OT_ik_add(operators.FindsValues, OfABone, IkKeywords, bpy.types.Operator):
    bl_idname = "motus.ik_add"
    bl_label = "Inverse Kinematics"
    bl_description = "Let a chain of bones reach for a target"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    bones: bpy.props.StringProperty(
        name="Bones",
        description="Names of the last bones of several chains, with commas between: all are added at once",
        options={'SKIP_SAVE'},
    )
    target: bpy.props.StringProperty(
        name="Target",
        description="Name of the object that the chain reaches for; empty takes what is selected along "
        "with the bone, and else makes an empty at the end of the chain",
        options={'SKIP_SAVE'},
    )
    target_bone: bpy.props.StringProperty(name="Target Bone", description="Name of a bone of the target", options={'SKIP_SAVE'})
    pole: bpy.props.StringProperty(name="Pole", description="Name of the object that the chain bends towards", options={'SKIP_SAVE'})
    pole_bone: bpy.props.StringProperty(name="Pole Bone", description="Name of a bone of the pole", options={'SKIP_SAVE'})
    make_pole: bpy.props.BoolProperty(
        name="Make a Pole", description="Make an empty at the side that the chain bends to", default=False, options={'SKIP_SAVE'}
    )
    keep_rotation: bpy.props.BoolProperty(
        name="Keep Rotation",
        description="Set the rotation offset so that the bone keeps its present rotation",
        default=True,
        options={'SKIP_SAVE'},
    )
    make_control_bone: bpy.props.BoolProperty(
        name="New Control Bone",
        description="Make a bone of the armature itself the target, which stands at the end of the "
        "chain, has no parent and deforms nothing; a pole that is made is such a bone too",
        default=False,
        options={'SKIP_SAVE'},
    )

    redo = rows.ADDING
    for_scripts = ("hinge_angle", "target_blend", "is_muted")

    @classmethod
    def check_offer(cls, context):
        rig = targets.rig_for(context, "")
        targets.bone_for(context, rig, "")
        targets.check_editable(rig)

    def run(self, context):
        rig = targets.rig_for(context, self.object)
        targets.check_editable(rig)
        bones = bone_entries.names_in(rig, self.bones) or [targets.bone_for(context, rig, self.bone)]
        bone_entries.check_apart({bone: self._chain(rig, bone).driven for bone in bones})
        for bone in bones:
            self._add(context, rig, bone)
        added = [rig.motus.ik.entries[bone] for bone in bones]
        self.show_used(added[0], KEYWORDS)
        self.report({'INFO'}, status.added(added[0]) if len(added) == 1 else tr("IK added to {count} bones").format(count=len(added)))
        context.view_layer.update()
        for entry in added:
            chain = targets.chain_for(rig, entry.name, entry.chain_length, entry.use_tail)
            for sentence in targets.warnings(rig, chain, entry.chain_length) + status.warnings(context, rig, entry):
                self.report({'WARNING'}, sentence)

    def _chain(self, rig, bone):
        """Chain that the operator gives a bone. Raises Refused if Motus drives one of the chain's bones already."""
        changes, before = self.given(KEYWORDS), rig.motus.ik.entries.get(bone)
        chain = targets.chain_for(rig, bone, *(changes.get(name, getattr(before or self, name)) for name in ("chain_length", "use_tail")))
        targets.check_free(rig, chain)
        return chain

    def _add(self, context, rig, bone):
        """Add the entry of a bone, or change it: settings, target and pole, which are made if necessary."""
        changes = self.given(KEYWORDS)
        check_finite(self, changes)
        before = rig.motus.ik.entries.get(bone)
        chain = self._chain(rig, bone)
        target, pole = self._goals(context, rig, before)
        if self.make_control_bone:
            control_bones.check(context, rig)
            target = None
        wanted = {name: changes[name] for name in ("chain_length", "use_tail") if name in changes}
        for goal, name in ((target, "target"), (pole, "pole")):
            wanted[name], wanted[name + "_bone"] = goal or (None, "")
            targets.check_no_loop(rig, bone, wanted, goal)
        context.view_layer.update()
        evaluated = rig.evaluated_get(context.view_layer.depsgraph)
        if before is None and "hinge_angle" not in changes:
            place = pole and placing.goal_matrix(context, *pole).translation
            changes["hinge_angle"] = placing.hinge_angle(rig, evaluated, chain, place)
        if self.make_control_bone:
            target = rig, control_bones.new_target(context, rig, chain)
            evaluated = rig.evaluated_get(context.view_layer.depsgraph)
            before = rig.motus.ik.entries.get(bone)
        if target and self._keeps_rotation(changes) and target != (before and (pointed(before, "target"), before.target_bone)):
            changes["rotation_offset"] = placing.rotation_offset(context, evaluated, chain, *target)
        if target is None:
            target = (placing.new_target(context, evaluated, chain), "")
        changes["target"], changes["target_bone"] = target
        changes["pole"], changes["pole_bone"] = pole or (None, "")
        turned = before.pole_angle if before else 0.0
        with setup.at_once(rig):
            setup.add(rig, bone, changes)
        if self.make_pole and pole is None:
            _make_pole(context, rig, bone, turned, self.make_control_bone)

    def _keeps_rotation(self, changes):
        return self.keep_rotation and "rotation_offset" not in changes

    def _goals(self, context, rig, before):
        """(target, pole) for an entry, each (object, bone or "") or None.

        The keywords name them. If the keywords are empty, the target is what is selected. Otherwise the present entry `before` has them.
        """
        from_selection = None if self.object or self.bone or self.bones else rig
        target = targets.goal_for(context, self.target, self.target_bone, from_selection)
        if target is None and before and pointed(before, "target"):
            target = pointed(before, "target"), before.target_bone
        pole = targets.goal_for(context, self.pole, self.pole_bone)
        if pole is None and before and pointed(before, "pole") and not self.is_given("pole"):
            pole = pointed(before, "pole"), before.pole_bone
        return target, pole


def _make_pole(context, rig, name, turned, as_bone):
    """Make a pole for the entry of a name, at a place that leaves the pose of the chain as it is.

    turned: Pole Angle, in radians, by which the present pose is turned. as_bone: make a control bone instead of an empty.
    """
    context.view_layer.update()
    entry = rig.motus.ik.entries[name]
    if as_bone:
        place = placing.pole_place(rig, entry, context.view_layer.depsgraph, turned)
        goal = rig, control_bones.new_pole(context, rig, chains.find(rig, entry), place)
    else:
        goal = placing.new_pole(context, rig, entry, turned), ""
    with setup.at_once(rig):
        entry = rig.motus.ik.entries[name]
        entry.pole, entry.pole_bone = goal


class MOTUS_OT_ik_pole_add(OfABone, bpy.types.Operator):
    bl_idname = "motus.ik_pole_add"
    bl_label = "Make Pole"
    bl_description = "Give the chain a pole at the side that it bends to; nothing moves by that"

    as_bone: bpy.props.BoolProperty(
        name="As Bone", description="Make a control bone of the armature instead of an empty", default=False, options={'SKIP_SAVE'}
    )
    redo = (Rows(("as_bone",)),)

    def run(self, context):
        rig = targets.rig_with_ik(context, self.object)
        targets.check_editable(rig)
        entry = rig.motus.ik.entries[targets.entry_for(rig, self.bone)]
        pole = pointed(entry, "pole")
        if pole:
            raise Refused(tr("{bone} has a pole already: {pole}").format(bone=entry.name, pole=pole.name))
        if self.as_bone:
            control_bones.check(context, rig)
        check_evaluated(rig, context.view_layer)
        _make_pole(context, rig, entry.name, entry.pole_angle, self.as_bone)


class MOTUS_OT_ik_control_bone_add(OfABone, bpy.types.Operator):
    bl_idname = "motus.ik_control_bone_add"
    bl_label = "New Control Bone"
    bl_description = "Make a bone of the armature itself the target, which stands where the target is, has no parent and deforms nothing"

    def run(self, context):
        rig = targets.rig_with_ik(context, self.object)
        targets.check_editable(rig)
        control_bones.check(context, rig)
        entry = rig.motus.ik.entries[targets.entry_for(rig, self.bone)]
        name, chain = entry.name, chains.find(rig, entry)
        if chain is None:
            raise Refused(tr("{object} has no bone {bone}").format(object=rig.name, bone=name))
        context.view_layer.update()
        place = targets.goal_place(context, entry)
        made = control_bones.new_target(context, rig, chain, place)
        with setup.at_once(rig):
            entry = rig.motus.ik.entries[name]
            entry.target, entry.target_bone = rig, made
        self.report({'INFO'}, status.added(entry))


class MOTUS_OT_ik_remove(OfABone, bpy.types.Operator):
    bl_idname = "motus.ik_remove"
    bl_label = "Remove Inverse Kinematics"
    bl_description = "Remove Inverse Kinematics, so that the chains have their own animation again"

    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the last bone of the chain; empty takes all chains of the object", options={'SKIP_SAVE'}
    )
    remove_controls: bpy.props.BoolProperty(
        name="Remove Controls",
        description="Delete the targets and poles too that were made along with the chains",
        default=False,
        options={'SKIP_SAVE'},
    )
    redo = (Rows(("remove_controls",)),)

    _made: Sequence[str] = ()

    def invoke(self, context, event):
        """Ask in a dialog whether to delete the targets and poles that were made along with the chains; without any, run at once."""
        try:
            self._made = [made.label(*pair) for pair in made.of_entries(*self._found(context))]
        except Refused as refusal:
            return self.refuse(refusal)
        if not self._made or context.window is None or self.is_given("remove_controls"):
            return self.execute(context)
        self.remove_controls = True
        return context.window_manager.invoke_props_dialog(self, width=MADE_WIDTH)

    def draw_below(self, _context):
        column = self.layout.column(align=True)
        column.active = self.remove_controls
        for name in self._made[:MOST_SHOWN]:
            column.label(text=name, icon='EMPTY_AXIS', translate=False)
        if len(self._made) > MOST_SHOWN:
            column.label(text=tr("and {count} more").format(count=len(self._made) - MOST_SHOWN), translate=False)

    def run(self, context):
        rig, indices = self._found(context)
        names = [rig.motus.ik.entries[index].name for index in indices]
        controls = made.of_entries(rig, indices) if self.remove_controls else []
        if any(bone for _, bone in controls):
            control_bones.check(context, rig)
        setup.remove(rig, indices)
        kept = made.remove_unneeded(context, rig, controls)
        self.report({'INFO'}, tr("Removed from {objects}").format(objects=", ".join(names)))
        if kept:
            self.report({'INFO'}, tr("Something else needs {targets}, so that they stay").format(targets=", ".join(kept)))

    def _found(self, context):
        """(rig, indices of the entries that the operator removes). Raises Refused if they cannot be removed."""
        rig = targets.rig_with_ik(context, self.object)
        targets.check_editable(rig)
        indices = [targets.entry_for(rig, self.bone)] if self.bone else range(len(rig.motus.ik.entries))
        targets.check_removable(rig, indices)
        check_no_tweak_mode(rig)
        return rig, indices


class MOTUS_OT_ik_target_add(OfABone, bpy.types.Operator):
    bl_idname = "motus.ik_target_add"
    bl_label = "Add Target"
    bl_description = "Give the chain a further target, which Blend passes to"

    target: bpy.props.StringProperty(
        name="Target", description="Name of the object; empty takes what is selected along with the bone", options={'SKIP_SAVE'}
    )
    target_bone: bpy.props.StringProperty(name="Target Bone", description="Name of a bone of the target", options={'SKIP_SAVE'})

    def run(self, context):
        rig = targets.rig_with_ik(context, self.object)
        targets.check_editable(rig)
        entry = rig.motus.ik.entries[targets.entry_for(rig, self.bone)]
        goal = targets.goal_for(context, self.target, self.target_bone, rig)
        if goal:
            changes = {"target": goal[0], "target_bone": goal[1]}
            targets.check_no_loop(rig, entry.name, changes, goal)
        with setup.at_once(rig):
            extra = lists.add_numbered(entry.extra_targets, "Target")
            if goal:  # otherwise the user chooses the target in the list
                extra.object, extra.bone = goal
            entry.active_extra_target = len(entry.extra_targets) - 1


class MOTUS_OT_ik_target_remove(OfABone, bpy.types.Operator):
    bl_idname = "motus.ik_target_remove"
    bl_label = "Remove Target"
    bl_description = "Take a further target off the chain"

    index: bpy.props.IntProperty(
        name="Index", description="Index of the further target; -1 is the active one", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    def run(self, context):
        rig = targets.rig_with_ik(context, self.object)
        targets.check_editable(rig)
        entry = rig.motus.ik.entries[targets.entry_for(rig, self.bone)]
        index = entry.active_extra_target if self.index < 0 else self.index
        if not 0 <= index < len(entry.extra_targets):
            raise Refused(tr("There is no such target"))
        lists.check_own(entry.extra_targets, [index])
        check_no_tweak_mode(rig)
        with setup.at_once(rig):
            blend_keys.take_out(rig, entry, index + 1)
            blend_trigger.take_out(rig, entry, index + 1)
            lists.remove(entry.extra_targets, index)
            entry.active_extra_target = max(0, min(entry.active_extra_target, len(entry.extra_targets) - 1))


classes = (
    MOTUS_OT_ik_add,
    MOTUS_OT_ik_pole_add,
    MOTUS_OT_ik_control_bone_add,
    MOTUS_OT_ik_remove,
    MOTUS_OT_ik_target_add,
    MOTUS_OT_ik_target_remove,
)
