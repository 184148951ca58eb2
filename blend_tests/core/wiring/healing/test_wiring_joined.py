"""Rigs that are joined into one that Motus does not drive: what was wired on them is taken away."""

import bpy

from ik.ik_cases import IkTestCase, add_bone, add_chain, state, turn

CHAINS = 14


class Joined(IkTestCase):
    def plain(self):
        return self.rig(lambda bones: add_bone(bones, "Plain", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), "Plain")

    def join(self, rig, other):
        bpy.ops.object.select_all(action='DESELECT')
        for one in (rig, other):
            one.select_set(True)
        bpy.context.view_layer.objects.active = other
        bpy.ops.object.join()
        bpy.context.view_layer.update()

    def assertFreed(self, rig, wanted):
        """Nothing of the wiring is there, and the bones that came along stand as they are animated."""
        self.assertEqual([bone.name for bone in rig.pose.bones if bone.constraints], [])
        self.assertIsNone(rig.animation_data)
        self.assertEqual([key for key in rig.keys() if key != "motus"], [])
        self.assertFalse(rig.motus.ik.is_active)
        for name, pose in wanted.items():
            self.assertNear(self.pose(rig, name), pose)

    def assertNothingHidden(self):
        """Neither the rig that was joined is left, nor what served it."""
        left = [obj.name for obj in bpy.data.objects if not obj.users_collection]
        self.assertEqual(left, [])

    def free_poses(self, rig):
        rig.motus.ik.influence = 0.0
        poses = {bone.name: self.pose(rig, bone.name).copy() for bone in rig.pose.bones}
        rig.motus.ik.influence = 1.0
        return poses

    def test_into_a_plain_one(self):
        rig, other = self.arm(), self.plain()
        turn(rig.pose.bones["Bone 0"], (0.0, 0.0, 1.0), 0.3)
        self.reach(stretch=0.3)
        wanted = self.free_poses(rig)
        self.join(rig, other)
        self.assertFreed(other, wanted)
        self.reach(rig="Plain", target="Target")
        self.assertNear(self.tail(other), bpy.data.objects["Target"].location)

    def test_what_is_the_users_stays(self):
        rig, other = self.arm(), self.plain()
        other.pose.bones["Plain"].constraints.new('COPY_SCALE').name = "Own"
        other.driver_add("location", 2).driver.expression = "0.5"
        rig.pose.bones["Bone 1"].constraints.new('COPY_SCALE').name = "Own"
        bpy.context.view_layer.update()
        self.reach(stretch=0.3)
        self.join(rig, other)
        found = state(other)
        self.assertEqual(
            {name: bone["constraints"] for name, bone in found["bones"].items() if bone["constraints"]},
            {name: [('COPY_SCALE', "Own", 1.0, False)] for name in ("Plain", "Bone 1")},
        )
        self.assertEqual(found["drivers"], ["location"])

    def test_from_hubs(self):
        def build(bones):
            for index in range(CHAINS):
                x = 0.5 * index
                add_chain(bones, f"Arm {index}.", ((x, 0.0, 0.0), (x, 0.2, 0.7), (x, 0.0, 1.4)))

        rig, other = self.rig(build), self.plain()
        for index in range(CHAINS):
            self.target((0.5 * index, 0.5, 0.5), f"Target {index}")
            self.reach(f"Arm {index}. 1", target=f"Target {index}", stretch=0.2)
        wanted = self.free_poses(rig)
        self.join(rig, other)
        self.assertFreed(other, wanted)
        self.assertNothingHidden()

    def test_from_proxies(self):
        rig, other = self.arm(), self.plain()
        rig.driver_add('pose.bones["Bone 0"].rotation_quaternion', 3).driver.expression = "0.25"
        self.reach()
        self.join(rig, other)
        self.assertEqual([bone.name for bone in other.pose.bones if bone.constraints], [])
        self.assertEqual([curve.data_path for curve in other.animation_data.drivers], ['pose.bones["Bone 0"].rotation_quaternion'])
        self.assertNothingHidden()

    def test_into_one_that_looks(self):
        """The wiring of another system stays."""
        rig, other = self.arm(), self.plain()
        self.target((2.0, -3.0, 2.0), "Seen")
        bpy.ops.motus.look_at_add(object="Plain", bone="Plain", target="Seen", eyes="")
        looking = self.pose(other, "Plain").copy()
        self.reach(stretch=0.3)
        self.join(rig, other)
        self.assertEqual([bone.name for bone in other.pose.bones if bone.constraints], ["Plain"])
        self.assertNear(self.pose(other, "Plain"), looking)
        self.assertTrue(other.motus.look_at.is_active)

    def test_the_one_that_reaches_stays_as_it_is(self):
        rig, other = self.arm(), self.plain()
        self.reach(stretch=0.3)
        self.join(other, rig)
        self.assertNear(self.tail(rig), bpy.data.objects["Target"].location)
