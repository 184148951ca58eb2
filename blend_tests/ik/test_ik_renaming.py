"""Targets and poles whose bones are given other names, on the rig itself and on others."""

import bpy
from mathutils import Vector

import support
from ik.ik_cases import ARM, REACHABLE, IkTestCase, add_bone, add_chain

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
        """Of one chain, and of many."""
        for arms in (1, 15):
            with self.subTest(arms=arms):
                support.empty_scene()
                self.setUp()
                rig = self.rig_with_controls(arms=arms)
                for index in range(arms):
                    entry = self.reach(f"Arm {index} 1", target="Rig", target_bone=f"Goal {index}", pole="Rig", pole_bone=f"Side {index}")
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

    def test_another_bone_takes_the_name_at_once(self):
        for name in ("Rig", "Other"):
            with self.subTest(rig=name):
                self.setUp()
                rig = self.rig_with_controls()
                self.rig_with_controls("Other")
                entry = self.reach("Arm 0 1", target=name, target_bone="Goal 0", pole=name, pole_bone="Side 0")
                self.evaluated(rig)
                controls = bpy.data.objects[name]
                self.rename(controls, {"Goal 0": "Grip", "Side 0": "Goal 0", "Grip": "Side 0"})
                self.assertEqual((entry.target_bone, entry.pole_bone), ("Side 0", "Goal 0"))
                self.assertFollows(rig, "Arm 0 1", controls, "Side 0")

    def test_flipped_names(self):
        rig = self.rig_with_controls(arms=2)
        self.rename(
            rig,
            {
                "Arm 0 0": "Upper.L",
                "Arm 0 1": "Lower.L",
                "Arm 1 0": "Upper.R",
                "Arm 1 1": "Lower.R",
                "Goal 0": "Goal.L",
                "Goal 1": "Goal.R",
            },
        )
        left = self.reach("Lower.L", target="Rig", target_bone="Goal.L", softness=0.125)
        right = self.reach("Lower.R", target="Rig", target_bone="Goal.R")
        self.evaluated(rig)
        before = {end: rig.data.bones[f"Lower.{end}"].head_local.y for end in "LR"}
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.armature.select_all(action='SELECT')
        bpy.ops.armature.flip_names()
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.context.view_layer.update()
        self.assertAlmostEqual(rig.data.bones["Lower.R"].head_local.y, before["L"])
        self.assertEqual(
            [(one.name, one.target_bone, one.softness) for one in (left, right)], [("Lower.R", "Goal.R", 0.125), ("Lower.L", "Goal.L", 0.0)]
        )
        for end in "LR":
            self.assertFollows(rig, f"Lower.{end}", rig, f"Goal.{end}")

    def test_target_of_a_look(self):
        rig, other = self.rig_with_controls(), self.rig_with_controls("Other")
        self.assertEqual(
            bpy.ops.motus.look_at_add(object="Rig", bone="Arm 0 1", target="Other", target_bone="Goal 0", body_length=0, eyes=""),
            {'FINISHED'},
        )
        self.evaluated(rig)
        self.rename(other, {"Goal 0": "Lamp"})
        self.assertEqual(rig.motus.look_at.entries[0].target_bone, "Lamp")

    def test_heads_that_exchange_names(self):
        rig = self.rig_with_controls(arms=3)
        for index in range(3):
            self.target((1.0, 3.0 * index, 2.0), f"Seen {index}")
            self.assertEqual(
                bpy.ops.motus.look_at_add(object="Rig", bone=f"Arm {index} 1", target=f"Seen {index}", body_length=0, eyes=""), {'FINISHED'}
            )
        self.evaluated(rig)
        with self.assertNoLogs():
            self.rename(rig, {"Arm 0 1": "Kept", "Arm 1 1": "Arm 0 1", "Arm 2 1": "Arm 1 1", "Kept": "Arm 2 1"})
        self.assertEqual(
            [(one.name, one.target.name) for one in rig.motus.look_at.entries],
            [("Arm 2 1", "Seen 0"), ("Arm 0 1", "Seen 1"), ("Arm 1 1", "Seen 2")],
        )

    def test_a_chain_behind_a_head(self):
        """IK of the spine, a head that turns on it, a chain that goes to the head: whichever is renamed, the order stays."""
        rig = self.rig_with_controls(arms=3)
        self.assertEqual(
            bpy.ops.motus.look_at_add(
                object="Rig", bone="Goal 1", target=self.target((0.0, 5.0, 1.0), "Seen").name, body_length=0, eyes=""
            ),
            {'FINISHED'},
        )
        self.reach("Arm 0 1", target="Rig", target_bone="Goal 1")
        rig.motus.look_at.entries[0].target, rig.motus.look_at.entries[0].target_bone = rig, "Arm 2 1"
        self.reach("Arm 2 1", target="Rig", target_bone="Goal 2")
        signature, systems = support.addon("core.wiring.attaching.signature").of, support.addon("core.declare").registered
        for old in ("Goal 1", "Arm 2 1", "Arm 0 1"):
            self.rename(rig, {old: f"New {old}"})
            for name in ("ik", "look_at"):
                system = systems[name]
                self.assertEqual(getattr(rig.motus, name).wired, signature(system, rig, tuple(system.groups(rig))), (old, name))

    def test_a_copy_before_its_first_evaluation(self):
        rig = self.rig_with_controls(arms=15)
        for index in range(15):
            self.reach(f"Arm {index} 1", target="Rig", target_bone=f"Goal {index}")
        copy = rig.copy()
        self.scene.collection.objects.link(copy)
        self.rename(rig, {"Goal 0": "Grip"})
        for one in (rig, copy):
            self.assertEqual(one.motus.ik.entries[0].target_bone, "Grip")
