"""Sessions of many dabs, as the mouse makes them: strength, accumulation, smoothing, steps back, and doing it again."""

import itertools
import math
import sys
from unittest import mock

import bpy
import numpy as np
from mathutils import Vector

import support
from pull.pull_cases import forces
from pull.session.session_cases import DOWN, SessionTestCase


class Strength(SessionTestCase):
    def test_towards_the_viewer(self):
        """On an object that is turned and scaled too, exactly along the view."""
        obj = self.ball(2)
        obj.rotation_euler, obj.scale = (0.4, 0.9, -0.3), (1.5, 1.5, 0.7)
        bpy.context.view_layer.update()
        view = Vector((0.36, -0.48, 0.8))
        session = self.session(obj, direction='VIEW')
        for sign in (1.0, -1.0):
            self.assertNear(session.displacement(5, sign, view), sign * 0.2 * view)

    def test_a_pens_pressure(self):
        """As the switches say: of the strength, of the radius, of both or of neither."""
        for strength in (False, True):
            for size in (False, True):
                obj = self.plane()
                session = self.session(obj, use_pressure_strength=strength, use_pressure_size=size)
                root, flat = self.middle(obj), self.places(obj)
                session.begin_stroke()
                self.assertTrue(session.pull(root, session.displacement(root), 0.5))
                moved = self.places(obj) - flat
                self.assertNear(moved[root, 2], 0.1 if strength else 0.2)
                reach = np.linalg.norm(flat[moved.any(axis=1)] - flat[root], axis=1).max()
                self.assertTrue(0.2 < reach < 0.25 if size else 0.4 < reach < 0.5, reach)


class Accumulation(SessionTestCase):
    def test_each_builds_on_the_last(self):
        obj = self.plane()
        distances = np.linalg.norm(self.places(obj), axis=1)
        self.stroke(self.session(obj), 220, 220, 220)
        self.assertNear(self.places(obj)[:, 2], 0.6 * forces('SMOOTH', distances, 0.5), 4e-6)

    def test_distances_are_those_when_the_stroke_began(self):
        """A hill as high as the radius does not shrink the circle, within the stroke."""
        for distance in ('STRAIGHT', 'SURFACE'):
            obj = self.plane()
            places = self.places(obj)
            session = self.session(obj, strength=2.0, distance=distance, falloff='LINEAR')
            session.pick((0.0, 0.0, 5.0), DOWN)
            self.stroke(session, 220, 222)
            for root in (220, 222):
                places[:, 2] += 2.0 * forces('LINEAR', np.linalg.norm((places - places[root])[:, :2], axis=1), 0.5)
            self.assertNear(self.places(obj)[:, 2], places[:, 2], 4e-2 if distance == 'SURFACE' else 1e-5)

    def test_a_large_radius_does_the_same_in_another_way(self):
        """By looking at all vertices, or at those that the tree finds."""
        puller = sys.modules[f"{support.addon('pull').__name__}.session.puller"]
        shapes = []
        for limits in ({}, {"use_maximum": True, "maximum": 0.7}):
            results = []
            for large in (puller.LARGE, 1e9):
                for mode in ('OBJECT', 'EDIT'):
                    obj = self.ball(4)
                    bpy.ops.object.mode_set(mode=mode)
                    session = self.session(obj, radius=1.2, direction='NORMAL', **limits)
                    session.pick((0.0, 0.0, 5.0), DOWN)
                    with mock.patch.object(puller, "LARGE", large):
                        self.stroke(session, 500, 30, 600)
                    session.finish()
                    bpy.ops.object.mode_set(mode='OBJECT')
                    results.append(self.places(obj))
            for other in results[1:]:
                self.assertNear(other, results[0], 1e-6)
            self.assertGreater(np.linalg.norm(results[0], axis=1).max(), 1.15)
            shapes.append(results[0])
        self.assertGreater(np.abs(shapes[0] - shapes[1]).max(), 0.05)

    def test_written_at_once_or_later_the_same(self):
        """Several dabs of one movement of the mouse are written with the last of them."""
        for accumulate in (True, False):
            results = []
            for are_written in ((True,) * 5, (False, True, False, False, True), (True, False, True, True, False)):
                obj = self.ball(4)
                before = self.bits(obj)
                session = self.session(obj, radius=1.2, direction='NORMAL', accumulate=accumulate)
                session.begin_stroke()
                for vertex, is_written in zip((500, 30, 600, 601, 40), are_written):
                    session.pull(vertex, session.displacement(vertex), write=is_written)
                session.flush()
                results.append(self.bits(obj))
                self.assertEqual(session.current.tobytes(), results[-1])
                session.restore()
                self.assertEqual(self.bits(obj), before)
            self.assertEqual(results, [results[0]] * 3)
            self.assertNotEqual(results[0], before)

    def test_from_the_original_the_bump_follows(self):
        for has_tree in (False, True):
            obj = self.plane()
            before = self.places(obj)
            session = self.session(obj, accumulate=False, radius=0.15)
            if has_tree:
                session.pick((0.0, 0.0, 5.0), DOWN)
            self.stroke(session, 220, 225, 230)
            self.stroke(session, 235, 210)
            wanted = 0.2 * forces('SMOOTH', np.linalg.norm(before - before[210], axis=1), 0.15)
            self.assertNear(self.places(obj)[:, 2], wanted)

    def test_with_the_tree_and_without_it_the_same(self):
        results = []
        for has_tree in (False, True):
            for mode in ('OBJECT', 'EDIT'):
                obj = self.ball(5)
                bpy.ops.object.mode_set(mode=mode)
                session = self.session(obj, radius=0.08, mirror=frozenset("XZ"), direction='NORMAL')
                if has_tree:
                    session.pick((0.0, 0.0, 5.0), DOWN)
                self.stroke(session, 500)
                session.finish()
                bpy.ops.object.mode_set(mode='OBJECT')
                results.append(self.bits(obj))
        self.assertEqual(len(set(results)), 1)


