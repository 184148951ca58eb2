"""Pendulums that swing to all sides: where the bob is, in any order, on moved pivots, dragged, baked, trailed and placed."""

import math

import bpy
import numpy as np
from mathutils import Matrix

import solved_cases
import support
from pendulum.pendulum_cases import OFF_THE_FRAMES, PendulumTestCase, native, place, seconds, world
from support import go_to

START = {"angle1": 0.9, "heading": 0.4, "velocity1": 0.5, "velocity_sideways": 1.5}


class SphericalTestCase(PendulumTestCase):
    def spherical(self, **keywords):
        return self.add(**{"kind": 'SPHERICAL', "length1": 1.5, **START, **keywords})

    def state(self, frame, settings, **keywords):
        return native().spherical_pendulum(
            seconds(frame),
            settings.angle1,
            settings.heading,
            settings.velocity1,
            settings.velocity_sideways,
            settings.length1,
            bpy.context.scene.gravity.length,
            settings.damping,
            **keywords,
        )


class Motion(SphericalTestCase):
    def test_the_bob_is_where_the_library_says_in_any_order(self):
        pivot = self.spherical(damping=0.2, location=(1.0, 2.0, 3.0))
        (bob,) = self.bobs(pivot)
        found = {}
        for frame in OFF_THE_FRAMES:
            go_to(frame)
            self.assertPlace(bob, 1.5 * self.state(frame, pivot.motus.pendulum)[:3] + (1.0, 2.0, 3.0), 3e-6)
            self.assertEqual(found.setdefault(frame, world(bob).tobytes()), world(bob).tobytes(), frame)

    def test_energy_and_angular_momentum_of_the_bob_are_kept(self):
        pivot = self.spherical()
        gravity, kept = bpy.context.scene.gravity.length, []
        for frame in (1, 100, 37.5, 500):
            go_to(frame)
            x, y, z, *v = self.state(frame, pivot.motus.pendulum)
            kept.append((0.5 * 1.5**2 * np.dot(v, v) + gravity * 1.5 * z, x * v[1] - y * v[0]))
            self.assertPlace(self.bobs(pivot)[0], (1.5 * x, 1.5 * y, 1.5 * z), 3e-6)
        self.assertLess(np.ptp(kept, axis=0).max(), 1e-10)

    def test_in_a_plane_it_is_the_single_pendulum(self):
        flat = self.add(kind='SINGLE', angle1=2.0, velocity1=4.0, location=(0.0, 0.0, 0.0))
        spherical = self.add(kind='SPHERICAL', angle1=2.0, velocity1=4.0, location=(0.0, 0.0, 0.0))
        for frame in (1, 20, 45.5, 90):
            go_to(frame)
            np.testing.assert_allclose(world(self.bobs(spherical)[0]), world(self.bobs(flat)[0]), atol=5e-6)

    def test_influence_and_outputs(self):
        pivot = self.spherical(influence=0.5)
        go_to(20)
        x, y, z, *_ = self.state(20, pivot.motus.pendulum)
        level, half = math.hypot(x, y), 0.5 * math.atan2(math.hypot(x, y), -z)
        self.assertPlace(
            self.bobs(pivot)[0], 1.5 * np.array((math.sin(half) * x / level, math.sin(half) * y / level, -math.cos(half))), 3e-6
        )
        wiring, system = support.addon("core.wiring"), support.addon("pendulum").SYSTEM
        depsgraph = bpy.context.evaluated_depsgraph_get()
        self.assertAlmostEqual(wiring.output(system, pivot, "angle1", depsgraph), math.atan2(level, -z), 9)
        self.assertAlmostEqual(wiring.output(system, pivot, "angle2", depsgraph), math.atan2(y, x), 9)

    def test_the_told_state_is_one_to_start_from(self):
        directions = support.addon("pendulum.directions")
        pivot = self.spherical()
        settings = pivot.motus.pendulum
        angle, heading, velocity, sideways = directions.angles(self.state(50, settings).tolist())
        later = self.state(80, settings)
        found = native().spherical_pendulum(
            seconds(80) - seconds(50), angle, heading, velocity, sideways, 1.5, bpy.context.scene.gravity.length
        )
        np.testing.assert_allclose(found, later, atol=1e-9)
        for upright in ((0.0, 0.0, -1.0, 0.3, -0.2, 0.0), (0.0, 0.0, 1.0, 0.3, -0.2, 0.0)):
            again = native().spherical_pendulum(0.0, *directions.angles(upright))
            np.testing.assert_allclose(again, upright, atol=1e-12)

    def test_a_turned_rod_points_in_its_direction(self):
        directions = support.addon("pendulum.directions")
        random = np.random.default_rng(4)
        for direction in (*random.normal(size=(50, 3)), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)):
            direction = np.array(direction) / np.linalg.norm(direction)
            quaternion = support.addon("pendulum.build").Quaternion(directions.turn(direction.tolist(), 1.0))
            np.testing.assert_allclose(quaternion @ support.addon("pendulum.drag").Vector((0.0, 0.0, -1.0)), direction, atol=1e-6)

    def test_settings_that_are_no_motion(self):
        pivot = self.spherical()
        for name, value in (("heading", math.inf), ("velocity_sideways", math.inf)):
            before = getattr(pivot.motus.pendulum, name)
            setattr(pivot.motus.pendulum, name, value)
            self.assertIn("not a finite number", self.sentence(pivot))
            setattr(pivot.motus.pendulum, name, before)
        self.assertEqual(self.sentence(pivot), "")
        pivot.motus.pendulum.length1 = 0.0
        self.assertIn("greater than 0", self.sentence(pivot))


