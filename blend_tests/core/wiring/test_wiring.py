"""From a solve function to the scene, with every kind of sink: what is evaluated, and when."""

import threading
from unittest import mock

import bpy
from mathutils import Matrix

import support
import toy_system
from core.wiring.wiring_cases import (
    WiringTestCase,
    assert_playback_equals_jumps,
    build_followers,
    build_object,
    each_kind,
    frame_set,
)

wiring = support.addon("core.wiring")
solver = support.addon("core.wiring.solving.namespace")
results = support.addon("core.wiring.solving.results")
solving = support.addon("core.wiring.solving.solving")
per_thread = support.addon("core.evaluated.per_thread")
capabilities = support.addon("core.blender.capabilities")
FRAMES = (10, 3, 55, 1, 248, 54.25, 7.5, 54)


class ThreadTest(WiringTestCase):
    @each_kind
    def test_python_state_of_a_thread_is_kept(self, build):
        """What is local to an evaluation thread is there again in the next frame: its state has not been made anew."""
        target = toy_system.new_target()
        build(target)
        local = threading.local()
        found, with_state = {}, set()

        def keep_state():
            if per_thread.keep_state():
                with_state.add(threading.get_ident())

        patch = mock.patch.object(solver, "keep_state", keep_state)
        patch.start()
        self.addCleanup(patch.stop)

        def probe(value):
            thread = threading.get_ident()
            if thread in with_state:  # what is local from now on stays
                found.setdefault(thread, []).append(getattr(local, "value", None))
                local.value = value
            return value

        bpy.app.driver_namespace["motus_probe"] = probe
        for index in range(20):  # so many that each thread evaluates some
            prober = toy_system.new_object(f"Prober {index}")
            prober.driver_add("location", 0).driver.expression = "motus_probe(frame)"
        for frame in range(1, 60):
            frame_set(frame)
        self.assertGreater(max(map(len, found.values())), 1)
        for values in found.values():
            self.assertNotIn(None, values[1:])


