"""What the panel says of a chain: why it does not reach, and of what it has lost."""

import math

import bpy
import numpy as np

import support
from ik.ik_cases import IkTestCase, tentacle

STRAIGHT = ((0.0, 0.0, 0.0), (1.0, 0.01, 0.0), (2.0, 0.0, 0.0))
LONG = ((0.0, 0.0, 0.0), (1.0, 0.01, 0.0), (2.0, 0.0, 0.0), (3.0, 0.01, 0.0))
SOFT = 8.0 / 27.0
"""Of the length that softness takes, what it leaves to a target just within reach."""


class Orientation(IkTestCase):
    """Softness, or the orientation of the last bone: which of them keeps the chain from its target."""

    def turned(self, joints, distance, angle, **keywords):
        """An entry of all the bones, whose last one is to point at so many degrees from the line to the target."""
        self.rigged = self.arm(joints, hand=False)
        self.goal = self.target((distance, 0.0, 0.0))
        self.turn(angle)
        self.last = f"Bone {len(joints) - 2}"
        return self.reach(self.last, chain_length=len(joints) - 1, keep_rotation=False, **{"rotation_weight": 1.0, **keywords})

    def turn(self, degrees):
        self.goal.rotation_euler = (0.0, 0.0, math.radians(degrees) - math.pi / 2.0)  # its Y along X

    def why(self, entry):
        """(as the check has it, the panel's sentence)."""
        status = support.addon("ik.status")
        sentence = self.sentence(self.rigged, self.last)
        report = status.report(self.rigged, self.last, bpy.context.view_layer.depsgraph)
        return status.fault(report, entry)[1], sentence

    def assertTurned(self, entry):
        why, sentence = self.why(entry)
        self.assertEqual(why, 'TURN')
        self.assertRegex(sentence, "^With the target's orientation .* are left$")

    def assertSoft(self, entry):
        why, sentence = self.why(entry)
        self.assertEqual(why, 'NONE')
        self.assertIn("Softness", sentence)

    def test_turned_away(self):
        entry = self.turned(STRAIGHT, 1.9, 180.0, softness=0.02)
        self.assertAlmostEqual(self.output(self.rigged, "Bone 1.residual"), 1.9, places=3)
        self.assertTurned(entry)

    def test_a_single_bone_before_the_last_is_not_soft(self):
        entry = self.turned(STRAIGHT, 1.99, 10.0, softness=0.2)
        self.assertLess(self.output(self.rigged, "Bone 1.residual"), 0.02)
        self.assertTurned(entry)

    def test_bones_before_the_last_are_soft(self):
        """Two of three bones: they reach 2, and the third takes the target 1 farther."""
        entry = self.turned(LONG, 2.999, 0.0, softness=0.1)
        left = self.output(self.rigged, "Bone 2.residual")
        self.assertAlmostEqual(left, SOFT * 0.2, delta=1e-3)
        self.assertSoft(entry)
        self.turn(8.0)  # the third bone is now 1 cm short of where the others end
        self.assertLess(self.output(self.rigged, "Bone 2.residual"), SOFT * 0.3, "not more than a chain of three leaves")
        self.assertTurned(entry)
        self.turn(180.0)
        self.assertTurned(entry)

    def test_half_the_turn(self):
        entry = self.turned(LONG, 2.9, 0.0, softness=0.1, rotation_weight=0.5)
        self.assertSoft(entry)
        self.turn(120.0)
        self.assertTurned(entry)
        self.rigged.motus.ik.influence = 0.0
        self.assertEqual(self.why(entry)[1], "")

    def test_stretch(self):
        entry = self.turned(LONG, 2.95, 0.0, softness=0.1, stretch=0.5)
        self.assertSoft(entry)
        self.turn(90.0)
        self.assertTurned(entry)
        entry.stretch = 1.0
        self.assertEqual(self.why(entry), ('NONE', ""))

    def test_limits_give_way_to_the_place(self):
        entry = self.turned(LONG, 2.999, 90.0, softness=0.1, use_limits=True)
        self.assertAlmostEqual(self.output(self.rigged, "Bone 2.residual"), SOFT * 0.3, delta=1e-3)
        self.assertSoft(entry)

    def test_beyond_reach(self):
        """What has the greater part in what is left."""
        entry = self.turned(STRAIGHT, 2.5, 3.0, softness=0.02)
        why, sentence = self.why(entry)
        self.assertEqual(why, 'FAR')
        self.assertRegex(sentence, "^The target is .* too far away$")
        self.goal.location.x = 2.01
        self.turn(180.0)
        self.assertTurned(entry)


