"""The picture of joint limits: its border is where the solver stops, by formula and by chains that are pulled to it."""

import math

import bpy
from mathutils import Vector

import support
from ik.ik_cases import IkTestCase


class LimitsPicture(IkTestCase):
    def setUp(self):
        super().setUp()
        self.picture = support.addon("ik.limits_picture")
        self.bone = self.arm(hand=False).pose.bones["Bone 0"]
        self.rig_of = bpy.data.objects["Rig"]

    def limit(self, **degrees):
        """Limits of the bone's axes, (least, largest) in degrees; None locks the axis."""
        for letter, ends in degrees.items():
            setattr(self.bone, f"lock_ik_{letter}", ends is None)
            if ends is not None:
                setattr(self.bone, f"use_ik_limit_{letter}", True)
                setattr(self.bone, f"ik_min_{letter}", math.radians(ends[0]))
                setattr(self.bone, f"ik_max_{letter}", math.radians(ends[1]))

    def lines(self):
        return self.picture.lines(self.evaluated(self.rig_of), "Bone 0")

    def test_no_limits_no_lines(self):
        self.assertEqual(self.lines(), [])

    def test_an_ellipse_with_a_half_axis_to_each_side(self):
        self.limit(x=(-10, 30), z=(-20, 50))
        [border] = self.picture.swing_border(self.picture.limits_of(self.bone))
        for x, z in border:
            a, b = math.radians(30 if x > 0.0 else 10), math.radians(50 if z > 0.0 else 20)
            self.assertAlmostEqual((x / a) ** 2 + (z / b) ** 2, 1.0, delta=1e-5)
        self.assertAlmostEqual(max(x for x, _ in border), math.radians(30), delta=1e-6)
        self.assertAlmostEqual(min(z for _, z in border), math.radians(-20), delta=1e-6)

    def test_beside_a_free_axis_there_is_a_band(self):
        self.limit(z=(-20, 50))
        [border] = self.picture.swing_border(self.picture.limits_of(self.bone))
        self.assertAlmostEqual(max(x for x, _ in border), math.pi, delta=1e-6)
        self.assertAlmostEqual(max(z for _, z in border), math.radians(50), delta=1e-6)

    def test_a_chain_that_is_pulled_stops_at_the_border(self):
        self.limit(x=(-25, 25), z=(-25, 25))
        rig = self.rig_of
        rig.location, rig.rotation_euler, rig.scale = (0.3, 0.2, -0.4), (0.4, -0.3, 0.9), (1.5, 1.5, 1.5)
        self.target((9.0, 9.0, 9.0))
        self.reach("Bone 0", chain_length=1, use_limits=True)
        for place in ((40.0, 0.0, 60.0), (-60.0, 0.0, 10.0), (0.0, -50.0, -50.0), (0.0, 70.0, 0.0)):
            bpy.data.objects["Target"].location = place
            tail = self.tail(rig, "Bone 0")
            near = min((Vector(point) - tail).length for point in self.lines())
            unturned = rig.matrix_world @ rig.data.bones["Bone 0"].matrix_local.to_3x3().to_4x4() @ Vector((0.0, 1.0, 0.0))
            along = tail - self.pose(rig, "Bone 0").translation
            angle = math.degrees(along.angle(unturned - rig.matrix_world.translation))
            if angle > 24.9:  # the target lies beyond the limits
                self.assertLess(near, 0.08 * along.length)

    def test_the_twist(self):
        self.limit(y=(-30, 60))
        turned = math.radians(20)
        self.bone.rotation_quaternion = (math.cos(0.5 * turned), 0.0, math.sin(0.5 * turned), 0.0)
        found = [Vector(point) for point in self.lines()]
        middle, first, last, now = found[0], found[1], found[-4], found[-1]
        self.assertAlmostEqual((first - middle).angle(last - middle), math.radians(90), delta=1e-4)
        self.assertAlmostEqual((first - middle).angle(now - middle), math.radians(50), delta=1e-4)