class Pivots(SphericalTestCase):
    def test_a_driven_pivot_is_felt_in_space(self):
        carrier = self.link("Carrier")
        beside = 20
        for frame in range(1 - beside, 61 + beside):
            carrier.location = 0.3 * math.sin(0.4 * frame), 0.2 * math.cos(0.3 * frame), 0.0
            carrier.keyframe_insert("location", frame=frame)
        bpy.context.scene.frame_end = 60
        self.spherical(object="Carrier", angle1=0.0, velocity1=0.0, velocity_sideways=0.0, use_pivot_motion=True)
        places = []
        for frame in range(1 - beside, 61 + beside):
            go_to(frame)
            places.append(place(carrier))
        places = np.array(places)
        pushed = np.column_stack([native().pivot_accelerations(1 / 24, places[:, axes])[beside:-beside] for axes in ((0, 1), (1, 2))])[
            :, (0, 1, 3)
        ]
        swung = 0.0
        for frame in (60, 13, 41.5, 1):
            go_to(frame)
            state = self.state(frame, carrier.motus.pendulum, pivot_step=1 / 24, pivot_accelerations=pushed)
            self.assertPlace(self.bobs(carrier)[0], place(carrier) + 1.5 * state[:3], 1e-4)
            swung = max(swung, abs(state[1]))
        self.assertGreater(swung, 0.02)

    def test_placed_bobs(self):
        pivot, bob = self.link("Hook", (0.0, 0.0, 3.0)), self.link("Lamp", (0.6, -0.8, 2.0))
        self.assertRefused("lies beside the plane", bpy.ops.motus.pendulum_add, object="Hook", bobs="Lamp")
        self.add(kind='SPHERICAL', object="Hook", bobs="Lamp")
        settings = pivot.motus.pendulum
        self.assertEqual((settings.kind, len(settings.rods)), ('SPHERICAL', 1))
        self.assertAlmostEqual(settings.length1, math.sqrt(2.0), 6)
        self.assertAlmostEqual(settings.heading, math.atan2(-0.8, 0.6), 6)
        go_to(1)
        self.assertPlace(bob, (0.6, -0.8, 2.0))
        bpy.ops.motus.pendulum_remove(object="Hook")
        self.assertPlace(bob, (0.6, -0.8, 2.0))

    def test_a_drag_takes_it_to_any_side(self):
        pivot = self.spherical(location=(0.0, 0.0, 2.0))
        go_to(30)
        bpy.ops.motus.pendulum_play(play='PAUSE')
        goal = np.array((-0.5, 1.0, -1.0)) / 1.5 * 1.5
        bpy.ops.motus.pendulum_drag(object=pivot.name, location=goal + (0.0, 0.0, 2.0))
        self.assertPlace(self.bobs(pivot)[0], goal + (0.0, 0.0, 2.0), 3e-6)
        settings = pivot.motus.pendulum
        self.assertEqual((settings.start_frame, settings.velocity1, settings.velocity_sideways), (30.0, 0.0, 0.0))
        bpy.ops.motus.pendulum_play(play='PLAY')
        go_to(54)
        state = native().spherical_pendulum(1.0, settings.angle1, settings.heading, length=1.5, gravity=bpy.context.scene.gravity.length)
        self.assertPlace(self.bobs(pivot)[0], 1.5 * state[:3] + (0.0, 0.0, 2.0), 4e-6)

    def test_a_trail_ends_at_the_bob(self):
        pivot = self.spherical(use_trails=True, location=(1.0, 0.0, 2.0))
        bpy.ops.motus.pendulum_trail_add(object=pivot.name, seconds=1.5, thickness=0.01)
        go_to(61)
        evaluated = pivot.motus.pendulum.trail.evaluated_get(bpy.context.evaluated_depsgraph_get())
        places = np.array([vertex.co[:] for vertex in evaluated.data.vertices]) + (1.0, 0.0, 2.0)
        ages = np.array([item.value for item in evaluated.data.attributes["age"].data])
        np.testing.assert_allclose(places[ages < 1e-6].mean(axis=0), place(self.bobs(pivot)[0]), atol=1e-4)
        start = 1.5 * self.state(25, pivot.motus.pendulum)[:3] + (1.0, 0.0, 2.0)
        np.testing.assert_allclose(places[ages > 1.0 - 1e-6].mean(axis=0), start, atol=1e-4)

    def test_baked_it_stays_where_it_was(self):
        pivot = self.spherical()
        (bob,) = self.bobs(pivot)
        bpy.context.scene.frame_end = 40
        before = {}
        for frame in (1, 12, 40):
            go_to(frame)
            before[frame] = place(bob)
        self.assertEqual(bpy.ops.motus.bake(object=pivot.name, frame_start=1, frame_end=40), {'FINISHED'})
        for frame, expected in before.items():
            go_to(frame)
            self.assertPlace(bob, expected, 1e-4)


