"""What the panel says of a chain: why it does not reach, and of what it has lost."""

import bpy
import numpy as np
import support
from ik_cases import IkTestCase, tentacle


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
