"""What the mouse meets in a session, and which vertex it takes as the root."""

import math

import bmesh
import bpy
import numpy as np

from pull.session.session_cases import DOWN, SessionTestCase


class Picking(SessionTestCase):
    def test_a_ray_meets_what_is_there(self):
        obj = self.ball(3)
        obj.location = 1.0, 0.0, 0.0
        obj.scale = 1.0, 1.0, 2.0
        session = self.session(obj)
        hit = session.pick((1.05, 0.02, 9.0), DOWN)
        self.assertNear(hit.point[:2], (1.05, 0.02))
        self.assertAlmostEqual(hit.point[2], 2.0, delta=0.02)
        self.assertGreater(hit.normal[2], 0.95)
        places = self.in_world(obj, self.places(obj))
        self.assertEqual(hit.vertex, int(np.linalg.norm(places - np.array(hit.point), axis=1).argmin()))
        self.assertIsNone(session.pick((5.0, 0.0, 9.0), DOWN))

    def test_in_another_scene_what_is_seen_there_is_met(self):
        """The scene that the session began in may be gone by then."""
        obj = self.plane()
        modifier = obj.modifiers.new("Lift", 'DISPLACE')
        modifier.mid_level = 0.0
        for frame, strength in ((1, 0.0), (10, 2.0)):
            modifier.strength = strength
            modifier.keyframe_insert("strength", frame=frame)
        first, second = bpy.context.scene, bpy.data.scenes.new("Second")
        second.collection.objects.link(obj)
        first.frame_set(1)
        session = self.session(obj)
        second.frame_set(10)
        bpy.context.window.scene = second
        bpy.data.scenes.remove(first)
        self.assertAlmostEqual(session.pick((0.001, 0.001, 5.0), DOWN).point[2], 2.0, delta=0.01)

    def test_while_it_accumulates_the_shape_of_now_is_met(self):
        obj = self.plane()
        session = self.session(obj)
        self.stroke(session, 220, 220)
        self.assertAlmostEqual(session.pick((0.001, 0.001, 5.0), DOWN).point[2], 0.4, delta=0.01)
        session = self.session(obj, accumulate=False)
        self.stroke(session, 220, 200)
        self.assertAlmostEqual(session.pick((0.001, 0.001, 5.0), DOWN).point[2], 0.4, delta=0.01)

    def test_however_far_it_has_moved_the_shape_of_now_is_met(self):
        """Rays go by a tree that is refitted now and then; limits and curves move vertices further than the root."""
        cases = (
            {"strength": 0.01},
            {"strength": 0.5},
            {"strength": -0.02, "use_minimum": True, "minimum": 0.6},
            {"strength": 0.02, "falloff": 'CURVE', "curve": (0.0, 9.0, -20.0, 1.0)},
        )
        for changes in cases:
            for radius in (0.1, 0.8):
                obj = self.ball(4)
                session = self.session(obj, radius=radius, **changes)
                session.begin_stroke()
                for index in range(30):
                    x, y = 0.6 * math.cos(index), 0.6 * math.sin(1.3 * index)
                    for origin, direction in (((x, y, 9.0), DOWN), ((9.0, x, y), (-1.0, 0.0, 0.0))):
                        found, wanted = (one.pick(origin, direction) for one in (session, self.session(obj)))
                        self.assertEqual(found is None, wanted is None)
                        if found:
                            self.assertEqual(found.triangle, wanted.triangle)
                            self.assertNear(found.point, wanted.point, 1e-6)
                    session.pull(session.nearest((x, y, 1.0))[0], (0.0, 0.0, changes["strength"]))

    def test_what_modifiers_make_of_it_is_met(self):
        obj = self.plane()
        lift = obj.modifiers.new("Lift", 'DISPLACE')
        lift.strength, lift.mid_level, lift.direction = 1.0, 0.0, 'Z'
        session = self.session(obj)
        self.assertAlmostEqual(session.pick((0.001, 0.001, 5.0), DOWN).point[2], 1.0, places=5)
        self.stroke(session, 220)
        self.assertAlmostEqual(session.pick((0.001, 0.001, 5.0), DOWN).point[2], 1.2, delta=0.01)
        obj.modifiers.new("Subdivision", 'SUBSURF')
        self.assertAlmostEqual(self.session(obj).pick((0.001, 0.001, 5.0), DOWN).point[2], 0.2, delta=0.01)

    def test_the_root_is_the_nearest_vertex_where_triangles_are_thin(self):
        """Though it be no corner of the triangle that is met; in the brush's unit, and on the shape of now too."""
        line = np.arange(9.0)
        places = [(x + 3.0 * y, 0.1 * y, 0.0) for y in line for x in line]
        corners = [9 * row + column for row in range(8) for column in range(8)]
        faces = [face for a in corners for face in ((a, a + 1, a + 9), (a + 1, a + 10, a + 9))]
        obj = self.mesh(places, faces)
        obj.scale = 0.2, 3.0, 1.0
        for unit in ('WORLD', 'LOCAL'):
            session = self.session(obj, unit=unit, radius=0.5, strength=0.01)
            measured = self.in_world(obj, self.places(obj)) if unit == 'WORLD' else self.places(obj)
            beyond = 0
            for _ in range(2):
                for index in range(60):
                    u, v = 0.5 + 7.0 * (0.618 * index % 1.0), 0.5 + 7.0 * (0.755 * index % 1.0)
                    hit = session.pick((0.2 * (u + 3.0 * v), 0.3 * v, 5.0), DOWN)
                    at = (u + 3.0 * v, 0.1 * v) if unit == 'LOCAL' else hit.point[:2]
                    away = np.linalg.norm((measured - (*at, 0.0))[:, :2], axis=1)
                    self.assertAlmostEqual(away[hit.vertex], away.min(), delta=0.02)
                    beyond += hit.vertex not in faces[hit.triangle]
                self.stroke(session, 40)
            self.assertGreater(beyond, 10 if unit == 'LOCAL' else 0)

    def test_the_root_is_not_on_the_far_side_of_a_thin_wall(self):
        """Which has more vertices than the near one, so that one of those is nearer."""
        wall = bmesh.new()
        for height, count in ((0.0, 5), (-0.01, 41)):
            bmesh.ops.create_grid(wall, x_segments=count - 1, y_segments=count - 1, size=1.0)
            bmesh.ops.translate(wall, verts=wall.verts[-count * count :], vec=(0.0, 0.0, height))
        data = bpy.data.meshes.new("Wall")
        wall.to_mesh(data)
        wall.free()
        obj = self.link(data)
        near = np.flatnonzero(self.places(obj)[:, 2] == 0.0)
        session = self.session(obj)
        for x, y in ((0.2, 0.15), (-0.7, 0.3), (0.01, -0.23), (0.6, 0.9)):
            hit = session.pick((x, y, 5.0), DOWN)
            away = np.linalg.norm(self.places(obj) - hit.point, axis=1)
            self.assertNotIn(int(away.argmin()), near)
            self.assertEqual(hit.vertex, near[away[near].argmin()])

    def test_the_root_is_no_hidden_vertex(self):
        """In Object Mode, which shows what Edit Mode hides; asked anew with every stroke of the tool."""
        obj = self.plane()
        session = self.session(obj)
        self.assertEqual(session.pick((0.02, 0.01, 5.0), DOWN).vertex, 220)
        session.finish()
        for index in (220, 219, 241):
            obj.data.vertices[index].hide = True
        self.assertTrue(session.begin_again(bpy.context, obj, session.brush))
        self.assertEqual(session.pick((0.02, 0.01, 5.0), DOWN).vertex, 221)
        for vertex in obj.data.vertices:
            vertex.hide = True
        self.assertEqual(self.session(obj).pick((0.02, 0.01, 5.0), DOWN).vertex, 220)

    def test_hidden_faces_are_not_met_where_they_are_not_shown(self):
        obj = self.plane()
        bpy.ops.object.mode_set(mode='EDIT')
        edit = bmesh.from_edit_mesh(obj.data)
        for face in edit.faces:
            face.hide_set(face.calc_center_median().x > 0.0)
        self.assertIsNone(self.session(obj).pick((0.55, 0.0, 5.0), DOWN))
        self.assertIsNotNone(self.session(obj).pick((-0.55, 0.01, 5.0), DOWN))
