"""Where the bobs are at any frame: as the library says, in any order, bit for bit, on moved pivots too."""

import hashlib
import math
from types import SimpleNamespace

import bpy
import numpy as np

import support
from pendulum.pendulum_cases import OFF_THE_FRAMES, PendulumTestCase, native, place, reach, seconds, world
from support import go_to

DIGEST = "37679ed8da62d73a2b661bcf96b092827149d800"


class Motion(PendulumTestCase):
    def test_single(self):
        pivot = self.add(kind='SINGLE', length1=1.5, angle1=2.0, velocity1=0.5, damping=0.2, location=(1.0, 2.0, 3.0))
        (bob,) = self.bobs(pivot)
        for frame in OFF_THE_FRAMES:
            go_to(frame)
            angle, _ = native().single_pendulum(
                seconds(frame), 2.0, 0.5, length=1.5, gravity=bpy.context.scene.gravity.length, damping=pivot.motus.pendulum.damping
            )
            self.assertPlace(bob, reach((1.5, angle)) + (1.0, 2.0, 3.0))

    def test_double(self):
        pivot = self.add(kind='DOUBLE', length1=1.5, length2=0.5, mass1=2.0, mass2=0.5, angle1=2.0, angle2=-1.0, velocity2=3.0)
        upper, lower = self.bobs(pivot)
        for frame in OFF_THE_FRAMES:
            go_to(frame)
            first, second, *_ = native().double_pendulum(
                seconds(frame), 2.0, -1.0, 0.0, 3.0, 2.0, 0.5, 1.5, 0.5, bpy.context.scene.gravity.length
            )
            self.assertPlace(upper, reach((1.5, first)))
            self.assertPlace(lower, reach((1.5, first), (0.5, second)), 4e-6)

    def test_fan(self):
        pivot = self.add(kind='FAN', count=7, spacing=0.1)
        self.assertEqual(len(self.bobs(pivot)), 14)
        go_to(150)
        settings = pivot.motus.pendulum
        self.assertAlmostEqual(settings.angle_step, math.radians(0.5), 7)
        for index, bob in enumerate(self.bobs(pivot)[1::2]):
            first, second, *_ = native().double_pendulum(
                seconds(150), settings.angle1, settings.angle2 + index * settings.angle_step, gravity=bpy.context.scene.gravity.length
            )
            self.assertPlace(bob, reach((1.0, first), (1.0, second)) + (0.0, 0.1 * (index - 3), 0.0), 4e-6)
        places = [place(bob) for bob in self.bobs(pivot)[1::2]]
        self.assertGreater(max(np.linalg.norm(a - b) for a in places for b in places), 0.5, "no chaos")

    def test_a_file_may_tell_of_any_number_of_pendulums(self):
        settings = self.add(kind='FAN', count=3).motus.pendulum
        settings.count = 10**9
        self.assertEqual(settings.count, 500)
        solve, keywords = support.addon("pendulum.solve"), support.addon("pendulum.properties").KEYWORDS
        for count in (10**9, 0, -1):
            said = SimpleNamespace(**{name: getattr(settings, name) for name in (*keywords, "kind")} | {"count": count})
            self.assertIs(solve.swing_of(said, bpy.context.scene), solve.NO_FAN)

    def test_bit_for_bit_in_any_order(self):
        pivot = self.add(kind='FAN', count=5)
        other = self.add(kind='SINGLE', damping=0.1)
        things = [*self.rods(pivot), *self.bobs(pivot), *self.bobs(other)]

        def states():
            found = {}
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                state = b"".join(world(thing).tobytes() for thing in things)
                self.assertEqual(found.setdefault(frame, state), state, frame)
            return found

        first = states()
        go_to(400)
        self.assertEqual(states(), first)

    def test_the_same_bits_in_every_blender(self):
        """The matrices' bits have a digest, the same in all Blenders that run this test."""
        self.add(kind='FAN', count=8, location=(0.3, 0.1, 2.2))
        pivot = self.add(kind='SINGLE', damping=0.1, location=(1.3, 0.1, 2.2))
        pivot.rotation_euler, pivot.scale = (0.1, 0.2, 0.3), (1.1, 1.2, 1.3)
        self.add(kind='SINGLE', velocity1=9.0)
        digest = hashlib.sha1()
        for frame in (1, 24, 60.25, 120, 240):
            go_to(frame)
            for obj in sorted(bpy.context.scene.objects, key=lambda one: one.name):
                digest.update(world(obj).astype(np.float32).tobytes())
        self.assertEqual(digest.hexdigest(), DIGEST)

    def test_a_moved_pivot_carries_it(self):
        carrier = self.link("Carrier")
        carrier.rotation_euler = (0.3, 0.2, 1.0)
        for frame, x in ((1, 0.0), (40, 5.0)):
            carrier.location.x = x
            carrier.keyframe_insert("location", index=0, frame=frame)
        self.add(kind='SINGLE', object="Carrier", angle1=1.0)
        (bob,) = self.bobs(carrier)
        go_to(20)
        angle, _ = native().single_pendulum(seconds(20), pivot_angle(carrier), gravity=bpy.context.scene.gravity.length)
        expected = world(carrier) @ np.array((*reach((1.0, angle)), 1.0))
        self.assertPlace(bob, expected[:3])
        self.assertGreater(place(bob)[0], 1.0)

    def test_a_driven_pivot_is_felt(self):
        carrier = self.link("Carrier")
        beside = 20  # frames: the pivot is on its way when the pendulum starts, and goes on when the scene ends
        for frame in range(1 - beside, 61 + beside):
            carrier.location.x = 0.3 * math.sin(0.4 * frame)
            carrier.keyframe_insert("location", index=0, frame=frame)
        bpy.context.scene.frame_end = 60
        self.add(kind='SINGLE', object="Carrier", angle1=0.0, use_pivot_motion=True)
        (rod,) = self.rods(carrier)
        places = []
        for frame in range(1 - beside, 61 + beside):
            go_to(frame)
            places.append((place(carrier)[0], place(carrier)[2]))
        pushed = native().pivot_accelerations(1 / 24, np.array(places))[beside:-beside]
        swings = []
        for frame in (30, 50, 12.5):
            go_to(frame)
            angle, _ = native().single_pendulum(
                seconds(frame), 0.0, gravity=bpy.context.scene.gravity.length, pivot_step=1 / 24, pivot_accelerations=pushed
            )
            # The system reads fewer frames beside its table than this test does.
            self.assertPlace(self.bobs(carrier)[0], place(rod) + reach((1.0, angle)), 1e-4)
            swings.append(abs(angle))
        self.assertGreater(max(swings), 0.05)
        carrier.motus.pendulum.use_pivot_motion = False
        go_to(30)
        self.assertPlace(self.bobs(carrier)[0], place(rod) + reach((1.0, 0.0)))

    def test_a_pivot_with_a_constraint_has_to_be_recorded(self):
        leader = self.link("Leader")
        leader.keyframe_insert("location", frame=1)
        carrier = self.link("Carrier")
        carrier.constraints.new('COPY_LOCATION').target = leader
        self.add(kind='SINGLE', object="Carrier", use_pivot_motion=True)
        self.assertIn("not known ahead", self.sentence(carrier))
        bpy.ops.motus.track_record(datablock="Carrier", frame_start=1, frame_end=10)
        self.assertEqual(self.sentence(carrier), "")

    def test_a_pivot_that_is_driven_and_has_dynamics(self):
        carrier = self.link("Carrier")
        for frame, x in ((1, 0.0), (13, 4.0)):
            carrier.location.x = x
            carrier.keyframe_insert("location", frame=frame)
        go_to(1)
        bpy.ops.motus.dynamics_add(object="Carrier")
        self.add(kind='DOUBLE', object="Carrier")
        self.assertIn("motus_pendulum_out", carrier)
        # What the dynamics wait for must not wait for the matrix that they make.
        carrier.motus.pendulum.use_pivot_motion = True
        self.assertNotIn("motus_pendulum_out", carrier)
        go_to(20)
        expected = world(self.bobs(carrier)[1]).tobytes()
        go_to(40)
        go_to(20)
        self.assertEqual(world(self.bobs(carrier)[1]).tobytes(), expected)
        carrier.motus.pendulum.use_pivot_motion = False
        self.assertIn("motus_pendulum_out", carrier)

    def test_scene_gravity(self):
        pivot = self.add(kind='SINGLE', angle1=1.0)
        go_to(20)
        before = place(self.bobs(pivot)[0])
        bpy.context.scene.gravity = (0.0, 0.0, -1.6)
        go_to(20)
        self.assertGreater(np.linalg.norm(place(self.bobs(pivot)[0]) - before), 0.1)
        pivot.motus.pendulum.use_scene_gravity = False
        pivot.motus.pendulum.gravity = bpy.context.scene.gravity.length
        moon = place(self.bobs(pivot)[0])
        pivot.motus.pendulum.gravity = 9.81
        self.assertPlace(self.bobs(pivot)[0], before)
        self.assertGreater(np.linalg.norm(before - moon), 0.1)

    def test_limits(self):
        pivot = self.add(kind='DOUBLE', use_limits=True, most_velocity=1.0)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        wiring, system = support_wiring()
        for frame in (10, 40, 90):
            go_to(frame)
            for name in ("velocity1", "velocity2"):
                self.assertLessEqual(abs(wiring.output(system, pivot, name, depsgraph)), 1.0 + 1e-9)

    def test_influence(self):
        pivot = self.add(kind='SINGLE', angle1=1.0, influence=0.25)
        self.assertPlace(self.bobs(pivot)[0], reach((1.0, 0.25)))
        pivot.motus.pendulum.influence = 0.0
        self.assertPlace(self.bobs(pivot)[0], reach((1.0, 0.0)))

    def test_the_rods_own_turns_stay(self):
        pivot = self.add(kind='SINGLE', angle1=0.5)
        (rod,) = self.rods(pivot)
        rod.rotation_euler.y = -0.25
        self.assertPlace(self.bobs(pivot)[0], reach((1.0, 0.75)))

    def test_lengths_fit_rods_and_bobs(self):
        pivot = self.add(kind='DOUBLE', angle1=0.5, angle2=1.0)
        pivot.motus.pendulum.length1 = 2.0
        pivot.motus.pendulum.length2 = 0.25
        upper, lower = self.bobs(pivot)
        self.assertPlace(upper, reach((2.0, 0.5)))
        self.assertPlace(lower, reach((2.0, 0.5), (0.25, 1.0)))
        longest = [min(vertex.co.z for vertex in rod.data.vertices) for rod in self.rods(pivot)]
        np.testing.assert_allclose(longest, (-2.0, -0.25), atol=1e-6)

    def test_baked(self):
        pivot = self.add(kind='DOUBLE')
        _, lower = self.bobs(pivot)
        found = {}
        for frame in (1, 20, 40):
            go_to(frame)
            found[frame] = place(lower)
        self.assertEqual(bpy.ops.motus.bake(object=pivot.name, frame_start=1, frame_end=40), {'FINISHED'})
        for frame, expected in found.items():
            go_to(frame)
            self.assertPlace(lower, expected, 1e-5)
        self.assertTrue(all(rod.animation_data.action for rod in self.rods(pivot)))
        self.assertEqual(bpy.ops.motus.unbake(object=pivot.name), {'FINISHED'})
        for frame, expected in found.items():
            go_to(frame)
            self.assertPlace(lower, expected, 0.0)
        self.assertTrue(all(rod.animation_data.action is None for rod in self.rods(pivot)))

    def test_a_copy_swings_by_itself(self):
        pivot = self.add(kind='SINGLE', angle1=1.0)
        for obj in (pivot, *self.rods(pivot), *self.bobs(pivot)):
            obj.select_set(True)
        bpy.ops.object.duplicate()
        copy = bpy.context.object
        self.assertNotEqual(copy, pivot)
        bpy.context.view_layer.update()
        copy.motus.pendulum.angle1 = 0.25
        copy.location.y = 5.0
        self.assertPlace(self.bobs(pivot)[0], reach((1.0, 1.0)))
        self.assertPlace(self.bobs(copy)[0], reach((1.0, 0.25)) + (0.0, 5.0, 0.0))

    def test_saved_and_loaded(self):
        pivot = self.add(kind='DOUBLE')
        go_to(30)
        expected = [world(bob).tobytes() for bob in self.bobs(pivot)]
        path = str(self.folder / "pendulum.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        go_to(30)
        self.assertEqual([world(bob).tobytes() for bob in self.bobs(bpy.data.objects[pivot_name()])], expected)


def pivot_angle(pivot):
    return pivot.motus.pendulum.angle1


def pivot_name():
    return next(obj.name for obj in bpy.data.objects if obj.motus.pendulum.is_active)


def support_wiring():
    import support

    return support.addon("core.wiring"), support.addon("pendulum").SYSTEM