class Smoothing(SessionTestCase):
    def test_a_bump_gets_flatter_and_nothing_else_moves(self):
        obj = self.plane()
        obj.data.vertices[220].co.z = 0.5
        before = self.places(obj)
        session = self.session(obj, radius=0.35)
        session.begin_stroke()
        self.assertTrue(session.smooth(220, 0.5))
        after = self.places(obj)
        self.assertAlmostEqual(after[220, 2], 0.25, places=6)
        self.assertNear(after[:, :2], before[:, :2], 1e-6)
        far = np.linalg.norm(before - (0.0, 0.0, 0.5), axis=1) >= 0.65
        self.assertNear(after[far], before[far], 0.0)

    def test_a_border_stays_where_it_is(self):
        obj = self.plane()
        before = self.places(obj)
        session = self.session(obj, radius=0.45, falloff='CONSTANT')
        for _ in range(5):
            session.begin_stroke()
            session.smooth(10, 1.0)
        self.assertNear(self.places(obj), before, 1e-6)

    def test_pulls_from_the_original_start_from_what_was_smoothed(self):
        obj = self.plane()
        obj.data.vertices[220].co.z = 0.5
        session = self.session(obj, accumulate=False, radius=0.15)
        session.begin_stroke()
        session.smooth(220, 1.0)
        self.stroke(session, 30, 40)
        self.assertNear(self.places(obj)[[220, 30, 40], 2], (0.0, 0.0, 0.2))


