"""Targets and poles whose bones are given other names, on the rig itself and on others."""

import bpy
import support
from ik_cases import ARM, REACHABLE, IkTestCase, add_bone, add_chain
from mathutils import Vector

POLE = (0.6, -1.0, 1.0)


class Renaming(IkTestCase):
    def rig_with_controls(self, name="Rig", arms=1):
        def build(bones):
            for index in range(arms):
                shift = Vector((0.0, 3.0 * index, 0.0))
                add_chain(bones, f"Arm {index}", [shift + Vector(joint) for joint in ARM])
                add_bone(bones, f"Goal {index}", shift + Vector(REACHABLE), shift + Vector((0.6, 0.3, 1.6)))
                add_bone(bones, f"Side {index}", shift + Vector(POLE), shift + Vector((0.6, -1.0, 1.2)))
        return self.rig(build, name)

    def rename(self, rig, names):
        for old, new in names.items():
            rig.data.bones[old].name = new
        bpy.context.view_layer.update()

    def assertFollows(self, rig, bone, controls, goal):
        for shift in ((0.1, -0.2, 0.05), (-0.1, 0.1, 0.0)):
            controls.pose.bones[goal].location = shift
            self.assertNear(self.tail(rig, bone), self.head(controls, goal))

    def test_controls_of_the_rig_itself(self):
        """Few members have an outbox on their owner, many a hub."""
        for arms in (1, 15):
            with self.subTest(arms=arms):
                support.empty_scene()
                self.setUp()
                rig = self.rig_with_controls(arms=arms)
                for index in range(arms):
                    entry = self.reach(f"Arm {index} 1", target="Rig", target_bone=f"Goal {index}", pole="Rig",
                                       pole_bone=f"Side {index}")
                self.rename(rig, {"Goal 0": "Hand\"IK", "Side 0": "Elbow"})
                entry = rig.motus.ik.entries[0]
                self.assertEqual((entry.target_bone, entry.pole_bone), ("Hand\"IK", "Elbow"))
                self.assertFollows(rig, "Arm 0 1", rig, "Hand\"IK")
                if arms > 1:
                    self.assertEqual(rig.motus.ik.entries[1].target_bone, "Goal 1")
                    self.assertFollows(rig, "Arm 1 1", rig, "Goal 1")

    def test_controls_of_another_rig(self):
        rig, other = self.rig_with_controls(), self.rig_with_controls("Other")
        entry = self.reach("Arm 0 1", target="Other", target_bone="Goal 0", pole="Other", pole_bone="Side 0")
        extra = entry.extra_targets.add()
        extra.object, extra.bone = other, "Arm 0 0"
        self.evaluated(rig)
        self.rename(other, {"Goal 0": "Grip", "Side 0": "Elbow", "Arm 0 0": "Upper"})
        self.assertEqual((entry.target_bone, entry.pole_bone, extra.bone), ("Grip", "Elbow", "Upper"))
        self.assertFollows(rig, "Arm 0 1", other, "Grip")

    def test_renamed_in_edit_mode(self):
        rig = self.rig_with_controls()
        entry = self.reach("Arm 0 1", target="Rig", target_bone="Goal 0")
        self.evaluated(rig)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones["Goal 0"].name = "Grip"
        rig.data.edit_bones["Arm 0 1"].name = "Forearm"
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.context.view_layer.update()
        self.assertEqual((entry.name, entry.target_bone), ("Forearm", "Grip"))
        self.assertFollows(rig, "Forearm", rig, "Grip")

    def test_a_bone_of_the_old_name_is_not_followed(self):
        """Another bone took the name at once: what was meant cannot be told, and the chain stays where it went."""
        rig = self.rig_with_controls()
        entry = self.reach("Arm 0 1", target="Rig", target_bone="Goal 0")
        self.evaluated(rig)
        rig.data.bones["Goal 0"].name = "Grip"
        rig.data.bones["Side 0"].name = "Goal 0"
        bpy.context.view_layer.update()
        self.assertEqual(entry.target_bone, "Goal 0")
        self.evaluated(rig)

    def test_target_of_a_look(self):
        rig, other = self.rig_with_controls(), self.rig_with_controls("Other")
        self.assertEqual(bpy.ops.motus.look_at_add(
            object="Rig", bone="Arm 0 1", target="Other", target_bone="Goal 0", body_length=0, eyes=""), {'FINISHED'})
        self.evaluated(rig)
        self.rename(other, {"Goal 0": "Lamp"})
        self.assertEqual(rig.motus.look_at.entries[0].target_bone, "Lamp")