class EvaluationTest(WiringTestCase):
    @each_kind
    def test_frames_in_any_order(self, build):
        owner, things = build(toy_system.new_target())
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, things)

    @each_kind
    def test_playback_equals_jumps(self, build):
        _, things = build(toy_system.new_target())
        assert_playback_equals_jumps(self, lambda: [toy_system.world_matrix(thing) for thing in things], count=20)

    @each_kind
    def test_dragged_target(self, build):
        target = toy_system.new_object("Target")
        owner, things = build(target)
        frame_set(12)
        for step in range(5):
            target.location.x = 0.7 * step
            target.rotation_euler.z = step
            bpy.context.view_layer.update()
            self.assert_follows(owner, things)

    @each_kind
    def test_changed_setting(self, build):
        owner, things = build(toy_system.new_target())
        frame_set(12)
        owner.motus.orbit.radius = 5.0
        bpy.context.view_layer.update()
        self.assert_follows(owner, things)

    @each_kind
    def test_prepared_once(self, build):
        """From frame to frame nothing is prepared anew; after an edit of the owner its solver is."""
        owner, things = build(toy_system.new_target())
        frame_set(1)
        prepared = []
        with mock.patch.object(solving.Solver, "__init__", autospec=True, side_effect=solving.Solver.__init__) as prepare:
            for frame in FRAMES:
                frame_set(frame)
            prepared.append(prepare.call_count)
            owner.motus.orbit.radius = 5.0
            bpy.context.view_layer.update()
            prepared.append(prepare.call_count)
        self.assertEqual(prepared, [0, 1])
        self.assert_follows(owner, things)

    @each_kind
    def test_keyed_setting(self, build):
        owner, things = build(toy_system.new_target())
        for frame, radius in ((1, 1.0), (50, 6.0)):
            owner.motus.orbit.radius = radius
            owner.motus.orbit.keyframe_insert("radius", frame=frame)
        for frame in (40, 12.5, 30):
            frame_set(frame)
            evaluated = owner.evaluated_get(bpy.context.evaluated_depsgraph_get())
            self.assertNotIn(evaluated.motus.orbit.radius, (1.0, 6.0))
            self.assert_follows(evaluated, things)

    @each_kind
    def test_driven_setting(self, build):
        owner, things = build(toy_system.new_target())
        owner.driver_add("motus.orbit.radius").driver.expression = "2.0 + 0.1*frame"
        wiring.refresh(toy_system.SYSTEM, owner)
        for frame in (40, 12.5, 30):
            frame_set(frame)
            owner_now = owner.evaluated_get(bpy.context.evaluated_depsgraph_get())
            self.assertAlmostEqual(owner_now.motus.orbit.radius, 2.0 + 0.1 * frame, places=5)
            self.assert_follows(owner_now, things)

    def test_other_frame_rate(self):
        bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = 30, 1.001
        owner, things = build_object(toy_system.new_target())
        frame_set(31.5)
        self.assert_follows(owner, things)

    def test_scale_stays_the_users(self):
        owner, _ = build_object(toy_system.new_target())
        frame_set(20)
        self.assert_close(toy_system.world_matrix(owner).to_scale(), owner.scale)

    @each_kind
    def test_under_a_parent(self, build):
        owner, things = build(toy_system.new_target())
        parent = toy_system.new_object("Parent", (4.0, 5.0, 6.0))
        parent.rotation_euler = (1.0, 0.5, 0.2)
        parent.driver_add("location", 1).driver.expression = "0.3*frame"
        for thing in things:
            thing.id_data.parent = parent
        for frame in (20, 9.5):
            frame_set(frame)
            self.assert_follows(owner, things)

    @each_kind
    def test_half_influence(self, build):
        owner, things = build(toy_system.new_target())
        frame_set(20)
        solved = [toy_system.world_matrix(thing) for thing in things]
        owner.motus.orbit.influence = 0.0
        bpy.context.view_layer.update()
        own = [toy_system.world_matrix(thing) for thing in things]
        owner.motus.orbit.influence = 0.5
        bpy.context.view_layer.update()
        for thing, first, last in zip(things, own, solved):
            self.assertGreater((first.translation - last.translation).length, 0.5)
            matrix = toy_system.world_matrix(thing)
            self.assert_close(matrix.translation, first.lerp(last, 0.5).translation)
            wanted = first.to_quaternion().slerp(last.to_quaternion(), 0.5)
            self.assert_same_matrix(matrix.to_3x3().normalized(), wanted.to_matrix(), 1e-4)

    @each_kind
    def test_channels(self, build):
        owner, things = build(toy_system.new_target())
        frame_set(20)
        owner.motus.orbit.influence = 0.0
        bpy.context.view_layer.update()
        own = [toy_system.world_matrix(thing) for thing in things]
        owner.motus.orbit.influence = 1.0
        owner.motus.orbit.use_rotation = False
        bpy.context.view_layer.update()
        for index, (thing, before) in enumerate(zip(things, own)):
            matrix = toy_system.world_matrix(thing)
            self.assert_close(matrix.translation, toy_system.expected(owner, index)[0])
            self.assert_same_matrix(matrix.to_3x3(), before.to_3x3())