class Undoing(SessionTestCase):
    def test_restored_bit_for_bit(self):
        for mode in ('OBJECT', 'EDIT', 'SCULPT'):
            for accumulate in (True, False):
                with self.subTest(mode=mode, accumulate=accumulate):
                    obj = self.ball(3)
                    obj.shape_key_add(name="Basis")
                    obj.shape_key_add(name="Key")
                    obj.active_shape_key_index = 0
                    keys = [[tuple(point.co) for point in key.data] for key in obj.data.shape_keys.key_blocks]
                    before = self.bits(obj)
                    bpy.ops.object.mode_set(mode=mode)
                    session = self.session(obj, accumulate=accumulate, direction='NORMAL')
                    session.pick((0.0, 0.0, 5.0), DOWN)
                    self.stroke(session, 5, 9, 33)
                    session.smooth(40)
                    self.stroke(session, 70)
                    self.assertTrue(session.has_changed)
                    session.restore()
                    self.assertFalse(session.finish())
                    bpy.ops.object.mode_set(mode='OBJECT')
                    self.assertEqual(self.bits(obj), before)
                    after = [[tuple(point.co) for point in key.data] for key in obj.data.shape_keys.key_blocks]
                    self.assertEqual(after, keys)

    def test_a_step_back_is_one_stroke(self):
        for accumulate in (True, False):
            obj = self.plane()
            session = self.session(obj, accumulate=accumulate)
            shapes = [self.places(obj)]
            for vertices in ((220, 222), (150,), (300, 301)):
                self.stroke(session, *vertices)
                shapes.append(self.places(obj))
            for left in (2, 1, 0):
                self.assertTrue(session.step_back())
                self.assertNear(self.places(obj), shapes[left], 0.0)
            self.assertFalse(session.step_back())
            self.assertFalse(session.has_changed)
            self.assertEqual(session.dabs, [])
            self.stroke(session, 220, 222)
            self.assertNear(self.places(obj), shapes[1], 1e-7)

    def test_a_session_begins_again(self):
        obj = self.plane()
        session = self.session(obj, accumulate=False)
        self.stroke(session, 220)
        session.finish()
        self.assertTrue(session.begin_again(bpy.context, obj, session.brush))
        self.assertFalse(session.has_changed)
        self.stroke(session, 40)
        self.assertNear(self.places(obj)[[220, 40], 2], (0.2, 0.2))
        session.restore()
        self.assertNear(self.places(obj)[[220, 40], 2], (0.2, 0.0))
        obj.data.vertices[3].co.z = 1.0
        self.assertFalse(session.begin_again(bpy.context, obj, session.brush))


class Writing(SessionTestCase):
    """A small dab on a large mesh is written vertex by vertex, into memory that others may share."""

    def large(self):
        obj = self.ball(5)
        self.assertGreater(len(obj.data.vertices), 2000)
        return obj

    def test_who_shares_the_positions_keeps_them(self):
        obj = self.large()
        before = self.bits(obj)
        bpy.context.view_layer.update()
        kept = obj.data.copy()
        other = bpy.data.objects.new("Other", kept)
        for accumulate in (True, False):
            session = self.session(obj, radius=0.1, accumulate=accumulate)
            self.stroke(session, 5, 900, 5)
            np.testing.assert_array_equal(self.places(obj), session.current)
            self.assertEqual(self.bits(other), before)
            session.restore()
            self.assertEqual(self.bits(obj), before)

    def test_seen_with_its_normals_as_if_all_had_been_written(self):
        obj = self.large()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        session = self.session(obj, radius=0.1)
        self.stroke(session, 7, 7)

        def seen():
            depsgraph.update()
            mesh = obj.evaluated_get(depsgraph).data
            normals = np.empty(3 * len(mesh.vertices), np.float32)
            mesh.vertices.foreach_get("normal", normals)
            return normals, self.bits(obj.evaluated_get(depsgraph)), [list(corner) for corner in obj.bound_box]

        normals, *found = seen()
        obj.data.vertices.foreach_set("co", session.current.ravel())
        obj.data.update()
        normals_then, *found_then = seen()
        self.assertEqual(found, found_then)
        # Blender sums them up on several threads, in 3.4 in an order that differs from time to time.
        np.testing.assert_allclose(normals, normals_then, atol=1e-6)

    def test_undo_steps_keep_their_shape(self):
        obj = self.large()
        name, shapes = obj.name, []
        for vertex in (3, 1200):
            bpy.ops.ed.undo_push(message="Motus test")
            shapes.append(self.bits(obj))
            bpy.ops.motus.pick_pull(object=name, vertex=vertex, radius=0.1, strength=0.2, direction='Z')
            obj = bpy.data.objects[name]
        bpy.ops.ed.undo_push(message="Motus test")
        for shape in reversed(shapes):
            bpy.ops.ed.undo()
            self.assertEqual(self.bits(bpy.data.objects[name]), shape)


