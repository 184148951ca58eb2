"""How dynamics are set, given, refused and taken back; what is wrong with what is given."""

import math

import bpy
import numpy as np

import support
from dynamics import dynamics_cases as cases


class DynamicsSettingsTest(support.SceneTestCase):
    def test_overshoot_and_settling_both_ways(self):
        entry = cases.add(cases.moved(), frequency=1.5, damping=0.4, response=0.0)[0]
        filter = cases.native().SecondOrder(1.5, 0.4, 0.0)
        self.assertAlmostEqual(entry.overshoot, math.exp(-math.pi * 0.4 / math.sqrt(1.0 - 0.16)), places=5)
        self.assertAlmostEqual(entry.settling, filter.settling_time(), places=4)
        settling = entry.settling
        entry.overshoot = 0.1
        self.assertAlmostEqual(entry.overshoot, 0.1, places=4)
        self.assertAlmostEqual(entry.settling, settling, places=3)
        entry.settling = 3.0
        self.assertAlmostEqual(entry.overshoot, 0.1, places=4)
        self.assertAlmostEqual(entry.settling, 3.0, places=3)
        entry.overshoot = 0.0
        self.assertEqual((entry.damping, entry.overshoot), (1.0, 0.0))

    def test_mass_and_spring_both_ways(self):
        entry = cases.add(cases.moved(), mass=2.0, stiffness=80.0, resistance=6.0)[0]
        filter = cases.native().SecondOrder.from_mass_spring(2.0, 80.0, 6.0)
        np.testing.assert_allclose((entry.frequency, entry.damping, entry.response), (filter.frequency, filter.damping, 2.0), rtol=1e-5)
        np.testing.assert_allclose((entry.mass, entry.stiffness, entry.resistance), (2.0, 80.0, 6.0), rtol=1e-5)
        entry.stiffness = 20.0
        self.assertAlmostEqual(entry.frequency, math.sqrt(10.0) / math.tau, places=5)
        self.assertAlmostEqual(entry.resistance, 6.0, places=4)

    def test_styles(self):
        entry = cases.add(cases.moved(), style='JELLY')[0]
        self.assertEqual(entry.style, 'JELLY')
        for name in support.addon("dynamics.styles").NUMBERS:
            entry.style = name
            self.assertEqual(entry.style, name)
        entry.damping += 0.01
        self.assertEqual(entry.style, 'CUSTOM')

    def test_overshoot_and_settling_as_keywords(self):
        entry = cases.add(cases.moved(), overshoot=0.3, settling=2.0)[0]
        self.assertAlmostEqual(entry.overshoot, 0.3, places=4)
        self.assertAlmostEqual(entry.settling, 2.0, places=3)

    def test_the_selection(self):
        balls = [cases.moved(name) for name in ("One", "Two", "Three")]
        for ball in balls[:2]:
            ball.select_set(True)
        bpy.context.view_layer.objects.active = balls[0]
        bpy.ops.motus.dynamics_add(style='BOUNCY')
        self.assertEqual([len(ball.motus.dynamics.entries) for ball in balls], [1, 1, 0])
        bpy.ops.motus.dynamics_remove()
        self.assertEqual([len(ball.motus.dynamics.entries) for ball in balls], [0, 0, 0])

    def test_added_again_it_is_changed(self):
        ball = cases.moved()
        cases.add(ball, style='BOUNCY', delay=0.2)
        entries = cases.add(ball, frequency=5.0)
        self.assertEqual(len(entries), 1)
        np.testing.assert_allclose((entries[0].frequency, entries[0].damping, entries[0].delay), (5.0, 0.3, 0.2), rtol=1e-6)

    def test_two_ways_at_once(self):
        ball = cases.moved()
        for keywords in (
            {"overshoot": 0.2, "mass": 1.0},
            {"frequency": 2.0, "settling": 1.0},
            {"damping": 0.3, "stiffness": 9.0},
            {"response": 1.0, "mass": 1.0},
            {"style": 'JELLY', "overshoot": 0.2},
        ):
            with self.subTest(**keywords), self.assertRaisesRegex(RuntimeError, "in two ways"):
                cases.add(ball, **keywords)
        self.assertFalse(ball.is_property_set("motus"))

    def test_what_presets_keep_says_the_motion_in_one_way(self):
        kept = [
            prop.identifier for prop in bpy.ops.motus.dynamics_add.get_rna_type().properties if not (prop.is_hidden or prop.is_skip_save)
        ]
        self.assertIn("frequency", kept)
        for name in ("overshoot", "settling", "mass", "stiffness", "resistance"):
            self.assertNotIn(name, kept)

    def test_names_that_name_nothing(self):
        rig = cases.rope(1)
        for bones in (",", " , "):
            with self.assertRaisesRegex(RuntimeError, "No bone is named"):
                cases.add(rig, bones=bones)
        cases.add(rig, bones="Root")
        with self.assertRaisesRegex(RuntimeError, "No bone is named"):
            bpy.ops.motus.dynamics_remove(object=rig.name, bones=",")
        self.assertEqual(len(rig.motus.dynamics.entries), 1)

    def test_a_loop_that_ends_before_it_begins(self):
        ball = cases.moved()
        with self.assertRaisesRegex(RuntimeError, "before it begins"):
            cases.add(ball, use_loop=True, loop_start=50, loop_end=10)
        entry = cases.add(ball, use_loop=True)[0]
        for start, end in ((60, 10), (60, 60)):
            entry.loop_start, entry.loop_end = start, end
            cases.go_to(22)
            self.assertIn("before it begins", cases.problem(ball).sentence)
        entry.loop_end = 90
        cases.go_to(22)
        self.assertNotIn("before it begins", cases.problem(ball).sentence if cases.problem(ball) else "")

    def test_the_marked_entry_alone_is_taken_back(self):
        rig = cases.rope(2)
        cases.add(rig)
        cases.add(rig, bones="Tail 0 0")
        rig.motus.dynamics.active_entry = 0
        bpy.ops.motus.dynamics_loop(object=rig.name, only_active=True)
        self.assertEqual([entry.use_loop for entry in rig.motus.dynamics.entries], [True, False])
        bpy.ops.motus.dynamics_remove(object=rig.name, only_active=True)
        self.assertEqual([entry.name for entry in rig.motus.dynamics.entries], ["Tail 0 0"])

    def test_what_has_to_be_recorded_is_named(self):
        rig, target = cases.rope(2), cases.moved("Target")
        rig.pose.bones["Root"].constraints.new('DAMPED_TRACK').target = target
        cases.add(rig, bones="Tail 0 0")
        told = support.addon("dynamics.told").sentence(rig, cases.problem(rig), bpy.context.scene)
        self.assertEqual(told, "What Tail 0 0 follows needs recording: Root has the constraint Damped Track")
        cases.add(rig, bones="Tail 0 1")
        rig.motus.dynamics.entries[0].is_muted = True
        told = support.addon("dynamics.told").sentence(rig, cases.problem(rig), bpy.context.scene)
        self.assertTrue(told.startswith("What Tail 0 1 follows"), told)

    def test_bad_numbers(self):
        ball = cases.moved()
        for keywords in ({"frequency": math.nan}, {"damping": math.nan}, {"response": math.nan}, {"delay": math.nan}):
            with self.assertRaisesRegex(RuntimeError, "finite"):
                cases.add(ball, **keywords)
        self.assertFalse(ball.motus.dynamics.entries)
        entry = cases.add(ball, frequency=-1.0, damping=-2.0)[0]
        self.assertGreater(entry.frequency, 0.0)
        self.assertEqual(entry.damping, 0.0)
        entry.frequency = math.nan
        bpy.context.view_layer.update()
        self.assertTrue(np.isfinite(cases.place(ball, 15)).all())

    def test_no_damping_in_a_loop_of_whole_periods(self):
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 1, 48
        ball = cases.moved(rows={1: (0.0, 0.0, 0.0), 20: (1.0, 0.0, 0.0), 49: (0.0, 0.0, 0.0)})
        cases.add(ball, frequency=1.0, damping=0.0, use_loop=True)
        cases.go_to(5)
        self.assertIn("numbers", cases.problem(ball).sentence)

    def test_keys_a_million_frames_apart_and_a_frame_a_second(self):
        far = cases.moved("Far", {1: (0.0, 0.0, 0.0), 1_000_000: (1.0, 0.0, 0.0)}, interpolation='LINEAR')
        cases.add(far)
        self.assertAlmostEqual(cases.place(far, 1_000_500)[0], 1.0, places=4)
        self.assertAlmostEqual(cases.place(far, 500_000)[0], 0.5, places=3)
        bpy.context.scene.render.fps = 1
        slow = cases.moved("Slow")
        cases.add(slow)
        np.testing.assert_allclose(cases.place(slow, 60), cases.STEP[20], atol=1e-4)

    def test_endless_input(self):
        ball = cases.moved(rows={1: (0.0, 0.0, 0.0), 13: (1.0, 0.0, 0.0), 25: (0.0, 0.0, 0.0)})
        for curve in support.addon("core.blender.actions").fcurves(ball):
            curve.modifiers.new('CYCLES')
        cases.key(ball, "location", {1: (0.0, 0.0, 0.0)})
        cases.add(ball, style='HEAVY')
        early = cases.place(ball, 30).tobytes()
        late = cases.place(ball, 5000)
        self.assertLess(abs(late[0]), 2.0)
        self.assertEqual(cases.place(ball, 30).tobytes(), early)
        np.testing.assert_allclose(cases.place(ball, 5000 + 24), late, atol=1e-4)

    def test_linked_objects_are_refused(self):
        cases.moved()
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.objects = ["Ball"]
        bpy.context.scene.collection.objects.link(bpy.data.objects["Ball"])
        with self.assertRaisesRegex(RuntimeError, "linked"):
            bpy.ops.motus.dynamics_add(object="Ball")

    def test_nla_strips_are_followed(self):
        ball = cases.moved()
        cases.add(ball, style='BOUNCY')
        wanted = cases.place(ball, 22)
        action = ball.animation_data.action
        strip = ball.animation_data.nla_tracks.new().strips.new("Strip", 1, action)
        strip.action_frame_start = 1
        ball.animation_data.action = None
        np.testing.assert_allclose(cases.place(ball, 22), wanted, atol=1e-4)
        strip.frame_start, strip.frame_end = strip.frame_start + 5, strip.frame_end + 5
        np.testing.assert_allclose(cases.place(ball, 27), wanted, atol=1e-4)

    def test_objects_that_are_driven_need_recording(self):
        ball = cases.moved()
        ball.driver_add("location", 0).driver.expression = "frame / 10"
        cases.add(ball)
        self.assertIn("record", cases.problem(ball).sentence)
        self.assertAlmostEqual(cases.place(ball, 22)[0], 2.2, places=5)

    def test_drivers_of_what_does_not_follow_do_not_matter(self):
        ball = cases.moved()
        ball.driver_add("rotation_euler", 0).driver.expression = "frame / 100"
        entry = cases.add(ball, style='BOUNCY', channels={'LOCATION'})[0]
        self.assertIsNone(cases.problem(ball))
        places = support.addon("core.tracks").own_track(ball, {"location"}).values
        wanted = cases.filtered(lambda frames: places(frames).locations, (2.0, 0.3, 0.0), 22)
        np.testing.assert_allclose(cases.place(ball, 22), wanted, atol=3e-4)
        entry.channels = {'LOCATION', 'ROTATION'}
        bpy.context.view_layer.update()
        self.assertIn("record", cases.problem(ball).sentence)
