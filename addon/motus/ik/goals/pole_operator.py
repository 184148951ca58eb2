"""Operator motus.ik_pole_angle: finds the Pole Angle that a chain needs for the pose in which it stands."""

import bpy

from ...core.file.pointers import pointed
from ...core.refusals import Refused, check_evaluated
from ...core.translations import tr
from .. import setup, status, targets
from ..operators import OfABone
from . import placing

LARGEST_MISS = 1e-4  # sine of half the angle by which the first bone may miss its pose


class MOTUS_OT_ik_pole_angle(OfABone, bpy.types.Operator):
    bl_idname = "motus.ik_pole_angle"
    bl_label = "Pole Angle from Pose"
    bl_description = (
        "Set Pole Angle so that the chain bends as it does without its pole. "
        "With another object or bone selected, that becomes the pole, and the chain stays as it is"
    )

    pole: bpy.props.StringProperty(
        name="Pole",
        description="Name of an object that becomes the pole; empty takes what is selected along with the bone, or else the present pole",
        options={'SKIP_SAVE'},
    )
    pole_bone: bpy.props.StringProperty(name="Pole Bone", description="Name of a bone of the pole", options={'SKIP_SAVE'})

    def run(self, context):
        rig = targets.rig_with_ik(context, self.object)
        targets.check_editable(rig)
        entry = rig.motus.ik.entries[targets.entry_for(rig, self.bone)]
        name = entry.name
        if status.is_unwired(rig, entry):
            raise Refused(status.sentence(context, rig, entry)[1])
        before = (pointed(entry, "pole"), entry.pole_bone)
        pole = targets.goal_for(context, self.pole, self.pole_bone, None if self.object or self.bone else rig) or before
        if pole[0] is None:
            raise Refused(tr("{bone} has no pole: choose one").format(bone=name))
        targets.check_no_loop(rig, name, {"pole": pole[0], "pole_bone": pole[1]}, pole)
        check_evaluated(rig, context.view_layer)
        context.view_layer.update()
        place = placing.goal_matrix(context, *pole)
        entry = rig.motus.ik.entries[name]
        found = place and placing.pole_angle(rig, entry, context.view_layer.depsgraph, tuple(place.translation), pole != before)
        if not found or found[0] > LARGEST_MISS:
            raise Refused(tr("No pole angle gives {bone} this pose: move {pole}").format(bone=name, pole=pole[0].name))
        with setup.at_once(rig):
            entry = rig.motus.ik.entries[name]
            entry.pole, entry.pole_bone = pole
            entry.pole_angle = found[1]


classes = (MOTUS_OT_ik_pole_angle,)