class Levels(IkTestCase):
    COUNT = 20

    def test_many_that_wait_for_one_another(self):
        rig = self.arm(tentacle(self.COUNT), hand=False)
        target = self.target((0.1, 0.2, 3.0))
        with support.addon("ik.setup").at_once(rig):
            for index in range(self.COUNT):
                support.addon("ik.setup").add(rig, f"Bone {index}", {"target": target, "chain_length": 1})
        bpy.context.view_layer.update()
        report = support.addon("ik.status").report
        told = [report(rig, f"Bone {index}", bpy.context.view_layer.depsgraph) for index in range(self.COUNT)]
        self.assertNotIn(None, told)
        self.assertIn("too far away", self.sentence(rig, f"Bone {self.COUNT - 1}"))


class Poles(IkTestCase):
    def bent(self, bone=""):
        """An arm with a pole that turns its bend; the entry, and how the bones stand."""
        rig = self.arm()
        pole = self.target((0.3, 0.1, 3.0), "Pole")
        if bone:
            pole = self.arm(((0.0, 0.0, 3.0), (0.0, 0.0, 4.0)), "Pole rig", hand=False)
        entry = self.reach(pole=pole.name, pole_bone=bone)
        self.assertEqual(support.addon("ik.status").sentence(bpy.context, rig, entry), ('INFO', ""))
        return rig, entry, self.poses(rig)

    def assertLost(self, rig, entry, before, sentence):
        poses = self.poses(rig)
        self.assertGreater(np.abs(poses - before).max(), 1e-3)
        self.assertEqual(support.addon("ik.status").sentence(bpy.context, rig, entry), ('INFO', sentence))
        entry.pole = None
        self.assertSamePose(rig, poses)
        self.assertEqual(self.sentence(rig), "")

    def test_deleted_by_the_user(self):
        rig, entry, before = self.bent()
        self.scene.collection.objects.unlink(entry.pole)
        self.scene.frame_set(2)
        self.assertLost(rig, entry, before, "Pole is in no collection any more: the chain bends as without a pole")

    def test_bone_that_is_gone(self):
        rig, entry, before = self.bent("Bone 0")
        entry.pole_bone = "Nose"
        self.assertLost(rig, entry, before, "Pole rig has no bone Nose: the chain bends as without a pole")

    def test_hidden_pole_counts(self):
        rig, entry, before = self.bent()
        entry.pole.hide_viewport = True
        self.assertSamePose(rig, before, frame=2)
        self.assertEqual(self.sentence(rig), "")


class OfTheList(IkTestCase):
    def test_second_entry_of_a_bone(self):
        rig = self.arm(tentacle(4, 0.4))
        self.reach("Bone 1", target="")
        second = self.reach("Bone 3", target="")
        self.assertEqual(self.sentence(rig, "Bone 3"), "")
        second.name = "Bone 1"
        bpy.context.view_layer.update()
        icon, sentence = support.addon("ik.status").sentence(bpy.context, rig, rig.motus.ik.entries[1])
        self.assertEqual((icon, sentence), ('ERROR', "Bone 1 has another chain in this list: choose another bone"))
        self.assertEqual(self.sentence(rig, "Bone 1"), "")
        second.name = "Bone 3"
        self.assertEqual(self.sentence(rig, "Bone 3"), "")

    def test_further_target_that_is_gone(self):
        rig = self.arm()
        entry = self.reach()
        extra = entry.extra_targets.add()
        extra.object = self.target((0.5, 0.5, 1.2), "Second")
        entry.target_blend = 1.0
        self.assertEqual(self.sentence(rig), "")
        extra.object = None
        self.assertEqual(self.sentence(rig), "Further target 1 is missing: the one before it counts instead")
        entry.target_blend = 0.0
        self.assertEqual(self.sentence(rig), "")
