"""A chain ends where another chain, or a different system, takes over a bone below it, which then follows it."""

import bpy
import numpy as np
from mathutils import Vector

import support
from chains import chain_cases as cases
from look_at import look_at_cases

FRAMES = (3, 12.5, 24, 60)


def driven(rig):
    """{name of an entry: names of its bones} of a rig's chains."""
    return {chain.entry.name: chain.names for chain in support.addon("chains.groups").chains(rig)}


def poses(rig, frames=FRAMES):
    """Matrices of all bones on frames, (frames, bones, 4, 4)."""
    return np.array([[cases.matrix(rig, frame, bone.name) for bone in rig.pose.bones] for frame in frames])


class ChainsBelowChains(support.SceneTestCase):
    def test_the_upper_one_ends_where_the_lower_one_begins(self):
        rig = cases.rope(4)
        cases.add(rig, frequency=1.0)
        whole = poses(rig)
        cases.add(rig, "Tail 0 2", frequency=4.0)
        self.assertEqual(driven(rig), {"Tail 0 0": ("Tail 0 0", "Tail 0 1"), "Tail 0 2": ("Tail 0 2", "Tail 0 3")})
        self.assertIsNone(cases.problem(rig))
        parted = poses(rig)
        self.assertGreater(np.abs(parted - whole).max(), 1e-2)
        names = [bone.name for bone in rig.pose.bones]
        heads, tails = (parted[:, names.index(name)] for name in ("Tail 0 2", "Tail 0 1"))
        np.testing.assert_allclose(heads[:, :3, 3], tails[:, :3, 3] + cases.LENGTH * tails[:, :3, 1], atol=1e-5)
        np.testing.assert_array_equal(poses(rig, FRAMES[::-1])[::-1], parted)
        bpy.ops.motus.chains_remove(object=rig.name, bones="Tail 0 2")
        np.testing.assert_array_equal(poses(rig), whole)

    def test_the_lower_one_is_as_below_keys_that_move_as_the_upper_one(self):
        rig, keyed = cases.rope(4), cases.rope(4, name="Keyed")
        cases.add(rig, frequency=1.0)
        cases.add(rig, "Tail 0 2", frequency=2.0)
        for frame in range(1, 62):
            cases.go_to(frame)
            evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
            for name in ("Tail 0 0", "Tail 0 1"):
                moved, bone = evaluated.pose.bones[name], keyed.pose.bones[name]
                bone.rotation_mode = 'QUATERNION'
                local = evaluated.convert_space(pose_bone=moved, matrix=moved.matrix, from_space='POSE', to_space='LOCAL')
                bone.rotation_quaternion = local.to_quaternion()
                bone.keyframe_insert("rotation_quaternion", frame=frame)
        cases.add(keyed, "Tail 0 2", frequency=2.0)
        found, wanted = (np.array([cases.tails(one, frame, cases.chain(rig)) for frame in (3, 12, 24, 59)]) for one in (rig, keyed))
        np.testing.assert_allclose(found, wanted, atol=2e-3)  # m, of tails of 1.2 m: keys are Béziers between the frames

    def test_a_muted_one_leaves_bones_out(self):
        rig = cases.rope(4)
        cases.add(rig, frequency=1.0)
        cases.add(rig, "Tail 0 2", weight=0.0)
        local = [rig.pose.bones[name].matrix_basis.copy() for name in ("Tail 0 2", "Tail 0 3")]
        for frame in FRAMES:
            cases.go_to(frame)
            evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
            for name, wanted in zip(("Tail 0 2", "Tail 0 3"), local):
                bone = evaluated.pose.bones[name]
                found = evaluated.convert_space(pose_bone=bone, matrix=bone.matrix, from_space='POSE', to_space='LOCAL')
                np.testing.assert_allclose(np.array(found), np.array(wanted), atol=1e-5)


class ChainsBelowOthers(support.SceneTestCase):
    def figure(self):
        rig = look_at_cases.build_rig()
        support.key(rig, "rotation_euler", {1: (0.0, 0.0, 0.0), 10: (0.5, 0.2, 0.0), 20: (-0.3, 0.0, 0.0)})
        self.link("Target").location = (1.0, -3.0, 2.0)
        bpy.context.view_layer.update()
        return rig

    def chain(self, rig):
        cases.add(rig, "Spine", frequency=1.5)

    @staticmethod
    def look(rig):
        bpy.ops.motus.look_at_add(object=rig.name, bone="Head", target="Target", body_length=0)

    def test_a_head_looks_from_where_its_neck_has_swung(self):
        found = []
        for acts in ((self.chain, self.look), (self.look, self.chain)):
            support.empty_scene()
            rig = self.figure()
            for act in acts:
                act(rig)
            self.assertEqual(driven(rig), {"Spine": ("Spine", "Chest", "Neck", "UpperArm.L", "LowerArm.L")})
            self.assertIsNone(cases.problem(rig))
            found.append(poses(rig))
        np.testing.assert_array_equal(*found)
        bones = [bone.name for bone in rig.pose.bones]
        for row in found[0][:, bones.index("Head")]:
            faced = -(row @ np.linalg.inv(rig.data.bones["Head"].matrix_local))[:3, 1]
            wanted = np.array(Vector((1.0, -3.0, 2.0))) - row[:3, 3]
            np.testing.assert_allclose(faced, wanted / np.linalg.norm(wanted), atol=2e-2)
        bpy.ops.motus.look_at_remove(object=rig.name)
        self.assertIn("Head", driven(rig)["Spine"])
        with_head = poses(rig)
        bpy.ops.motus.chains_remove(object=rig.name)
        self.chain(rig)
        np.testing.assert_array_equal(poses(rig), with_head)

    def test_hair_hangs_on_a_head_that_looks(self):
        rig = self.figure()
        self.look(rig)
        cases.add(rig, "Eyelid.L", frequency=1.0)
        self.assertIsNone(cases.problem(rig))
        head = poses(rig)
        bpy.data.objects["Target"].location.x = -4.0
        bpy.context.view_layer.update()
        turned = poses(rig)
        row = [bone.name for bone in rig.pose.bones].index("Eyelid.L")
        self.assertGreater(np.abs(turned[:, row] - head[:, row]).max(), 1e-2)

    def test_each_system_takes_over_what_is_below_the_topmost_bone(self):
        adds = {
            "dynamics": lambda rig, bone: bpy.ops.motus.dynamics_add(object=rig.name, bones=bone),
            "ik": lambda rig, bone: bpy.ops.motus.ik_add(object=rig.name, bone=bone, target="Target", chain_length=1),
            "look_at": lambda rig, bone: bpy.ops.motus.look_at_add(object=rig.name, bone=bone, target="Target", body_length=0),
        }
        for name, add in adds.items():
            with self.subTest(name):
                support.empty_scene()
                rig = self.figure()
                cases.add(rig, "UpperArm.L", frequency=1.0)
                add(rig, "LowerArm.L")
                self.assertEqual(driven(rig), {"UpperArm.L": ("UpperArm.L",)})
                with self.assertRaisesRegex(RuntimeError, "UpperArm.L is driven by Chains of UpperArm.L already"):
                    add(rig, "UpperArm.L")
                self.assertIsNone(cases.problem(rig))
                poses(rig)