class Redo(SessionTestCase):
    def test_the_same_dabs_by_the_operator(self):
        for accumulate in (True, False):
            obj = self.ball(4, name="First")
            session = self.session(obj, accumulate=accumulate, direction='NORMAL', radius=0.3)
            self.stroke(session, 5, 9, 33)
            session.smooth(40)
            self.stroke(session, 70)
            session.finish()
            dabs = [
                {
                    "name": "",
                    "kind": dab.kind,
                    "vertex": dab.vertex,
                    "is_first": dab.is_first,
                    "strength": dab.strength,
                    "radius": dab.radius / 0.3,
                    "displacement": tuple(part / 0.2 for part in dab.displacement),
                }
                for dab in session.dabs
            ]
            again = self.ball(4, name="Second")
            self.pull(object=again.name, dabs=dabs, radius=0.3, strength=0.2, accumulate=accumulate)
            self.assertNear(self.places(again), self.places(obj), 2e-6)
            twice = self.ball(4, name="Third")
            self.pull(object=twice.name, dabs=dabs[:1], radius=0.3, strength=0.4, accumulate=accumulate)
            moved = np.linalg.norm(self.places(twice) - self.places(self.ball(4)), axis=1)
            self.assertAlmostEqual(moved.max(), 0.4, places=5)

    def test_the_last_pull_is_remembered(self):
        obj = self.plane()
        obj.scale = 2.0, 1.0, 1.0
        before = self.places(obj)
        self.pull(vertex=220, radius=0.6, strength=0.3, falloff='LINEAR', mirror={'X'}, direction='Z')
        last = self.brush.last
        self.assertEqual((last.object, last.vertex, last.falloff, last.mirror), (obj.name, 220, 'LINEAR', {'X'}))
        self.assertNear(last.displacement, (0.0, 0.0, 0.3))
        self.assertNear(last.metric, (2, 0, 0, 0, 1, 0, 0, 0, 1))
        name, shape, after = self.history.last_shapes
        self.assertEqual(name, obj.name)
        self.assertNear(shape, before, 0.0)
        self.assertNear(after, self.places(obj), 0.0)

    def test_shapes_that_were_given_away_stay_as_they_are(self):
        """The last pull's shapes are kept beyond a session, which may begin again; by every way to move vertices."""
        for radius, accumulate, has_tree in itertools.product((0.1, 1.2), (True, False), (True, False)):
            obj = self.ball(4)
            first = self.bits(obj)
            session = self.session(obj, radius=radius, direction='NORMAL', accumulate=accumulate)
            if has_tree:
                session.pick((0.0, 0.0, 5.0), DOWN)
            self.stroke(session, 500, 30)
            between = self.bits(obj)
            given = session.shapes_of_last()
            before = [shape.tobytes() for shape in given]
            self.assertEqual(before[1], between)
            self.stroke(session, 600, 601)
            session.smooth(600, 0.5)
            session.finish()
            self.assertTrue(session.begin_again(bpy.context, obj, session.brush))
            self.stroke(session, 10, 40, 11)
            self.assertEqual([shape.tobytes() for shape in given], before)
            self.assertTrue(session.step_back())
            session.restore()
            self.assertNotIn(self.bits(obj), (first, between))

    def test_the_shape_before_the_last_stroke(self):
        """Shapes that are no longer needed are filled anew; this one is."""
        for radius in (0.1, 0.8):
            obj = self.ball(4)
            session = self.session(obj, radius=radius)
            session.pick((0.0, 0.0, 5.0), DOWN)
            for roots in ((5, 40, 40, 40, 9), (70, 300), (300, 300, 5)):
                before = self.places(obj)
                session.begin_stroke()
                for vertex in roots:
                    session.pull(vertex, (0.01, 0.02, 0.1))
                    self.assertNear(session.last.before, before, 0.0)
            kept = session.last.before
            self.stroke(session, 600, 601)
            self.assertNear(kept, before, 0.0)

    def test_dabs_at_one_root_are_one_pull(self):
        obj = self.plane()
        session = self.session(obj)
        self.stroke(session, 5)
        self.stroke(session, 220, 220, 220)
        self.assertTrue(session.last.is_alone)
        self.assertNear(session.last.dab.displacement, (0.0, 0.0, 0.6))
        shape = session.last.before
        self.assertNear(shape[:, 2], 0.2 * forces('SMOOTH', np.linalg.norm(shape[:, :2] - shape[5, :2], axis=1), 0.5))
        self.assertTrue(math.isclose(session.last.dab.radius, 0.5))
        self.stroke(session, 5, 220, 220)
        self.assertFalse(session.last.is_alone)
