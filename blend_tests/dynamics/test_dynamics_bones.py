"""Bones with dynamics: by their own animation, and chains whose tails trail behind."""

import bpy
import numpy as np

import support
from dynamics import dynamics_cases as cases

FLOPPY = 1.4, 0.25, 0.0


def _chain(rig, chain=0):
    return [bone.name for bone in rig.pose.bones if bone.name.startswith(f"Tail {chain} ")]


class DynamicsBonesTest(support.SceneTestCase):
    def test_a_bone_by_its_own_animation(self):
        rig = cases.rope(1)
        bone = rig.pose.bones["Root"]
        cases.add(rig, bones="Root", follow='OWN', channels={'LOCATION'}, style='BOUNCY')
        for frame in (12, 19, 24, 40):
            wanted = cases.filtered(lambda frames: cases.own(bone)(frames).locations, (2.0, 0.3, 0.0), frame)
            np.testing.assert_allclose(
                np.array(rig.data.bones["Root"].matrix_local.inverted()) @ np.append(cases.place(rig, frame, "Root"), 1.0),
                np.append(wanted, 1.0),
                atol=1e-4,
            )

    def test_tails_point_to_where_they_have_come(self):
        rig = cases.rope(5)
        rig.location, rig.rotation_euler = (1.0, 2.0, 0.0), (0.2, 0.5, 0.0)
        frames = np.arange(8, 8 * 50) / 8
        names = _chain(rig)
        plain = {name: np.array([cases.tail(rig, frame, name) for frame in frames]) for name in names}
        cases.add(rig, bones=names[0], whole_chains=True, style='FLOPPY', chain_delay=0.05)
        entries = rig.motus.dynamics.entries
        self.assertEqual([entry.name for entry in entries], names)
        np.testing.assert_allclose([entry.delay for entry in entries], 0.05 * np.arange(5), atol=1e-6)
        self.assertEqual({entry.chain for entry in entries}, {names[0]})
        self.assertIsNone(cases.problem(rig))
        for frame in (14, 20, 27):
            for index, name in enumerate(names):
                wanted = cases.filtered(
                    lambda at, name=name: np.stack([np.interp(at, frames, plain[name][:, axis]) for axis in range(3)], axis=1),
                    FLOPPY,
                    frame - 0.05 * index * 24,
                    last=49,
                )
                head, tail = cases.place(rig, frame, name), cases.tail(rig, frame, name)
                self.assertAlmostEqual(np.linalg.norm(tail - head), 0.3, places=4)
                way = (wanted - head) / np.linalg.norm(wanted - head)
                np.testing.assert_allclose((tail - head) / 0.3, way, atol=2e-2)

    def test_any_frame_in_any_order(self):
        rig = cases.rope(4, chains=2)
        cases.add(rig, bones=", ".join(_chain(rig) + _chain(rig, 1)), style='BOUNCY')
        first = {frame: cases.matrix(rig, frame, "Tail 1 3").tobytes() for frame in cases.FRAMES}
        for frame in reversed(cases.FRAMES):
            self.assertEqual(cases.matrix(rig, frame, "Tail 1 3").tobytes(), first[frame])

    def test_what_rests_stays_where_it_is(self):
        rig = cases.rope(4)
        before = cases.matrix(rig, 5, "Tail 0 3")
        cases.add(rig, bones="Tail 0 0", whole_chains=True)
        np.testing.assert_allclose(cases.matrix(rig, 5, "Tail 0 3"), before, atol=1e-5)

    def test_other_bones_keep_their_keys(self):
        rig = cases.rope(3, chains=2)
        before = cases.matrix(rig, 16, "Tail 1 2")
        cases.add(rig, bones="Tail 0 0", whole_chains=True)
        np.testing.assert_array_equal(cases.matrix(rig, 16, "Tail 1 2"), before)

    def test_keys_of_the_chain_itself_count(self):
        rig = cases.rope(3)
        bone = rig.pose.bones["Tail 0 1"]
        bone.rotation_mode = 'XYZ'
        cases.key(bone, "rotation_euler", {1: (0.0, 0.0, 0.0), 60: (0.0, 0.0, 0.0), 66: (1.0, 0.0, 0.0)})
        plain = cases.tail(rig, 200, "Tail 0 2")
        moving = cases.tail(rig, 68, "Tail 0 2")
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='BOUNCY')
        np.testing.assert_allclose(cases.tail(rig, 200, "Tail 0 2"), plain, atol=1e-3)
        self.assertGreater(np.abs(cases.tail(rig, 68, "Tail 0 2") - moving).max(), 0.02)

    def test_the_selected_bones_in_pose_mode(self):
        rig = cases.rope(3, chains=2)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='POSE')
        for name in ("Tail 0 0", "Tail 1 1"):
            bone = rig.pose.bones[name]
            (bone if hasattr(bone, "select") else bone.bone).select = True
        bpy.ops.motus.dynamics_add(whole_chains=True)
        found = [entry.name for entry in rig.motus.dynamics.entries]
        self.assertEqual(sorted(found), ["Tail 0 0", "Tail 0 1", "Tail 0 2", "Tail 1 1", "Tail 1 2"])
        bpy.ops.motus.dynamics_remove()
        self.assertEqual(len(rig.motus.dynamics.entries), 3)
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_a_bone_that_is_renamed_or_gone(self):
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='BOUNCY')
        wanted = cases.matrix(rig, 22, "Tail 0 2")
        rig.data.bones["Tail 0 1"].name = "Middle"
        bpy.context.view_layer.update()
        self.assertIn("Middle", rig.motus.dynamics.entries)
        np.testing.assert_allclose(cases.matrix(rig, 22, "Tail 0 2"), wanted, atol=1e-6)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones.remove(rig.data.edit_bones["Tail 0 2"])
        bpy.ops.object.mode_set(mode='OBJECT')
        bpy.context.view_layer.update()
        self.assertTrue(np.isfinite(cases.matrix(rig, 22, "Middle")).all())
        self.assertGreater(np.abs(cases.tail(rig, 22, "Middle") - (0.0, 0.0, 1.6)).max(), 0.01)
        self.assertIn("not there any more", cases.problem(rig).sentence)
        told = support.addon("dynamics.told").sentence(rig, cases.problem(rig), bpy.context.scene)
        self.assertEqual(told, "Rope has no bone Tail 0 2: remove it from the list")
        rig.motus.dynamics.active_entry = rig.motus.dynamics.entries.find("Tail 0 2")
        bpy.ops.motus.dynamics_remove(object=rig.name, only_active=True)
        bpy.context.view_layer.update()
        cases.go_to(22)
        self.assertIsNone(cases.problem(rig))
        self.assertEqual([entry.name for entry in rig.motus.dynamics.entries], ["Tail 0 0", "Middle"])

    def test_dynamics_of_the_object_and_of_its_bones(self):
        rig = cases.rope(3)
        cases.key(rig, "location", {40: (0.0, 0.0, 0.0), 50: (0.0, 3.0, 0.0)})
        cases.add(rig, style='BOUNCY')
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='FLOPPY')
        self.assertIsNone(cases.problem(rig))
        wanted = cases.filtered(lambda frames: cases.own(rig)(frames).locations, (2.0, 0.3, 0.0), 53)
        np.testing.assert_allclose(cases.place(rig, 53), wanted, atol=3e-4)
        swing = cases.tail(rig, 46, "Tail 0 2")[1] - cases.place(rig, 46)[1]
        self.assertLess(swing, -0.05)

    def test_bones_of_other_systems_are_refused(self):
        rig = cases.rope(3)
        cases.link("Target")
        bpy.ops.motus.ik_add(object=rig.name, bone="Tail 0 2", target="Target")
        with self.assertRaisesRegex(RuntimeError, "driven by"):
            cases.add(rig, bones="Tail 0 2")

    def test_bake_and_unbake(self):
        rig = cases.rope(3)
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='BOUNCY')
        live = {frame: cases.matrix(rig, frame, "Tail 0 2") for frame in (15, 22, 30)}
        bpy.ops.motus.bake(object=rig.name, frame_start=1, frame_end=40)
        for frame, wanted in live.items():
            np.testing.assert_allclose(cases.matrix(rig, frame, "Tail 0 2"), wanted, atol=1e-4)
        bpy.ops.motus.unbake(object=rig.name)
        for frame, wanted in live.items():
            np.testing.assert_allclose(cases.matrix(rig, frame, "Tail 0 2"), wanted, atol=1e-6)

    def test_a_loop_of_a_chain(self):
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 1, 40
        rig = cases.rope(3)
        cases.key(rig.pose.bones["Root"], "location", {41: (0.0, 0.0, 0.0)})
        cases.add(rig, bones="Tail 0 0", whole_chains=True, style='BOUNCY', use_loop=True)
        np.testing.assert_allclose(cases.matrix(rig, 1, "Tail 0 2"), cases.matrix(rig, 41, "Tail 0 2"), atol=1e-5)
