"""Heads that look at something are known at any times, for systems that need their past."""

import bpy

import solved_cases
import support
from look_at.look_at_cases import LookAtTestCase


class LookAtOverTime(solved_cases.Solved, LookAtTestCase):
    label = "Look At"

    def setUp(self):
        super().setUp()
        support.key(self.target, "location", {1: (2.0, -3.0, 1.5), 30: (-2.0, -2.0, 2.5), 60: (0.0, -3.0, 0.5)})

    def test_spine_head_and_eyes(self):
        self.look(body_length=3, eyes_weight=0.7)
        self.rig.rotation_euler.z = 0.4
        for name in ("Spine", "Head", "Eye.L", "Eyelid.L", "LowerArm.L"):
            with self.subTest(name):
                self.assertSolved(self.rig.pose.bones[name])

    def test_keyed_settings(self):
        entry = self.look(body_length=2)
        support.key(entry, "weight", {1: 0.0, 40: 1.0})
        support.key(entry, "clamp", {1: 0.0, 40: 0.6})
        support.key(self.rig.pose.bones["Neck"], "rotation_quaternion", {1: (1.0, 0.0, 0.0, 0.0), 50: (0.9, 0.2, 0.1, 0.3)})
        self.assertSolved(self.rig.pose.bones["Head"])

    def test_further_targets_with_keyed_weights(self):
        other = self.link("Other", location=(-1.0, -2.0, 1.0))
        entry = self.look(body_length=2)
        for name in (other.name, ""):  # the second one stays without an object
            bpy.ops.motus.look_at_target_add(object="Rig", bone="Head", target=name)
        support.key(entry, "target_weight", {1: 1.0, 40: 0.2})
        support.key(entry.extra_targets[0], "weight", {1: 0.0, 40: 0.7})
        self.assertSolved(self.rig.pose.bones["Head"])

    def test_without_a_target(self):
        entry = self.look()
        entry.target = None
        self.assertSolved(self.rig.pose.bones["Head"])

    def test_what_is_not_known(self):
        self.look()
        self.target.constraints.new('LIMIT_LOCATION')
        self.assertUnknown(self.rig.pose.bones["Head"], "Target has the constraint")