class OutputTest(WiringTestCase):
    @each_kind
    def test_output_and_its_path(self, build):
        owner, _ = build(toy_system.new_target(), speed=2.0)
        graph = bpy.context.evaluated_depsgraph_get()
        frame_set(36)
        self.assertAlmostEqual(wiring.output(toy_system.SYSTEM, owner, "angle", graph), 3.0)
        carrier = owner.motus.orbit.hub.data if owner.motus.orbit.hub else owner
        evaluated = carrier.evaluated_get(graph)
        self.assertAlmostEqual(evaluated.path_resolve(wiring.output_path(toy_system.SYSTEM, "angle")), 3.0)

    def test_output_drives_a_property(self):
        owner, _ = build_object(toy_system.new_target(), speed=2.0)
        reader = toy_system.new_object("Reader")
        driver = reader.driver_add("location", 2).driver
        driver.type = 'SUM'
        target = driver.variables.new().targets[0]
        target.id, target.data_path = owner, wiring.output_path(toy_system.SYSTEM, "angle")
        for frame in (48, 12):
            frame_set(frame)
            self.assertAlmostEqual(toy_system.world_matrix(reader).translation.z, 2.0 * frame / 24.0, places=5)

    @each_kind
    def test_warning_moves_on(self, build):
        owner, things = build(toy_system.new_target(), radius=0.0)
        frame_set(5)
        graph = bpy.context.evaluated_depsgraph_get()
        self.assertIs(wiring.problem(toy_system.SYSTEM, owner, graph), toy_system.NO_RADIUS)
        self.assert_follows(owner, things)

    @each_kind
    def test_problem_leaves_own_transform(self, build):
        owner, things = build(None)
        frame_set(5)
        graph = bpy.context.evaluated_depsgraph_get()
        self.assertIs(wiring.problem(toy_system.SYSTEM, owner, graph), toy_system.NO_TARGET)
        for thing in things:
            if thing.id_data is thing:
                self.assert_same_matrix(toy_system.world_matrix(thing), thing.matrix_basis)
            else:
                self.assert_same_matrix(toy_system.world_matrix(thing), owner.matrix_basis @ thing.bone.matrix_local)

    @each_kind
    def test_no_problem(self, build):
        owner, _ = build(toy_system.new_target())
        frame_set(5)
        self.assertIsNone(wiring.problem(toy_system.SYSTEM, owner, bpy.context.evaluated_depsgraph_get()))

    @each_kind
    def test_error_of_our_own(self, build):
        owner, things = build(toy_system.new_target())
        with mock.patch.object(toy_system, "pose", side_effect=RuntimeError), self.assertLogs(results.log, "ERROR"):
            frame_set(6)
        problem = wiring.problem(toy_system.SYSTEM, owner, bpy.context.evaluated_depsgraph_get())
        self.assertTrue(problem.blocking)
        self.assertNotIn(problem, toy_system.SYSTEM.problems)
        frame_set(7)
        self.assert_follows(owner, things)


class ChainTest(WiringTestCase):
    @each_kind
    def test_one_circles_the_other(self, build):
        first, _ = build_object(toy_system.new_target())
        first.name = "First"
        owner, things = build(first)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, things)

    @each_kind
    def test_one_circles_a_child_of_many(self, build):
        _, followers = build_followers(toy_system.new_target())
        child = toy_system.new_object("Child", (0.0, 1.0, 0.0))
        child.parent = followers[-1]
        owner, things = build(child)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, things)

    def test_many_in_a_row(self):
        target = toy_system.new_target()
        for _ in range(10):
            target, _ = build_object(target, radius=1.5)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(target, [target])
        wanted = Matrix.Translation(toy_system.expected(target)[0])
        frame_set(11)
        frame_set(FRAMES[-1])
        self.assert_close(toy_system.world_matrix(target).translation, wanted.translation)


class CostTest(WiringTestCase):
    """Counted, since milliseconds depend on the machine."""

    @each_kind
    def test_one_solve_a_frame(self, build):
        build(toy_system.new_target())
        frame_set(1)
        with mock.patch.object(toy_system, "solve_calls", 0):
            frame_set(2)
            self.assertEqual(toy_system.solve_calls, 1)

    def test_drivers_of_a_member(self):
        owner, followers = build_followers(toy_system.new_target(), count=3)
        moving = followers[1]
        moving.parent = bpy.data.objects.new("Parent", None)
        wiring.refresh(toy_system.SYSTEM, owner)
        uses_attribute = capabilities.has_geometry_attribute_constraint()
        for follower in followers:
            count = len(follower.animation_data.drivers) if follower.animation_data else 0
            still = follower != moving
            self.assertEqual(count, (0 if still else 1) if uses_attribute else 8)


class ExactTest(WiringTestCase):
    def test_tiny_values_are_not_rounded_to_nothing(self):
        for radius in (9e-5, 3e-6, 0.5):
            support.empty_scene()
            target = toy_system.new_object("Target")
            owner, things = build_object(target, radius=radius)
            frame_set(1)
            location, _ = toy_system.expected(owner, 0)
            actual = toy_system.world_matrix(things[0]).translation
            for one, wanted in zip(actual, location):
                self.assertAlmostEqual(one, wanted, delta=1e-6 * radius)
