"""Settings of chains: each arrives at the native module; presets, copies, refusals, and what the panel says is wrong."""

import json

import bpy
import numpy as np

import support
from chains import chain_cases as cases

KEYWORDS = {
    "frequency": 3.0,
    "tip_frequency": 0.5,
    "damping": 0.7,
    "response": 0.9,
    "gravity": 0.4,
    "drag": 1.7,
    "tip_mass": 2.5,
    "tip_shape": 2.0,
    "stretch": 0.02,
    "bend_limit": 0.8,
    "side_limit": 0.3,
    "thickness": 0.03,
    "tip_thickness": 0.5,
}


class ChainsSettingsTest(support.SceneTestCase):
    def test_what_is_made(self):
        rig = cases.rope(3)
        bpy.context.scene.frame_end = 48
        plain = [cases.place(rig, 1, "Tail 0 0"), *cases.tails(rig, 1, cases.chain(rig))]
        (found,) = cases.made(lambda: cases.add(rig, **KEYWORDS))
        self.assertEqual(found.parents, [-1, 0, 1, 2])
        self.assertEqual(len(found.times), 481)
        np.testing.assert_allclose([found.times[0], found.times[-1]], [1.0 / 24.0, 49.0 / 24.0])
        np.testing.assert_allclose(found.poses[0], plain, atol=1e-6)
        np.testing.assert_allclose(found.frequency, 3.0 * np.array([1.0, 1.0, 0.875, 0.5]), rtol=1e-6)
        np.testing.assert_allclose(found.mass, [1.0, 1.0, 1.375, 2.5], rtol=1e-6)
        np.testing.assert_allclose(found.thickness, 0.03 * np.array([1.0, 1.0, 0.875, 0.5]), rtol=1e-6)
        np.testing.assert_allclose(found.gravity, np.broadcast_to((0.0, 0.0, -9.81), (481, 3)), rtol=1e-6)
        given = {"damping": 0.7, "response": 0.9, "drag": 1.7, "stretch": 0.02, "bend": 0.8, "side_bend": 0.3}
        for name, number in {**given, "gravity_factor": 0.4}.items():
            np.testing.assert_allclose(getattr(found, name), np.full(4, number), rtol=1e-6, err_msg=name)
        np.testing.assert_allclose(found.sides[0, 1:], np.broadcast_to((1.0, 0.0, 0.0), (3, 3)), atol=1e-6)
        self.assertEqual((found.rate, found.settle, found.loop, found.resets), (480.0, 2.0, False, []))

    def test_the_overlay_looks_for_contacts_by_the_thickness_along_the_chain(self):
        rig = cases.rope(3)
        cases.add(rig, thickness=0.1)
        overlay, groups = support.addon("chains.overlay"), support.addon("chains.groups")
        even = overlay._along(groups.chains(rig))[1]
        rig.motus.chains.entries[0].tip_thickness = 0.5
        thinner = even - overlay._along(groups.chains(rig))[1]
        np.testing.assert_allclose(
            thinner.reshape(3, -1).T, np.broadcast_to(overlay.NEAR * np.array([0.0, 0.025, 0.05]), (overlay.PARTS, 3))
        )

    def test_settings_of_the_rig(self):
        rig = cases.rope(2)
        cases.add(rig)
        settings = rig.motus.chains
        bpy.context.scene.timeline_markers.new("CUT", frame=12)
        (found,) = cases.made(lambda: setattr(settings, "wind", (1.0, 2.0, 3.0)))
        np.testing.assert_allclose(found.air, np.broadcast_to((1.0, 2.0, 3.0), (len(found.times), 3)))
        (found,) = cases.made(lambda: setattr(settings, "gusts", 1.0))
        self.assertGreater(np.ptp(found.air[:, 0]), 0.5)
        gusty = found.air
        (found,) = cases.made(lambda: setattr(settings, "gust_frequency", 0.5))
        self.assertGreater(np.abs(found.air - gusty).max(), 0.5)
        (found,) = cases.made(lambda: setattr(settings, "settle", 0.25))
        self.assertEqual(found.settle, 0.25)
        (found,) = cases.made(lambda: setattr(settings, "use_cuts", True))
        np.testing.assert_allclose(found.times[found.resets], [0.5])
        self.assertFalse(hasattr(found, "touching"))
        _, found = cases.made(lambda: setattr(settings, "use_touch", True))  # the first one counts which links are near each other
        self.assertEqual((found.touching, found.touching_friction), (True, 0.5))
        rig.animation_data_clear()
        _, found = cases.made(lambda: setattr(settings, "use_loop", True))
        self.assertEqual((found.loop, found.resets, found.cycles), (True, None, 40))

    def test_what_was_solved_is_kept_by_what_it_is_made_of(self):
        rig = cases.rope(2)
        (entry,) = cases.add(rig)
        self.assertEqual(cases.made(lambda: setattr(entry, "weight", 0.5)), [])
        self.assertEqual(cases.made(lambda: cases.go_to(30)), [])
        self.assertEqual(len(cases.made(lambda: setattr(entry, "damping", 0.9))), 1)
        self.assertEqual(cases.made(lambda: setattr(entry, "damping", 0.3)), [])

    def test_presets_and_copies(self):
        rig = cases.rope(2, chains=2)
        first, second = cases.add(rig, "Tail 0 0, Tail 1 0")
        self.assertEqual((first.name, second.name), ("Tail 0 0", "Tail 1 0"))
        bpy.context.view_layer.objects.active = rig
        rig.motus.chains.active_entry = 0
        bpy.ops.motus.chains_preset_use(preset='EARRING')
        self.assertEqual((first.frequency, first.tip_mass), (0.0, 4.0))
        self.assertEqual((second.frequency, second.tip_mass), (1.5, 1.0))
        bpy.ops.motus.to_selected(object=rig.name, system="chains", bone="Tail 0 0", bones="Tail 1 0")
        self.assertEqual((second.frequency, second.tip_mass), (0.0, 4.0))

    def test_the_selected_bones_in_pose_mode(self):
        rig = cases.rope(3, chains=2)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='POSE')
        for name in ("Tail 0 0", "Tail 0 2", "Tail 1 1"):
            bone = rig.pose.bones[name]
            (bone if hasattr(bone, "select") else bone.bone).select = True
        bpy.ops.motus.chains_add()
        settings = rig.motus.chains
        self.assertEqual([entry.name for entry in settings.entries], ["Tail 0 0", "Tail 1 1"])
        rig.data.bones.active = rig.data.bones["Tail 1 2"]
        self.assertEqual(settings.active_entry, 1)
        bpy.ops.motus.chains_remove(only_active=True)
        self.assertEqual([entry.name for entry in settings.entries], ["Tail 0 0"])
        bpy.ops.motus.chains_remove()
        self.assertFalse(rig.motus.is_property_set("chains"))
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_refusals(self):
        rig = cases.rope(3)
        with self.assertRaisesRegex(RuntimeError, "has no bone Nobody"):
            cases.add(rig, "Nobody")
        with self.assertRaisesRegex(RuntimeError, "is not an armature"):
            bpy.ops.motus.chains_add(object=support.link("Plain").name)
        with self.assertRaisesRegex(RuntimeError, "has no chains"):
            bpy.ops.motus.chains_remove(object=rig.name)
        with self.assertRaisesRegex(RuntimeError, "topmost bones"):
            bpy.ops.motus.chains_add(object=rig.name)
        cases.add(rig, "Tail 0 1")
        with self.assertRaisesRegex(RuntimeError, "is driven by Chains of Tail 0 1 already"):
            bpy.ops.motus.dynamics_add(object=rig.name, bones="Tail 0 1")
        bpy.ops.motus.chains_remove(object=rig.name)
        bpy.ops.motus.dynamics_add(object=rig.name, bones="Tail 0 2")
        with self.assertRaisesRegex(RuntimeError, "is driven by Dynamics of bone Tail 0 2 already"):
            cases.add(rig, "Tail 0 2")

    def told(self, rig):
        problem = cases.problem(rig)
        return problem and support.addon("chains.told").sentence(rig, problem, bpy.context.scene)

    def test_a_bone_that_is_renamed_or_gone(self):
        rig = cases.rope(3)
        (entry,) = cases.add(rig)
        wanted = cases.matrix(rig, 22, "Tail 0 2")
        rig.data.bones["Tail 0 0"].name = "Top"
        rig.data.bones["Tail 0 1"].name = "Middle"
        bpy.context.view_layer.update()
        self.assertEqual(entry.name, "Top")
        np.testing.assert_allclose(cases.matrix(rig, 22, "Tail 0 2"), wanted, atol=1e-6)
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        rig.data.edit_bones.remove(rig.data.edit_bones["Top"])
        bpy.ops.object.mode_set(mode='OBJECT')
        cases.go_to(23)
        self.assertEqual(self.told(rig), "Rope has no bone Top: remove it from the list")
        np.testing.assert_allclose(cases.tail(rig, 23, "Middle") - cases.place(rig, 23, "Middle"), self.up(rig), atol=1e-5)

    @staticmethod
    def up(rig):
        return cases.LENGTH * np.array(rig.matrix_world.to_3x3())[:, 2]

    def test_what_is_not_known(self):
        rig = cases.rope(2)
        carrier = support.link("Carrier")
        carrier.constraints.new('COPY_LOCATION').target = support.link("Leader")
        rig.parent = carrier
        cases.add(rig)
        self.assertIn("What Tail 0 0 follows needs recording: Carrier has the constraint", self.told(rig))
        bpy.ops.motus.track_record(datablock=rig.name, transform='WORLD', frame_start=1, frame_end=30)
        bpy.ops.motus.track_record(datablock=rig.name, bone="Root", transform='WORLD', frame_start=1, frame_end=30)
        cases.go_to(4)
        self.assertIsNone(self.told(rig))

    def test_a_collider_that_is_not_known(self):
        rig = cases.rope(2)
        ball = support.link("Ball")
        ball.constraints.new('COPY_LOCATION').target = support.link("Leader")
        collection = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(ball)
        cases.add(rig, colliders=collection)
        self.assertIn("collider", self.told(rig))
        bpy.ops.motus.track_record(datablock="Ball", transform='WORLD', frame_start=1, frame_end=30)
        cases.go_to(4)
        self.assertIsNone(self.told(rig))

    def test_a_collider_that_hangs_on_the_chain(self):
        rig = cases.rope(2)
        ball = support.link("Ball", parent=rig)
        ball.parent_type, ball.parent_bone = 'BONE', "Tail 0 1"
        collection = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(ball)
        cases.add(rig, colliders=collection)
        cases.go_to(4)
        self.assertIn("move with what they follow", self.told(rig))

    def test_a_scene_that_is_too_long(self):
        rig = cases.rope(2)
        bpy.context.scene.frame_end = 1_000_000
        cases.add(rig)
        self.assertIn("too long", self.told(rig))

    def test_settling_is_bounded(self):
        rig = cases.rope(2)
        cases.add(rig)
        for frame in range(2, 102):
            bpy.context.scene.timeline_markers.new("cut", frame=frame)
        (found,) = cases.made(lambda: setattr(rig.motus.chains, "settle", 1000.0))
        self.assertEqual(found.settle, 1000.0)
        (found,) = cases.made(lambda: setattr(rig.motus.chains, "use_cuts", True))
        self.assertEqual(len(found.resets), 100)
        self.assertAlmostEqual(found.settle, 0.25 * 1.5e7 / (480 * 2 * 101), places=6)
        self.assertEqual(support.addon("chains.motion").settling(2.0, 0.0, 1, 1.0), 2.0, "what has no links costs nothing")

    def test_numbers_that_no_motion_has(self):
        rig = cases.rope(2)
        (entry,) = cases.add(rig)
        entry["drag"] = 1e9
        rig.update_tag()
        cases.go_to(4)
        self.assertIn("outside of what a motion can be computed from", self.told(rig))

    def test_the_group_says_which_bones(self):
        rig = cases.rope(2, chains=2)
        cases.add(rig, "Root")
        (group,) = support.addon("chains.groups").groups(rig)
        names = ["Root", "Tail 0 0", "Tail 1 0", "Tail 0 1", "Tail 1 1"]
        self.assertEqual(json.loads(group.data["plan"])["chains"], [["Root", names]])
        self.assertEqual([member.thing.name for member in group.members], names)
