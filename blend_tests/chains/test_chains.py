"""Chains of bones that hang and swing: where they are, in any order of frames, at any frame rate, and after they are removed."""

import math

import bpy
import mathutils
import numpy as np

import support
from chains import chain_cases as cases
from dynamics import dynamics_cases

FRAMES = (1, 8, 13.5, 20, 26, 31.25, 90)
LIMP = {"frequency": 0.0, "drag": 0.5}


class ChainsTest(support.SceneTestCase):
    def test_a_limp_chain_at_rest_hangs_straight_down(self):
        rig = cases.rope(4)
        cases.add(rig, **LIMP | {"drag": 2.0}, settle=60.0)
        found = cases.tails(rig, 1, cases.chain(rig)) - cases.place(rig, 1, "Tail 0 0")
        np.testing.assert_allclose(found, [(0.0, 0.0, -cases.LENGTH * (index + 1)) for index in range(4)], atol=2e-3)
        self.assertIsNone(cases.problem(rig))

    def test_a_pose_by_hand_is_followed_at_once(self):
        """A bone that is turned without a key: the chain hangs, settled, from where that brings it."""
        rig = cases.still_rope(5)
        cases.add(rig, frequency=0.0, drag=2.0, settle=60.0)
        cases.go_to(12)
        before = cases.place(rig, 12, "Tail 0 0")
        root = rig.pose.bones["Tail 0 0"].parent
        root.rotation_mode = 'XYZ'
        root.rotation_euler.x = 0.5
        bpy.context.view_layer.update()
        found = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        head, end = (rig.matrix_world @ place for place in (found.pose.bones["Tail 0 0"].head, found.pose.bones["Tail 0 4"].tail))
        self.assertGreater((head - mathutils.Vector(before)).length, 0.05)
        np.testing.assert_allclose(end, head - mathutils.Vector((0.0, 0.0, 5 * cases.LENGTH)), atol=2e-3)

    def test_a_single_bone_without_gravity_follows_as_the_second_order_system_does(self):
        """While it turns little: the tail is held at the bone's length."""
        rig = cases.rope(1, tilt=0.0)
        cases.key(rig.pose.bones["Root"], "location", {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 0.0), 20: (0.02, 0.0, 0.0)})
        plain = {frame: cases.tail(rig, frame, "Tail 0 0") for frame in np.arange(8, 8 * 60) / 8}
        cases.add(rig, frequency=2.0, damping=0.3, gravity=0.0, drag=0.0)
        for frame in (12, 19, 24, 40):
            wanted = dynamics_cases.filtered(
                lambda at: np.stack([np.interp(at, list(plain), [one[axis] for one in plain.values()]) for axis in range(3)], axis=1),
                (2.0, 0.3, 0.0),
                frame,
                last=59,
            )
            self.assertAlmostEqual(cases.tail(rig, frame, "Tail 0 0")[0], wanted[0], delta=0.01 * 0.02)

    def test_the_motion_is_that_of_the_native_module(self):
        rig = cases.rope(3, tilt=0.0)
        names = cases.chain(rig)
        frames = 1.0 + np.arange(int(250 / 24 * 240) + 1) / 10.0
        heads = np.array([(0.0, 0.0, 1.0)]) + self.moves(rig, frames)
        poses = np.stack([heads + (0.0, 0.0, cases.LENGTH * index) for index in range(4)], axis=1)
        settings = {"frequency": 1.2, "damping": 0.2, "response": 0.5, "drag": 0.7}
        cases.add(rig, **settings, tip_frequency=0.5, tip_mass=3.0, gravity=0.5, settle=0.5)
        shares = np.array([0.0, 0.0, 0.5, 1.0])
        settings["frequency"] = 1.2 * (1.0 - 0.5 * shares)
        settings["bend_frequency"] = 4.0 * settings["frequency"]
        wanted = cases.solver()(
            [-1, 0, 1, 2], frames / 24.0, poses, **settings, mass=1.0 + 2.0 * shares, gravity=(0.0, 0.0, -4.905), settle=0.5
        )
        wanted.solve()
        for frame in (1, 14, 19.5, 30, 100):
            np.testing.assert_allclose(cases.tails(rig, frame, names), wanted.places(frame / 24.0)[1:], atol=1e-3)

    @staticmethod
    def moves(rig, frames):
        """How keys move the root bone, (n, 3); its axes are those of the world, in another order."""
        found = dynamics_cases.own(rig.pose.bones["Root"])(frames).locations
        return found @ np.array(rig.data.bones["Root"].matrix_local.to_3x3()).T

    def test_any_frame_in_any_order(self):
        rig = cases.rope(4, chains=2)
        cases.add(rig, "Tail 0 0, Tail 1 0")
        first = {frame: cases.matrix(rig, frame, "Tail 1 3").tobytes() for frame in FRAMES}
        support.addon().forget_all()
        for frame in reversed(FRAMES):
            self.assertEqual(cases.matrix(rig, frame, "Tail 1 3").tobytes(), first[frame])

    def test_the_same_motion_at_every_frame_rate(self):
        found = {}
        for fps in (24, 25, 30, 60):
            support.empty_scene()
            scene = bpy.context.scene
            scene.render.fps, scene.frame_start, scene.frame_end = fps, 0, 4 * fps
            rig = cases.rope(4)
            rig.animation_data_clear()
            cases.key(rig.pose.bones["Root"], "location", {0: (0.0, 0.0, 0.0), fps: (0.0, 0.0, 0.0), 2 * fps: (0.5, 0.0, 0.0)})
            cases.add(rig, frequency=0.7)
            found[fps] = [cases.tails(rig, seconds * fps, cases.chain(rig)) for seconds in (0.5, 1.0, 1.4, 2.0, 3.0, 4.0)]
        for fps in (25, 30, 60):
            np.testing.assert_allclose(found[fps], found[24], atol=1e-6)

    def test_removal_leaves_nothing(self):
        rig = cases.rope(3)
        before = {frame: cases.matrix(rig, frame, "Tail 0 2").tobytes() for frame in FRAMES}
        cases.add(rig)
        self.assertNotEqual(cases.matrix(rig, 20, "Tail 0 2").tobytes(), before[20])
        bpy.ops.motus.chains_remove(object=rig.name)
        self.assertFalse(rig.pose.bones["Tail 0 0"].constraints)
        self.assertFalse(rig.motus.is_property_set("chains"))
        self.assertEqual({frame: cases.matrix(rig, frame, "Tail 0 2").tobytes() for frame in FRAMES}, before)

    def test_bake_and_unbake(self):
        rig = cases.rope(3)
        cases.add(rig)
        live = {frame: cases.matrix(rig, frame, "Tail 0 2") for frame in (1, 15, 30)}
        bpy.context.view_layer.objects.active = rig
        bpy.ops.motus.bake(frame_start=1, frame_end=30)
        for frame, wanted in live.items():
            np.testing.assert_allclose(cases.matrix(rig, frame, "Tail 0 2"), wanted, atol=1e-5)
        bpy.ops.motus.unbake()
        for frame, wanted in live.items():
            np.testing.assert_array_equal(cases.matrix(rig, frame, "Tail 0 2"), wanted)

    def test_a_branching_chain(self):
        rig = cases.rope(2, chains=2)
        found = cases.add(rig, "Root", **LIMP, settle=60.0)
        self.assertEqual([entry.name for entry in found], ["Root"])
        for name in ("Tail 0 1", "Tail 1 1"):
            head, end = cases.place(rig, 240, name), cases.tail(rig, 240, name)
            self.assertAlmostEqual(np.linalg.norm(end - head), cases.LENGTH, places=5)
            self.assertLess(end[2], head[2])

    def test_the_weight_blends(self):
        rig = cases.rope(3)
        plain = cases.tail(rig, 18, "Tail 0 0")
        (entry,) = cases.add(rig, **LIMP)
        full = cases.tail(rig, 18, "Tail 0 0")
        entry.weight = 0.5
        between = cases.tail(rig, 18, "Tail 0 0")
        self.assertGreater(np.linalg.norm(between - full), 0.05)
        self.assertGreater(np.linalg.norm(between - plain), 0.05)
        entry.is_muted = True
        np.testing.assert_allclose(cases.tail(rig, 18, "Tail 0 0"), plain, atol=1e-6)
        entry.is_muted, entry.weight = False, 1.0
        rig.motus.chains.influence = 0.0
        np.testing.assert_allclose(cases.tail(rig, 18, "Tail 0 0"), plain, atol=1e-6)

    def test_wind_carries_what_has_drag(self):
        rig = cases.rope(3)
        cases.add(rig, frequency=0.0, drag=4.0, settle=30.0, wind=(0.0, 2.0, 0.0))
        way = cases.tail(rig, 1, "Tail 0 0") - cases.place(rig, 1, "Tail 0 0")
        # At rest gravity and the drag of the air are in balance with the pull of the bone.
        self.assertAlmostEqual(way[1] / -way[2], 4.0 * 2.0 / 9.81, places=2)

    def test_wind_that_is_keyed(self):
        rig = cases.rope(3)
        rig.animation_data_clear()
        cases.add(rig, frequency=0.0, drag=4.0)
        for frame, wind in ((1, (0.0, 0.0, 0.0)), (60, (0.0, 0.0, 0.0)), (61, (3.0, 0.0, 0.0))):
            rig.motus.chains.wind = wind
            rig.keyframe_insert("motus.chains.wind", frame=frame)
        self.assertLess(abs((cases.tail(rig, 60, "Tail 0 0") - cases.place(rig, 60, "Tail 0 0"))[0]), 1e-3)
        blown = cases.tail(rig, 200, "Tail 0 0") - cases.place(rig, 200, "Tail 0 0")
        self.assertAlmostEqual(blown[0] / -blown[2], 4.0 * 3.0 / 9.81, delta=0.1)
        self.assertIsNone(cases.problem(rig))
        support.addon().forget_all()
        np.testing.assert_array_equal(cases.tail(rig, 200, "Tail 0 0") - cases.place(rig, 200, "Tail 0 0"), blown)
        rig.animation_data_clear()
        rig.driver_add("motus.chains.wind", 0).driver.expression = "frame"
        bpy.context.view_layer.update()
        cases.go_to(5)
        self.assertIn("wind", cases.problem(rig).sentence)

    def test_gusts_change_the_wind_and_close_in_a_loop(self):
        motion = support.addon("chains.motion")
        seconds = np.linspace(1.0 / 24.0, 5.0 + 1.0 / 24.0, 1201)
        wind = np.broadcast_to((2.0, 0.0, 0.0), (1201, 3))
        for is_loop in (False, True):
            found = motion.with_gusts(wind, seconds, 1.0, 0.3, is_loop)
            self.assertGreater(np.ptp(found[:, 0]), 1.0)
            self.assertTrue((found[:, 0] >= 0.0).all())
            self.assertFalse(np.array_equal(found, motion.with_gusts(wind, seconds, 1.0, 0.6, is_loop)))
        np.testing.assert_allclose(found[-1], found[0], atol=1e-9)

    def test_a_loop_closes(self):
        rig = cases.rope(3)
        rig.animation_data_clear()
        bpy.context.scene.frame_end = 60
        root = rig.pose.bones["Root"]
        cases.key(root, "location", {1: (0.0, 0.0, 0.0), 20: (0.3, 0.0, 0.0), 61: (0.0, 0.0, 0.0)})
        cases.add(rig, frequency=1.0, use_loop=True)
        self.assertIsNone(cases.problem(rig))
        np.testing.assert_allclose(cases.tails(rig, 61, cases.chain(rig)), cases.tails(rig, 1, cases.chain(rig)), atol=1e-3)
        steps = np.diff([cases.tail(rig, frame, "Tail 0 2") for frame in (59, 60, 61, 62, 63)], axis=0)
        self.assertLess(np.abs(np.diff(steps, axis=0)).max(), 0.02)
        cases.key(root, "location", {61: (0.2, 0.0, 0.0)})
        cases.go_to(5)
        self.assertIn("come back", cases.problem(rig).sentence)

    def test_a_loop_closes_at_any_frame_rate(self):
        """Where the loop's length is no whole number of the solver's samples."""
        scene = bpy.context.scene
        rig = cases.still_rope(5)
        for frames, fps in ((12, 25), (17, 24000 / 1001), (30, 30)):
            with self.subTest(fps=fps):
                scene.render.fps, scene.render.fps_base = math.ceil(fps), math.ceil(fps) / fps
                scene.frame_start, scene.frame_end = 1, frames
                rig.animation_data_clear()
                rig.motus.property_unset("chains")
                for frame, turn in ((1, 0.0), (1 + frames / 2, 0.6), (1 + frames, 0.0)):
                    rig.pose.bones["Root"].rotation_mode = 'XYZ'
                    rig.pose.bones["Root"].rotation_euler.x = turn
                    rig.pose.bones["Root"].keyframe_insert("rotation_euler", frame=frame)
                cases.add(rig, frequency=1.0, damping=0.5, drag=1.0, use_loop=True)
                cases.go_to(1)
                self.assertIsNone(cases.problem(rig))
                first, last = (cases.tails(rig, frame, cases.chain(rig)) for frame in (1, 1 + frames))
                np.testing.assert_allclose(last, first, atol=1e-4)
                bpy.ops.motus.chains_remove(object=rig.name)

    def test_two_cuts_at_once_are_one(self):
        rig = cases.rope(3)
        for name in ("cut", "Cut to the chase"):
            bpy.context.scene.timeline_markers.new(name, frame=20)
        cases.add(rig, use_cuts=True)
        cases.go_to(25)
        self.assertIsNone(cases.problem(rig))

    def test_chains_start_anew_at_cuts(self):
        rig = cases.rope(3)
        rig.animation_data_clear()
        cases.key(rig.pose.bones["Root"], "location", {1: (0.0, 0.0, 0.0), 40: (0.5, 0.0, 0.0)}, 'pose.bones["Root"].', 'CONSTANT')
        scene = bpy.context.scene
        scene.timeline_markers.new("Cut to the garden", frame=40)
        scene.timeline_markers.new("Other", frame=50)
        cases.add(rig, **LIMP, settle=20.0)
        swinging = cases.tail(rig, 41, "Tail 0 2") - cases.place(rig, 41, "Tail 0 0")
        self.assertGreater(np.linalg.norm(swinging[:2]), 0.3)
        rig.motus.chains.use_cuts = True
        for frame in (39.9, 40, 41, 60):
            hanging = cases.tail(rig, frame, "Tail 0 2") - cases.place(rig, frame, "Tail 0 0")
            self.assertLess(np.linalg.norm(hanging[:2]), 0.05, frame)

    def test_colliders_are_not_entered(self):
        rig = cases.rope(4)
        start = cases.place(rig, 1, "Tail 0 0")
        middle = start + (0.05, 0.0, -0.45)
        ball = support.link("Ball", location=middle)
        ball.empty_display_type, ball.empty_display_size, ball.scale = 'SPHERE', 0.1, (2.0, 2.0, 2.0)
        ground = support.link("Ground", location=(0.0, 0.0, start[2] - 0.9))
        collection = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(ball)
        collection.objects.link(ground)
        cases.add(rig, **LIMP, thickness=0.02, settle=10.0, colliders=collection)
        self.assertIsNone(cases.problem(rig))
        for frame in (1, 13, 17, 25, 60):
            found = cases.tails(rig, frame, cases.chain(rig))
            self.assertGreater(np.linalg.norm(found - middle, axis=1).min(), 0.215, frame)
            self.assertGreater(found[:, 2].min(), start[2] - 0.9 + 0.015, frame)
        before = cases.tail(rig, 25, "Tail 0 3")
        ground.location.z += 0.3
        self.assertGreater(np.linalg.norm(cases.tail(rig, 25, "Tail 0 3") - before), 0.01)
        collection.objects.unlink(ball)
        bpy.context.view_layer.update()
        cases.go_to(26)
        self.assertLess(np.linalg.norm(cases.tails(rig, 2, cases.chain(rig)) - middle, axis=1).min(), 0.2)

    def test_gravity_of_the_scene(self):
        rig = cases.rope(1)
        bpy.context.scene.gravity = (9.81, 0.0, 0.0)
        cases.add(rig, **LIMP, settle=60.0)
        way = cases.tail(rig, 1, "Tail 0 0") - cases.place(rig, 1, "Tail 0 0")
        np.testing.assert_allclose(way, (cases.LENGTH, 0.0, 0.0), atol=2e-2)
        plain = np.array(rig.matrix_world.to_3x3())[:, 2] * cases.LENGTH
        bpy.context.scene.use_gravity = False
        way = cases.tail(rig, 2, "Tail 0 0") - cases.place(rig, 2, "Tail 0 0")
        np.testing.assert_allclose(way, plain, atol=1e-5)

    def test_the_bend_limit(self):
        rig = cases.rope(2)
        cases.add(rig, **LIMP, bend_limit=math.radians(30.0), settle=5.0)
        first, second = (cases.tail(rig, 18, name) - cases.place(rig, 18, name) for name in cases.chain(rig))
        self.assertLess(first @ second / cases.LENGTH**2, 1.0)
        self.assertGreater(first @ second / cases.LENGTH**2, math.cos(math.radians(31.0)))