class OverTime(solved_cases.Solved, SphericalTestCase):
    label = "Pendulum"

    def test_rods_and_bobs(self):
        pivot = self.spherical(damping=0.1, start_frame=7.5)
        pivot.location, pivot.rotation_euler, pivot.scale = (1.0, 2.0, 3.0), (0.4, 0.2, -0.7), (2.0, 2.0, 2.0)
        self.assertSolved(self.bobs(pivot)[0])
        support.key(pivot.motus.pendulum, "influence", {1: 0.2, 60: 1.0})
        self.assertSolved(self.rods(pivot)[0])


class Placed(PendulumTestCase):
    def test_align_and_rotation_are_those_of_other_adds(self):
        cursor = bpy.context.scene.cursor
        cursor.location, cursor.rotation_euler = (1.0, 2.0, 3.0), (0.3, 0.2, 0.1)
        turned = Matrix.LocRotScale(cursor.location, cursor.rotation_euler, None)
        for keywords, expected in (
            ({}, Matrix.Translation((1.0, 2.0, 3.0))),
            ({"align": 'CURSOR'}, turned),
            ({"location": (4.0, 5.0, 6.0)}, Matrix.Translation((4.0, 5.0, 6.0))),
            ({"rotation": (0.0, 0.0, 0.5)}, Matrix.Translation((1.0, 2.0, 3.0)) @ Matrix.Rotation(0.5, 4, 'Z')),
        ):
            with self.subTest(**keywords):
                pivot = self.add(kind='SINGLE', **keywords)
                np.testing.assert_allclose(world(pivot), expected, atol=1e-6)
        self.assertRefused("no 3D view to align to", bpy.ops.motus.pendulum_add, kind='SINGLE', align='VIEW')

    def test_the_preference_counts(self):
        edit = bpy.context.preferences.edit
        before, edit.object_align = edit.object_align, 'CURSOR'
        self.addCleanup(setattr, edit, "object_align", before)
        bpy.context.scene.cursor.rotation_euler = (0.3, 0.2, 0.1)
        pivot = self.add(kind='SINGLE')
        np.testing.assert_allclose(pivot.rotation_euler, (0.3, 0.2, 0.1), atol=1e-6)

    def test_the_demonstration_hangs_in_a_turned_row(self):
        self.add(kind='CHAOS', count=2, location=(0.0, 0.0, 0.0), rotation=(0.0, 0.0, math.pi / 2.0))
        pivots = [obj for obj in bpy.context.selected_objects if obj.motus.pendulum.is_active]
        places = sorted((obj.location[:] for obj in pivots), key=lambda found: found[1])
        np.testing.assert_allclose(places, [(0.0, 0.0, 0.0), (0.0, 5.0, 0.0), (0.0, 10.0, 0.0)], atol=1e-5)
