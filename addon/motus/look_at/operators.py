"""Operators that add, change and remove Look At on the head bones of a rig."""

import functools

import bpy

from ..core import wiring
from ..core.file.pointers import pointed
from ..core.interface import bone_entries, operators
from ..core.measures.axes import AXES, LABELS
from ..core.refusals import Refused, check_bone, check_finite, check_no_tweak_mode
from ..core.translations import tr
from . import anatomy, facing, names, rows, setup, targets
from .groups import driven_bones
from .properties import ANY_BODY_LENGTH, KEYWORDS, LookAtKeywords


class OfARig(operators.OfARig):
    """Mixin of operators that work on an armature object on which Look At is set up."""

    rig_with = staticmethod(targets.looking_rig)


class OfAHead(OfARig):
    """Mixin of operators that work on one head of a rig, named by its bone."""

    bone: bpy.props.StringProperty(name="Head", description="Name of the head bone; empty takes the active one", options={'SKIP_SAVE'})

    def head(self, context):
        """(rig, entry of the head) that the keywords name. Raises Refused if there is none, or if the rig cannot be edited."""
        rig = targets.looking_rig(context, self.object)
        targets.check_editable(rig)
        return rig, rig.motus.look_at.entries[targets.entry_for(context, rig, self.bone)]


class MOTUS_OT_look_at_add(operators.FindsValues, OfARig, LookAtKeywords, bpy.types.Operator):
    bl_idname = "motus.look_at_add"
    bl_label = "Look At"
    bl_description = "Let head, spine and eyes turn to a target"
    bl_options = {'REGISTER', 'UNDO', 'PRESET'}

    bone: bpy.props.StringProperty(
        name="Head", description="Name of the head bone; empty takes the active one, or the one that is called head", options={'SKIP_SAVE'}
    )
    bones: bpy.props.StringProperty(
        name="Heads", description="Names of several head bones, with commas between: all are added at once", options={'SKIP_SAVE'}
    )
    target: bpy.props.StringProperty(
        name="Target", description="Name of the object to look at; empty makes one in front of the head", options={'SKIP_SAVE'}
    )
    target_bone: bpy.props.StringProperty(
        name="Target Bone", description="Name of the target's bone to look at, where the target is an armature", options={'SKIP_SAVE'}
    )
    body_length: bpy.props.IntProperty(
        name="Spine Bones",
        description="How many bones below the head turn along, the neck among them; -1 finds the spine",
        default=ANY_BODY_LENGTH,
        min=ANY_BODY_LENGTH,
        max=255,
        options={'SKIP_SAVE'},
    )
    eyes: bpy.props.StringProperty(
        name="Eyes",
        description="Names of the eye bones with commas between; not given, bones below the head called eye",
        options={'SKIP_SAVE'},
    )

    forward: bpy.props.EnumProperty(
        name="Forward",
        description="Axis of the rig that points where the character faces at rest; not given, eyes, face, feet and sides of the skeleton show it",
        items=AXES,
        default=facing.FORWARD,
        options={'SKIP_SAVE'},
    )
    up: bpy.props.EnumProperty(
        name="Up",
        description="Axis of the rig that points from the feet to the head at rest; not given, the skeleton shows it",
        items=AXES,
        default=facing.UP,
        options={'SKIP_SAVE'},
    )

    redo = rows.ALL

    @classmethod
    def check_offer(cls, context):
        rig = targets.rig_for(context, "")
        targets.head_for(context, rig, "")
        targets.check_editable(rig)

    def run(self, context):
        rig = targets.rig_for(context, self.object)
        targets.check_editable(rig)
        heads = bone_entries.names_in(rig, self.bones) or [targets.head_for(context, rig, self.bone)]
        found, driven = {}, {}
        for head in heads:
            *found[head], driven[head] = self._changes(context, rig, head, set(heads).union(*driven.values()))
        bone_entries.check_apart(driven)
        for head, (changes, eyes) in found.items():
            self._add(context, rig, head, changes, eyes)
        entries = rig.motus.look_at.entries
        self.show_used(entries[heads[0]], (*KEYWORDS, "body_length"))
        for head in heads:
            self.report(
                {'INFO'}, tr("{head} of {object} looks at {target}").format(head=head, object=rig.name, target=entries[head].target.name)
            )
        wiring.report_problems(self, context, setup.system(), [rig])

    def _changes(self, context, rig, head, taken):
        """(new settings by name, names of the eyes, names of all turned bones) of a head. Raises Refused if the settings cannot work.

        The names of the eyes are None if the eyes of the head's present entry are kept.
        taken: names of bones that the spine must leave out, since different heads turn them.
        """
        changes = self.given(KEYWORDS)
        check_finite(self, changes)
        before = rig.motus.look_at.entries.get(head)
        if before is None:
            changes.update(facing.find(rig, head, changes))
        eyes = self._eyes(rig, head, before)
        length = (
            before.body_length
            if before and not self.is_given("body_length")
            else targets.spine_for(
                rig,
                head,
                self.body_length if self.is_given("body_length") else ANY_BODY_LENGTH,
                changes.get("up", before and before.up),
                taken,
            )
        )
        target = targets.target_for(context, self, rig)
        targets.check_target(target or (before and pointed(before, "target")), self.target_bone)
        target_bone = self.target_bone
        if target is None and before and pointed(before, "target"):
            target = pointed(before, "target")
            target_bone = self.target_bone if self.is_given("target_bone") else before.target_bone
        present_eyes = [eye.name for eye in before.eyes] if eyes is None else eyes
        driven = [*anatomy.below(rig, head, length), head, *present_eyes]
        targets.check_free(rig, head, driven)
        targets.check_loop(rig, head, driven, target, target_bone)
        changes.update(target=target, target_bone=target_bone, body_length=length)
        return changes, eyes, driven

    def _add(self, context, rig, head, changes, eyes):
        before = rig.motus.look_at.entries.get(head)
        replaced = before and pointed(before, "target")
        entry = setup.add(rig, head, changes, eyes, functools.partial(setup.new_target, context))
        if replaced and replaced != entry.target:
            setup.remove_unneeded(replaced)

    def _eyes(self, rig, head, before):
        """Names of the eye bones: those given to the operator, or those found below a new head; None to keep the eyes of the entry.

        before: the head's entry before the operator ran, None for a new head. Raises Refused if a given eye does not fit.
        """
        if self.is_given("eyes"):
            eyes = [name.strip() for name in self.eyes.split(",") if name.strip()]
            targets.check_eyes(rig, head, eyes)
            return eyes
        return None if before else names.eyes_of(rig.data.bones, head)


