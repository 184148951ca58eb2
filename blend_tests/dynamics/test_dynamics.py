"""Objects that follow their animation."""

import math

import bpy
import numpy as np

import support
from dynamics import dynamics_cases as cases

BOUNCY = 2.0, 0.3, 0.0


class DynamicsTest(support.SceneTestCase):
    def test_location_is_the_filter_of_the_keys(self):
        ball = cases.moved()
        cases.add(ball, style='BOUNCY')
        for frame in cases.FRAMES:
            wanted = cases.filtered(lambda frames: cases.own(ball)(frames).locations, BOUNCY, frame)
            np.testing.assert_allclose(cases.place(ball, frame), wanted, atol=3e-4)

    def test_a_frame_is_the_same_bits_whichever_came_before(self):
        ball = cases.moved()
        cases.key(ball, "rotation_euler", {1: (0.0, 0.0, 0.0), 20: (1.0, 0.4, -2.0)})
        cases.key(ball, "scale", {1: (1.0, 1.0, 1.0), 20: (2.0, 0.5, 1.0)})
        cases.add(ball, channels={'LOCATION', 'ROTATION', 'SCALE'})
        first = {frame: cases.matrix(ball, frame).tobytes() for frame in cases.FRAMES}
        for frame in (*reversed(cases.FRAMES), 20, 1200, 20, 5000):
            found = cases.matrix(ball, frame).tobytes()
            self.assertEqual(found, first.setdefault(frame, found))
        self.assertEqual(cases.matrix(ball, 20).tobytes(), first[20])

    def test_rotation_and_scale_follow(self):
        for mode in ('XYZ', 'QUATERNION', 'AXIS_ANGLE'):
            with self.subTest(mode=mode):
                ball = cases.link(f"Ball {mode}")
                ball.rotation_mode = mode
                path, rows = {
                    'XYZ': ("rotation_euler", {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 1.2)}),
                    'QUATERNION': ("rotation_quaternion", {1: (1.0, 0.0, 0.0, 0.0), 10: (math.cos(0.6), 0.0, 0.0, math.sin(0.6))}),
                    'AXIS_ANGLE': ("rotation_axis_angle", {1: (0.0, 0.0, 0.0, 1.0), 10: (1.2, 0.0, 0.0, 1.0)}),
                }[mode]
                cases.key(ball, path, rows)
                cases.key(ball, "scale", {1: (1.0, 1.0, 1.0), 10: (2.0, 1.0, 1.0)})
                cases.add(ball, channels={'ROTATION', 'SCALE'}, frequency=2.0, damping=0.3, response=0.0)

                def angles(frames, ball=ball):
                    turns = cases.own(ball)(frames).rotations
                    return 2.0 * np.arctan2(turns[:, 3], turns[:, 0])

                for frame in (6, 11, 14, 40):
                    matrix = cases.matrix(ball, frame)
                    size = np.linalg.norm(matrix[:3, 0])
                    angle = math.atan2(matrix[1, 0], matrix[0, 0])
                    self.assertAlmostEqual(angle, cases.filtered(angles, BOUNCY, frame), delta=1e-4)
                    wanted = cases.filtered(lambda frames, ball=ball: cases.own(ball)(frames).scales[:, 0], BOUNCY, frame)
                    self.assertAlmostEqual(size, wanted, delta=1e-4)

    def test_what_rests_stays_where_it_is(self):
        ball = cases.link("Ball")
        ball.location, ball.rotation_euler, ball.scale = (1.0, 2.0, 3.0), (0.3, -1.0, 2.0), (-1.0, 2.0, 0.5)
        before = cases.matrix(ball, 5)
        cases.add(ball, channels={'LOCATION', 'ROTATION', 'SCALE'})
        np.testing.assert_allclose(cases.matrix(ball, 5), before, atol=1e-6)

    def test_a_mirrored_object_turns_as_one_that_is_not(self):
        plain, mirrored = cases.link("Plain"), cases.link("Mirrored")
        mirrored.scale = (-1.0, 1.0, 1.0)
        for ball in (plain, mirrored):
            cases.key(ball, "rotation_euler", {1: (0.0, 0.0, 0.0), 10: (0.7, -0.4, 1.2)})
            cases.add(ball, channels={'ROTATION'})
        for frame in (6, 12, 15):
            turned = cases.matrix(plain, frame)[:3, :3] @ np.diag((-1.0, 1.0, 1.0))
            np.testing.assert_allclose(np.abs(cases.matrix(mirrored, frame)[:3, :3]), np.abs(turned), atol=1e-4)

    def test_weight_influence_mute_and_delay(self):
        ball = cases.moved()
        entry = cases.add(ball, style='BOUNCY')[0]
        full, own = cases.place(ball, 22), np.array(cases.STEP[20])
        entry.weight = 0.5
        np.testing.assert_allclose(cases.place(ball, 22), 0.5 * (full + own), atol=1e-6)
        entry.weight, ball.motus.dynamics.influence = 1.0, 0.25
        np.testing.assert_allclose(cases.place(ball, 22), own + 0.25 * (full - own), atol=1e-6)
        ball.motus.dynamics.influence, entry.is_muted = 1.0, True
        np.testing.assert_allclose(cases.place(ball, 22), own, atol=1e-6)
        entry.is_muted, entry.delay = False, 0.25  # six frames
        np.testing.assert_allclose(cases.place(ball, 28), full, atol=1e-6)

    def test_a_delay_while_it_moves(self):
        """Nothing of the animation is left at its own time."""
        ball = cases.moved()
        cases.key(ball, "rotation_euler", {1: (0.0, 0.0, 0.0), 10: (0.0, 0.0, 0.0), 20: (0.0, 0.0, 1.2)})
        cases.key(ball, "scale", {1: (1.0, 1.0, 1.0), 10: (1.0, 1.0, 1.0), 20: (2.0, 1.0, 1.0)})
        cases.add(ball, style='BOUNCY', delay=0.25, channels={'LOCATION', 'ROTATION', 'SCALE'})
        values = cases.own(ball)
        for frame in (14, 17, 23.5):
            found = cases.matrix(ball, frame)
            np.testing.assert_allclose(found[:3, 3], cases.filtered(lambda frames: values(frames).locations, BOUNCY, frame - 6), atol=3e-4)
            turns = cases.filtered(lambda frames: 2.0 * np.arctan2(*values(frames).rotations[:, [3, 0]].T), BOUNCY, frame - 6)
            self.assertAlmostEqual(math.atan2(found[1, 0], found[0, 0]), turns, delta=3e-4)
            wanted = cases.filtered(lambda frames: values(frames).scales[:, 0], BOUNCY, frame - 6)
            self.assertAlmostEqual(np.linalg.norm(found[:3, 0]), wanted, delta=3e-4)

    def test_a_keyed_weight(self):
        ball = cases.moved()
        entry = cases.add(ball, style='BOUNCY')[0]
        full = cases.place(ball, 24)
        for frame, weight in ((20, 0.0), (28, 1.0)):
            entry.weight = weight
            entry.keyframe_insert("weight", frame=frame)
        support.addon("core.blender.actions").find(ball, entry.path_from_id("weight")).keyframe_points[0].interpolation = 'LINEAR'
        own = np.array(cases.STEP[20])
        np.testing.assert_allclose(cases.place(ball, 24), 0.5 * (full + own), atol=1e-5)
        np.testing.assert_allclose(cases.place(ball, 19.99), cases.own(ball)(np.array([19.99])).locations[0], atol=1e-4)

    def test_edits_of_keys_and_settings_count_at_once(self):
        ball = cases.moved()
        entry = cases.add(ball, style='BOUNCY')[0]
        before = cases.place(ball, 22)
        cases.key(ball, "location", {20: (0.0, 5.0, 0.0)})
        changed = cases.place(ball, 22)
        self.assertGreater(np.abs(changed - before).max(), 1.0)
        entry.style = 'CRITICAL'
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(cases.place(ball, 22) - changed).max(), 0.1)

    def test_the_frame_rate_changes_nothing(self):
        """Of what is keyed less than 1e-3 of the amplitude; of what is linear between frames nothing."""
        scene = bpy.context.scene
        places = {}
        for fps in (12, 24, 48, 96):
            scene.render.fps = fps
            for name, kind in (("Smooth", 'BEZIER'), ("Straight", 'LINEAR'), ("Stepped", 'CONSTANT')):
                rows = {1: (0.0, 0.0, 0.0), 1 + fps // 2: (3.0, 0.0, 0.0), 1 + fps: (-1.0, 0.0, 0.0)}
                ball = cases.moved(f"{name} {fps}", rows, interpolation=kind)
                cases.add(ball, style='BOUNCY')
                places[name, fps] = [cases.place(ball, 1 + fps * seconds)[0] for seconds in (0.25, 0.5, 0.75, 1.25, 1.5)]
        for (name, fps), found in places.items():
            bound = {"Smooth": 4e-3, "Straight": 2e-6, "Stepped": 4e-3}[name]
            np.testing.assert_allclose(found, places[name, 96], atol=bound, err_msg=f"{name} {fps}")

    def test_a_loop_over_the_scene_in_stretched_time(self):
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 2, 81
        scene.render.frame_map_old, scene.render.frame_map_new = 100, 200
        ball = cases.moved(rows={1: (0.0, 0.0, 0.0), 20: (3.0, 0.0, 0.0), 41: (0.0, 0.0, 0.0)})
        cases.add(ball, style='BOUNCY')
        bpy.ops.motus.dynamics_loop(object="Ball")
        entry = ball.motus.dynamics.entries[0]
        self.assertEqual((entry.loop_start, entry.loop_end), (1, 41))
        np.testing.assert_allclose(cases.matrix(ball, 2), cases.matrix(ball, 82), atol=1e-5)

    def test_a_loop_has_no_seam(self):
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 1, 40
        ball = cases.moved(rows={1: (0.0, 0.0, 0.0), 20: (3.0, 0.0, 0.0), 41: (0.0, 0.0, 0.0)})
        cases.key(ball, "rotation_euler", {1: (0.0, 0.0, 0.0), 20: (0.0, 1.0, 0.0), 41: (0.0, 0.0, 0.0)})
        cases.add(ball, style='BOUNCY')
        self.assertGreater(np.abs(cases.matrix(ball, 1) - cases.matrix(ball, 41)).max(), 0.05)
        bpy.ops.motus.dynamics_loop(object="Ball")
        entry = ball.motus.dynamics.entries[0]
        self.assertEqual((entry.use_loop, entry.loop_start, entry.loop_end), (True, 1, 41))
        np.testing.assert_allclose(cases.matrix(ball, 1), cases.matrix(ball, 41), atol=1e-5)
        speeds = [cases.place(ball, frame + 0.125) - cases.place(ball, frame) for frame in (1, 40.875)]
        np.testing.assert_allclose(speeds[0], speeds[1], atol=5e-3)
        self.assertIsNone(cases.problem(ball))
        cases.key(ball, "rotation_euler", {41: (0.0, 0.5, 0.0)})
        cases.go_to(5)
        self.assertIn("loop", cases.problem(ball).sentence)

    def test_teleports_start_anew(self):
        rows = {1: (0.0, 0.0, 0.0), 10: (1.0, 0.0, 0.0), 11: (100.0, 0.0, 0.0)}
        for kind in ('LINEAR', 'CONSTANT'):
            with self.subTest(kind=kind):
                ball = cases.moved(kind, rows, interpolation=kind)
                entry = cases.add(ball, style='BOUNCY')[0]
                self.assertGreater(abs(cases.place(ball, 14)[0] - 100.0), 5.0)
                entry.jump = 5.0
                bpy.context.view_layer.update()
                for frame in (11, 14, 20):
                    self.assertAlmostEqual(cases.place(ball, frame)[0], 100.0, places=4)

    def test_world_motion_takes_parents_along(self):
        for kind in ('OBJECT', 'BONE'):
            with self.subTest(kind=kind):
                parent = cases.moved(f"Carrier {kind}") if kind == 'OBJECT' else cases.rope(1, name="Carrier")
                ball = cases.link(f"Ball {kind}", parent=parent)
                ball.location = (0.5, 0.0, 0.0)
                if kind == 'BONE':
                    ball.parent_type, ball.parent_bone = 'BONE', "Root"
                parent.rotation_euler = (0.3, 0.7, -1.0)
                parent.scale = (2.0, 2.0, 2.0)
                plain = np.array([cases.place(ball, frame) for frame in np.arange(8, 8 * 40) / 8])
                entry = cases.add(ball, style='BOUNCY')[0]
                self.assertEqual(entry.follow, 'WORLD')
                for frame in (15, 20, 25):
                    wanted = cases.filtered(
                        lambda frames, plain=plain: np.stack(
                            [np.interp(frames, np.arange(8, 8 * 40) / 8, plain[:, axis]) for axis in range(3)], axis=1
                        ),
                        BOUNCY,
                        frame,
                    )
                    np.testing.assert_allclose(cases.place(ball, frame), wanted, atol=2e-3)

    def test_an_object_on_a_bone_by_its_own_animation(self):
        rig = cases.rope(1)
        ball = cases.moved("Ball")
        ball.parent, ball.parent_type, ball.parent_bone = rig, 'BONE', "Root"
        rig.pose.bones["Root"].rotation_mode = 'XYZ'
        rig.pose.bones["Root"].rotation_euler = (0.8, 0.3, 0.0)
        cases.add(ball, style='BOUNCY', follow='OWN')
        for frame in (16, 22, 30):
            depsgraph = cases.go_to(frame)
            evaluated = rig.evaluated_get(depsgraph)
            bone = evaluated.matrix_world @ evaluated.pose.bones["Root"].matrix
            wanted = cases.filtered(lambda frames: cases.own(ball)(frames).locations, BOUNCY, frame)
            found = np.array(bone.inverted() @ ball.evaluated_get(depsgraph).matrix_world)[:3, 3] - (0.0, 1.0, 0.0)
            np.testing.assert_allclose(found, wanted, atol=3e-4)

    def test_dynamics_on_dynamics(self):
        """What hangs on an object with dynamics follows where that really is, exactly."""
        parent = cases.moved("Parent")
        cases.add(parent, style='BOUNCY')
        child = cases.link("Child", parent=parent)
        child.location.z = 1.0
        plain = np.array([cases.place(child, frame) for frame in np.arange(8, 8 * 60) / 8])
        cases.add(child, style='CRITICAL')
        self.assertIsNone(cases.problem(child))
        track = support.addon("core.tracks").world_track(parent, bpy.context.scene)
        self.assertIn("Dynamics", track.sentence)
        for frame in (12, 20, 30):
            np.testing.assert_allclose(track.values([frame])[0][:3, 3], cases.place(parent, frame), atol=1e-5)
            wanted = cases.filtered(
                lambda frames: np.stack([np.interp(frames, np.arange(8, 8 * 60) / 8, plain[:, axis]) for axis in range(3)], axis=1),
                (2.0, 1.0, 0.0),
                frame,
            )
            np.testing.assert_allclose(cases.place(child, frame), wanted, atol=2e-3)

    def test_a_child_of_what_follows_a_path(self):
        curve = bpy.data.curves.new("Course", 'CURVE')
        curve.dimensions = '3D'
        spline = curve.splines.new('BEZIER')
        spline.bezier_points.add(1)
        spline.bezier_points[1].co = (10.0, 0.0, 0.0)
        cases.link("Course", curve)
        car, flag = cases.link("Car"), None
        bpy.ops.motus.path_follow_add(object="Car", curve="Course", duration=2.0)
        flag = cases.link("Flag", parent=car)
        before = cases.place(flag, 20)
        cases.add(flag, style='HEAVY')
        self.assertIsNone(cases.problem(flag))
        self.assertGreater(np.abs(cases.place(flag, 20) - before).max(), 0.1)
        with self.assertRaisesRegex(RuntimeError, "driven by"):
            cases.add(car)

    def test_what_is_not_known_ahead_is_recorded(self):
        ball, guide = cases.link("Ball"), cases.moved("Guide")
        carrier = cases.link("Carrier")
        cases.add(guide, style='CRITICAL')  # what was recorded from has settings of ours too
        carrier.constraints.new('COPY_LOCATION').target = guide
        ball.parent = carrier
        plain = np.array([cases.place(ball, frame) for frame in range(1, 60)])
        cases.add(ball, style='BOUNCY')
        self.assertIn("record", cases.problem(ball).sentence)
        np.testing.assert_allclose(cases.place(ball, 22), plain[21], atol=1e-6)
        bpy.ops.motus.track_record(datablock="Carrier", transform='WORLD', frame_start=1, frame_end=60)
        cases.go_to(22)
        self.assertIsNone(cases.problem(ball))
        wanted = cases.filtered(
            lambda frames: np.stack([np.interp(frames, np.arange(1, 60), plain[:, axis]) for axis in range(3)], axis=1), BOUNCY, 22
        )
        np.testing.assert_allclose(cases.place(ball, 22), wanted, atol=1e-4)

    def test_bake_and_unbake(self):
        ball = cases.moved()
        cases.key(ball, "rotation_euler", {1: (0.0, 0.0, 0.0), 20: (0.0, 1.0, 0.4)})
        cases.add(ball, style='BOUNCY')
        live = {frame: cases.matrix(ball, frame) for frame in (5, 15, 22, 30)}
        bpy.ops.motus.bake(object="Ball", frame_start=1, frame_end=40)
        for frame, wanted in live.items():
            np.testing.assert_allclose(cases.matrix(ball, frame), wanted, atol=1e-5)
        bpy.ops.motus.unbake(object="Ball")
        for frame, wanted in live.items():
            np.testing.assert_allclose(cases.matrix(ball, frame), wanted, atol=1e-6)

    def test_removed_it_leaves_nothing(self):
        ball = cases.moved()
        before = {frame: cases.matrix(ball, frame) for frame in cases.FRAMES}
        cases.add(ball)
        bpy.ops.motus.dynamics_remove(object="Ball")
        for frame, wanted in before.items():
            np.testing.assert_array_equal(cases.matrix(ball, frame), wanted)
        self.assertFalse(ball.constraints)
        self.assertFalse(ball.is_property_set("motus"))
        self.assertEqual([obj.name for obj in bpy.data.objects], ["Ball"])
        self.assertFalse(bpy.data.meshes)

    def test_saved_and_opened_again_and_copied(self):
        ball = cases.moved()
        cases.add(ball, style='BOUNCY')
        wanted = cases.place(ball, 22)
        path = str(self.folder / "dynamics.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        ball = bpy.data.objects["Ball"]
        np.testing.assert_array_equal(cases.place(ball, 22), wanted)
        copy = ball.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        np.testing.assert_array_equal(cases.place(copy, 22), wanted)
        self.assertNotEqual(copy.motus.dynamics.hub, ball.motus.dynamics.hub)
