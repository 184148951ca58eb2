"""What the operators that match say: the largest error that is left, where it is known what must be."""

import math
import re

import bpy
from mathutils import Quaternion, Vector

import support
from ik.matching.ik_match_cases import MatchTestCase

JOINTS = ((0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (1.5, 0.0, 1.0))
ANGLE = math.radians(60.0)
MATCHED = re.compile(r"(Info|Warning): Matched (\d+) frames of 1 chains: largest error (\S+) mm, (\S+) degrees$")


class Scenes(MatchTestCase):
    """Arms in five frames; straight ones turn about the world's Z meanwhile, by 60 degrees."""

    def setUp(self):
        super().setUp()
        self.scene.frame_end = 5

    def turned(self):
        """By its own keys, where a target waits elsewhere."""
        rig = self.arm(JOINTS, hand=False)
        bone = rig.pose.bones["Bone 0"]
        for frame, angle in ((1, 0.0), (5, ANGLE)):
            bone.rotation_quaternion = Quaternion(bone.bone.matrix_local.to_3x3().inverted() @ Vector((0, 0, 1)), angle)
            bone.keyframe_insert("rotation_quaternion", frame=frame)
        self.reach()
        return rig

    def pulled(self, is_limited=False):
        """By the target; limited: the artist's own constraint holds the animated pose at rest."""
        rig = self.arm(JOINTS, hand=False)
        if is_limited:
            # Added first, so that it acts before what Motus adds.
            limit = rig.pose.bones["Bone 0"].constraints.new('LIMIT_ROTATION')
            limit.owner_space = 'LOCAL'
            limit.use_limit_x = limit.use_limit_y = limit.use_limit_z = True
        target = self.target(JOINTS[-1])
        target.keyframe_insert("location", frame=1)
        target.location = (1.5 * math.cos(ANGLE), 1.5 * math.sin(ANGLE), 1.0)
        target.keyframe_insert("location", frame=5)
        self.reach()
        return rig

    def controls_matched(self):
        """An arm that bends: a straight one's elbow goes by the square root of what single precision loses."""
        self.animated_arm(frames=(1, 5))
        self.reach()
        self.match()

    def controls_matched_with_a_locked_joint(self, unit=1.0):
        """The first bone stays where it is at rest, so its end is left a chord of 60 degrees away."""
        rig = self.turned()
        for letter in "xyz":
            setattr(rig.pose.bones["Bone 0"], f"lock_ik_{letter}", True)
        rig.motus.ik.entries[0].use_limits = True
        self.scene.unit_settings.scale_length = unit
        self.match()

    def bones_matched(self):
        self.pulled()
        self.match("fk_match_ik")

    def bones_matched_with_a_limited_bone(self):
        """The arm stays at rest, whatever is keyed: its tip is left a chord of 60 degrees away."""
        self.pulled(is_limited=True)
        self.match("fk_match_ik")


class Reports(support.SceneTestCase):
    def said(self, *calls):
        """(kind, frames, millimetres, degrees) that each of the Scenes reports."""
        code = "from ik.matching import test_ik_match_reports\n" + "".join(
            f"scene = test_ik_match_reports.Scenes()\nscene.setUp()\nscene.{call}\n" for call in calls
        )
        status, output = support.run_beside(code)
        self.assertEqual(status, 0, output)
        found = [match.groups() for match in map(MATCHED.match, output.splitlines()) if match]
        self.assertEqual(len(found), len(calls), output)
        return found

    def test_nothing_is_left(self):
        for kind, frames, length, angle in self.said("controls_matched()", "bones_matched()"):
            self.assertEqual((kind, frames), ("Info", "5"))
            self.assertLessEqual(float(length), 0.01)
            self.assertLessEqual(float(angle), 0.02)

    def test_what_must_be_left(self):
        found = self.said(
            "controls_matched_with_a_locked_joint()", "controls_matched_with_a_locked_joint(0.01)", "bones_matched_with_a_limited_bone()"
        )
        for (kind, frames, length, angle), wanted in zip(found, (1000.0, 10.0, 1500.0)):
            self.assertEqual((kind, frames), ("Warning", "5"))
            self.assertAlmostEqual(float(length), wanted, delta=1e-5 * wanted)
            self.assertAlmostEqual(float(angle), 60.0, delta=1e-3)
            self.assertNotIn("e", length + angle, "an exponent is nothing to read")


class Steps(MatchTestCase):
    """How many steps the operators announce, and how many they take."""

    def steps(self, operator):
        """(announced before the first, numbers of those that were done)."""
        cls = getattr(support.addon("ik.matching.operators"), operator)
        walker = type("Walker", (), {"object": "Rig", "bone": "", "switch": False, "steps": cls.steps, "job": staticmethod(cls.job)})()
        steps = walker.steps(bpy.context, list(range(1, 11)))
        return walker.total, list(steps)

    def test_scripts_change_the_list_meanwhile(self):
        job = support.addon("ik.matching.job")
        for match, name, value in ((job.match_fk, "position_weight", 1.0), (job.match_ik, "rotation_weight", 0.0)):
            self.setUp()
            rig = self.animated_arm()
            self.reach(position_weight=0.5, rotation_weight=0.5)
            steps = match(bpy.context, rig, "", list(range(1, 31)), True, {})
            next(steps), next(steps)
            entries = rig.motus.ik.entries
            with support.addon("core.settings.entries").unwired(rig.motus.ik):
                for index in range(200):  # Blender moves the list in memory
                    entries.add().name = f"More {index}"
            list(steps)
            self.assertEqual(getattr(entries[0], name), value)

    def test_announced(self):
        self.animated_arm()
        entry = self.reach(make_pole=True)
        for operator, parent, wanted in (
            ("MOTUS_OT_ik_match_fk", None, 20),
            ("MOTUS_OT_fk_match_ik", None, 20),
            ("MOTUS_OT_ik_match_fk", entry.target, 30),
        ):
            with self.subTest(operator, parent=parent):
                entry.pole.parent = parent
                self.assertEqual(self.steps(operator), (wanted, list(range(1, wanted + 1))))