class MOTUS_OT_look_at_remove(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_remove"
    bl_label = "Remove Look At"
    bl_description = (
        "Remove Look At, so that the head has its own animation again; a target that was made goes along if nothing else needs it"
    )

    def run(self, context):
        rig = targets.looking_rig(context, self.object)
        targets.check_editable(rig)
        index = targets.entry_for(context, rig, self.bone)
        targets.check_removable(rig, index)
        check_no_tweak_mode(rig)
        head = rig.motus.look_at.entries[index].name
        setup.remove(rig, index)
        self.report({'INFO'}, tr("{bone} of {object} looks at nothing").format(bone=head, object=rig.name))


class MOTUS_OT_look_at_turn(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_turn"
    bl_label = "Turn Forward"
    bl_description = "Turn the direction in which the character faces at rest by a quarter, about Up; a new target goes along"

    def run(self, context):
        rig, entry = self.head(context)
        setup.turn(rig, entry)
        self.report({'INFO'}, tr("{bone} of {object} faces {axis}").format(bone=entry.name, object=rig.name, axis=LABELS[entry.forward]))


class MOTUS_OT_look_at_eye_add(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_eye_add"
    bl_label = "Add Eye"
    bl_description = "Let another bone below the head turn as an eye"

    eye: bpy.props.StringProperty(
        name="Eye", description="Name of the eye bone; empty takes the selected bones below the head", options={'SKIP_SAVE'}
    )

    def run(self, context):
        change_eyes(self, context, self._added)

    def _added(self, context, rig, entry, eyes):
        if self.eye:
            return [*eyes, self.eye]
        below = rig.data.bones[entry.name].children_recursive if entry.name in rig.data.bones else ()
        chosen = {bone.name for bone in context.selected_pose_bones or ()} - set(eyes)
        found = [bone.name for bone in below if bone.name in chosen]
        if not found:
            raise Refused(tr("Select the bones of the eyes in Pose Mode"))
        return [*eyes, *found]


class MOTUS_OT_look_at_eye_remove(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_eye_remove"
    bl_label = "Remove Eye"
    bl_description = "Leave an eye to its own animation again"

    eye: bpy.props.StringProperty(name="Eye", description="Name of the eye bone", options={'SKIP_SAVE'})

    def run(self, context):
        change_eyes(self, context, self._removed)

    def _removed(self, _context, _rig, entry, eyes):
        if self.eye not in eyes:
            raise Refused(tr("{bone} is no eye of {head}").format(bone=self.eye, head=entry.name))
        return [eye for eye in eyes if eye != self.eye]


class MOTUS_OT_look_at_lid_add(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_lid_add"
    bl_label = "Add Eyelid"
    bl_description = "Let a bone below the head shut as an eyelid when the head blinks"

    lid: bpy.props.StringProperty(
        name="Eyelid",
        description="Name of the eyelid's bone; empty takes the selected bones below the head, or else those that are called lid",
        options={'SKIP_SAVE'},
    )

    def run(self, context):
        rig, entry = self.head(context)
        check_bone(rig, entry.name)
        lids = [self.lid] if self.lid else self._found(context, rig, entry)
        targets.check_lids(rig, entry, lids)
        setup.add_lids(rig, entry, lids)

    @staticmethod
    def _found(context, rig, entry):
        used = {lid.name for lid in entry.lids} | set(driven_bones(rig, entry))
        chosen = {bone.name for bone in context.selected_pose_bones or () if bone.id_data == rig}
        below = [bone.name for bone in rig.data.bones[entry.name].children_recursive if bone.name not in used]
        called = names.lids_of(rig.data.bones, entry.name)
        found = [name for name in below if name in chosen] or [name for name in below if name in called]
        if not found:
            raise Refused(tr("Select the bones of the eyelids in Pose Mode"))
        return found


class MOTUS_OT_look_at_lid_remove(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_lid_remove"
    bl_label = "Remove Eyelid"
    bl_description = "Leave an eyelid to its own animation again"

    lid: bpy.props.StringProperty(name="Eyelid", description="Name of the eyelid's bone", options={'SKIP_SAVE'})

    def run(self, context):
        rig, entry = self.head(context)
        if self.lid not in entry.lids:
            raise Refused(tr("{bone} is no eyelid of {head}").format(bone=self.lid, head=entry.name))
        setup.remove_lid(rig, entry, self.lid)


class MOTUS_OT_look_at_target_add(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_target_add"
    bl_label = "Add Further Target"
    bl_description = "Give the head a further target, between which and the others it looks by their weights"

    target: bpy.props.StringProperty(
        name="Target", description="Name of the object; empty takes what is selected along with the rig", options={'SKIP_SAVE'}
    )
    target_bone: bpy.props.StringProperty(name="Target Bone", description="Name of a bone of the target", options={'SKIP_SAVE'})

    def run(self, context):
        rig, entry = self.head(context)
        target = targets.target_for(context, self, rig)
        targets.check_target(target, self.target_bone)
        targets.check_loop(rig, entry.name, driven_bones(rig, entry), target, self.target_bone)
        setup.add_target(rig, entry, target, self.target_bone)


class MOTUS_OT_look_at_target_remove(OfAHead, bpy.types.Operator):
    bl_idname = "motus.look_at_target_remove"
    bl_label = "Remove Further Target"
    bl_description = "Take a further target off the head"

    index: bpy.props.IntProperty(
        name="Index", description="Index of the further target; -1 is the active one", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    def run(self, context):
        rig = targets.looking_rig(context, self.object)
        targets.check_editable(rig)
        place = targets.entry_for(context, rig, self.bone)
        entry = rig.motus.look_at.entries[place]
        index = entry.active_extra_target if self.index < 0 else self.index
        if not 0 <= index < len(entry.extra_targets):
            raise Refused(tr("There is no such target"))
        check_no_tweak_mode(rig)
        setup.remove_target(rig, place, index)


def change_eyes(operator, context, change):
    """Replace the eyes of an entry by the list of names that `change` returns. Raises Refused if a new eye does not fit.

    operator: its keywords object and bone name the head. change(context, rig, entry, eyes): called with the present names.
    """
    rig, entry = operator.head(context)
    head, before = entry.name, [eye.name for eye in entry.eyes]
    wanted = change(context, rig, entry, before)
    added = [eye for eye in wanted if eye not in before]
    if added:
        check_bone(rig, head)
        targets.check_eyes(rig, head, wanted)
        targets.check_free(rig, head, added)
    setup.add(rig, head, {}, wanted)


classes = (
    MOTUS_OT_look_at_add,
    MOTUS_OT_look_at_remove,
    MOTUS_OT_look_at_turn,
    MOTUS_OT_look_at_eye_add,
    MOTUS_OT_look_at_eye_remove,
    MOTUS_OT_look_at_lid_add,
    MOTUS_OT_look_at_lid_remove,
    MOTUS_OT_look_at_target_add,
    MOTUS_OT_look_at_target_remove,
)
