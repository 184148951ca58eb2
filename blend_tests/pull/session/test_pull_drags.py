"""Drags: a stroke that is one pull of a vertex, whose displacement the cursor decides and changes until it is let go."""

import dataclasses
import types

import bpy
import numpy as np
from mathutils import Matrix, Vector

import support
from pull.pull_cases import forces
from pull.session.session_cases import SessionTestCase

WAYS = ((0.1, 0.0, 0.3), (0.0, 0.2, -0.4), (0.05, 0.1, 0.2))


class Drags(SessionTestCase):
    def drag(self, session, vertex, *ways):
        session.begin_stroke(is_drag=True)
        for way in ways:
            session.drag(vertex, way)

    def test_the_last_displacement_alone_counts(self):
        """Whether it accumulates or not, with a reach that is found by the tree and with one that is swept."""
        for accumulate in (True, False):
            for radius in (0.3, 5.0):
                obj = self.plane()
                flat, root = self.places(obj), self.middle(obj)
                session = self.session(obj, radius=radius, accumulate=accumulate)
                self.drag(session, root, *WAYS)
                force = forces('SMOOTH', np.linalg.norm(flat - flat[root], axis=1), radius)
                self.assertNear(self.places(obj), flat + force[:, None] * WAYS[-1])
                self.assertEqual(len(session.dabs), 1)

    def test_each_drag_starts_from_the_shape_at_the_press(self):
        for accumulate in (True, False):
            obj = self.plane()
            root = self.middle(obj)
            session = self.session(obj, accumulate=accumulate)
            self.drag(session, root, *WAYS)
            once = self.places(obj)
            self.drag(session, root, *WAYS)
            place = Vector(WAYS[-1])
            self.assertNear(once[root], place)
            self.assertNear(self.places(obj)[root], 2.0 * place)
            # A dab afterwards starts from what was dragged.
            self.stroke(session, root)
            self.assertNear(self.places(obj)[root], 2.0 * place + Vector((0.0, 0.0, 0.2)))
            self.assertTrue(session.step_back())
            self.assertNear(self.places(obj)[root], 2.0 * place)
            self.assertTrue(session.step_back())
            self.assertNear(self.places(obj), once, 0.0)
            self.assertTrue(session.step_back())
            self.assertFalse(session.step_back())
            self.assertFalse(session.finish())

    def test_a_zero_displacement_takes_it_back_bit_for_bit(self):
        for accumulate in (True, False):
            obj = self.ball()
            session = self.session(obj, accumulate=accumulate, use_minimum=True, minimum=-0.5)
            whole = self.bits(obj)
            self.stroke(session, 5)
            before = self.bits(obj)
            self.drag(session, 7, *WAYS, (0.0, 0.0, 0.0))
            self.assertEqual(self.bits(obj), before)
            self.assertEqual(len(session.dabs), 1)
            session.drag(7, WAYS[0])
            self.assertNotEqual(self.bits(obj), before)
            session.drag(7, (0.0, 0.0, 0.0))
            session.drag(7, (0.0, 0.0, 0.0))
            self.assertEqual(self.bits(obj), before)
            self.assertTrue(session.step_back())
            self.assertEqual(self.bits(obj), whole)

    def test_the_root_follows_whatever_the_space(self):
        """By a world vector, on an object that is turned and unevenly scaled, in either unit, and whatever the pen does."""
        for unit in ('WORLD', 'LOCAL'):
            obj = self.ball(2)
            obj.rotation_euler, obj.scale = (0.4, 0.9, -0.3), (1.5, 0.5, 0.7)
            bpy.context.view_layer.update()
            session = self.session(obj, unit=unit, use_pressure_strength=True, use_pressure_size=True)
            before = session.place(9)
            self.drag(session, 9, *WAYS)
            self.assertNear(session.place(9) - before, Vector(WAYS[-1]))
            self.assertNear(session.seen_place(9), session.place(9))

    def test_mirror_images_limits_and_the_surface(self):
        obj = self.plane()
        flat = self.places(obj)
        session = self.session(obj, radius=0.25, mirror=frozenset('X'), use_maximum=True, maximum=0.15, distance='SURFACE')
        root, image = (int(np.linalg.norm(flat - (x, 0.0, 0.0), axis=1).argmin()) for x in (0.6, -0.6))
        self.drag(session, root, (0.1, 0.02, 0.3))
        moved = self.places(obj) - flat
        self.assertNear(moved[root], (0.1, 0.02, 0.15))
        self.assertNear(moved[image], (-0.1, 0.02, 0.15))

    def test_the_seen_place_is_what_a_modifier_shows(self):
        obj = self.plane()
        displace = obj.modifiers.new("Up", 'DISPLACE')
        displace.mid_level, displace.strength = 0.0, 2.0
        bpy.context.view_layer.update()
        session = self.session(obj)
        root = self.middle(obj)
        self.assertNear(session.place(root), (0.0, 0.0, 0.0))
        self.assertNear(session.seen_place(root), (0.0, 0.0, 2.0))

    def test_done_again(self):
        """Redo does the drag, which has its own length, with another radius."""
        operators = support.addon("pull.operators")
        obj, again = self.plane(name="First"), self.plane(name="Again")
        session, root = self.session(obj, direction='CURSOR', strength=0.0), self.middle(obj)
        self.drag(session, root, *WAYS)
        self.drag(session, root + 3, WAYS[0])
        items = _Items()
        operators.keep_dabs(items, session)
        other = self.dab.Session(bpy.context, again, dataclasses.replace(session.brush, strength=7.0))
        self.assertTrue(operators.replay(other, items))
        self.assertNear(self.places(again), self.places(obj))
        self.assertEqual(len(items), 2)

    def test_without_a_cursor_it_says_so(self):
        self.plane()
        self.assertRefused("no cursor", vertex=3, direction='CURSOR')
        with self.assertRaisesRegex(RuntimeError, "no cursor"):
            bpy.ops.motus.pin_add(vertex=3, direction='CURSOR')

    def test_a_script_gives_the_displacement(self):
        obj = self.plane()
        root = self.middle(obj)
        self.brush.direction = 'CURSOR'
        moved = self.moved_by(obj, vertex=root, displacement=(0.1, 0.2, 0.3), radius=0.5)
        self.assertNear(moved[root], (0.1, 0.2, 0.3))

    def test_the_last_drag_becomes_a_pin(self):
        obj = self.plane()
        flat, root = self.places(obj), self.middle(obj)
        session = self.session(obj, direction='CURSOR')
        self.drag(session, root, *WAYS)
        dragged = self.places(obj)
        session.finish()
        support.addon("pull.operators").keep_last(self.scene.motus.pull.last, session)
        self.assertFalse(self.scene.motus.pull.last.is_shape)
        self.assertEqual(bpy.ops.motus.pin_add(from_last=True), {'FINISHED'})
        self.assertNear(self.places(obj), flat, 0.0)
        self.assertNear(self.seen(obj), dragged)

    def test_saved_items_keep_their_meaning(self):
        items = self.brush.bl_rna.properties["direction"].enum_items
        self.assertEqual([item.identifier for item in items], ['NORMAL', 'VIEW', 'X', 'Y', 'Z', 'CURSOR'])
        self.assertEqual([item.value for item in items], list(range(6)))


class _Items(list):
    """As a collection property has it."""

    def add(self):
        self.append(types.SimpleNamespace())
        return self[-1]


class ByTheMouse(SessionTestCase):
    """Dragging with a made-up viewport, 100 pixels a metre at the distance 10."""

    def dragging(self, obj, view, x=0, y=0, **changes):
        self.used = self.session(obj, direction='CURSOR', **changes)
        self.stroke_of_mouse = support.addon("pull.window.dragging").Dragging(self.used, view, event('LEFTMOUSE', x, y))
        return self.stroke_of_mouse

    def key(self, *kinds):
        for kind in kinds:
            self.stroke_of_mouse.key(bpy.context, event(kind))

    def test_the_root_stays_under_the_cursor(self):
        for view in (Perspective(), Straight()):
            obj = self.ball()
            drag = self.dragging(obj, view, 12, 7)
            root = drag.hit.vertex
            before = view.seen(self.used.place(root))
            drag.move(event('MOUSEMOVE', 60, -33))
            np.testing.assert_allclose(view.seen(self.used.place(root)) - before, (48, -40), atol=1e-3)
            self.assertAlmostEqual(drag.displacement.z, 0.0, places=6)

    def test_back_at_the_press_nothing_has_moved(self):
        obj = self.ball()
        before = self.bits(obj)
        drag = self.dragging(obj, Perspective())
        drag.move(event('MOUSEMOVE', 60, 20))
        self.assertNotEqual(self.bits(obj), before)
        drag.move(event('MOUSEMOVE', 0, 0))
        self.assertEqual(self.bits(obj), before)

    def test_an_axis_holds_it_and_lets_it_go(self):
        view = Perspective(Matrix.Rotation(0.9, 3, 'X') @ Matrix.Rotation(0.3, 3, 'Z'))
        drag = self.dragging(self.ball(), view)
        drag.move(event('MOUSEMOVE', 40, 30))
        free = drag.displacement.copy()
        for name, others in (('X', (1, 2)), ('Y', (0, 2)), ('Z', (0, 1))):
            self.key(name)
            self.assertEqual([drag.displacement[other] for other in others], [0.0, 0.0])
            # Nowhere along the axis is it nearer to the line of sight.
            target, index = drag.point + free, 'XYZ'.index(name)
            away = []
            for step in (-0.01, 0.0, 0.01):
                place = drag.point + drag.displacement
                place[index] += step
                away.append((place - target).cross(view.sight(target)).length)
            self.assertLess(away[1], min(away[0], away[2]))
        self.key('Z')
        self.assertIsNone(drag.axis)
        self.assertNear(drag.displacement, free)

    def test_shift_slows_it_down_from_where_it_is(self):
        drag = self.dragging(self.ball(), Straight())
        drag.move(event('MOUSEMOVE', 40, 30))
        drag.move(event('MOUSEMOVE', 60, 30, shift=True))
        self.assertNear(drag.displacement, (0.42, 0.3, 0.0))
        drag.move(event('MOUSEMOVE', 70, 50))
        self.assertNear(drag.displacement, (0.52, 0.5, 0.0))
        self.key('X')
        drag.move(event('MOUSEMOVE', 70, 90, shift=True))
        self.assertNear(drag.displacement, (0.52, 0.0, 0.0))

    def test_a_held_key_is_pressed_once(self):
        drag = self.dragging(self.ball(), Straight())
        self.key('X')
        drag.key(bpy.context, event('X', is_repeat=True))
        self.assertEqual(drag.axis, 'X')

    def test_along_the_line_of_sight_upwards_is_nearer(self):
        drag = self.dragging(self.ball(), Straight())
        self.key('Z')
        drag.move(event('MOUSEMOVE', 30, 50))
        self.assertNear(drag.displacement, (0.0, 0.0, 0.5))

    def test_the_objects_axes(self):
        obj = self.ball()
        obj.rotation_euler, obj.scale = (0.0, 0.0, 0.5), (2.0, 1.0, 1.0)
        bpy.context.view_layer.update()
        drag = self.dragging(obj, Straight(), unit='LOCAL')
        along = Vector((np.cos(0.5), np.sin(0.5), 0.0))
        drag.move(event('MOUSEMOVE', 40, 30))
        self.key('X')
        self.assertNear(drag.displacement, along * along.dot((0.4, 0.3, 0.0)))
        self.key('THREE')
        self.assertNear(drag.displacement, 6.0 * along, 1e-5)

    def test_a_typed_number_is_the_length(self):
        drag = self.dragging(self.ball(), Straight())
        drag.move(event('MOUSEMOVE', 40, 30))
        self.key('PERIOD', 'TWO')
        self.assertNear(drag.displacement, (0.16, 0.12, 0.0))
        drag.move(event('MOUSEMOVE', 90, 0))
        self.assertNear(drag.displacement, (0.16, 0.12, 0.0))
        self.key('Y')
        self.assertNear(drag.displacement, (0.0, 0.2, 0.0))
        self.key('MINUS')
        self.assertNear(drag.displacement, (0.0, -0.2, 0.0))
        self.key('BACK_SPACE', 'BACK_SPACE', 'BACK_SPACE', 'Y')
        drag.move(event('MOUSEMOVE', 90, 0))
        self.assertNear(drag.displacement, (0.9, 0.0, 0.0))

    def test_typed_in_the_scenes_unit(self):
        self.scene.unit_settings.scale_length = 0.01
        drag = self.dragging(self.ball(), Straight())
        self.key('X', 'FOUR')
        self.assertNear(drag.displacement, (400.0, 0.0, 0.0), 1e-4)

    def test_what_ends_it(self):
        drag = self.dragging(self.ball(), Straight())
        self.assertTrue(drag.is_confirmed_by(event('RET')))
        self.assertTrue(drag.is_cancelled_by(event('ESC')))
        self.assertTrue(drag.is_cancelled_by(event('RIGHTMOUSE')))
        self.assertFalse(drag.is_cancelled_by(event('LEFTMOUSE')))

    def test_cancelled_every_bit_is_as_before(self):
        obj = self.ball()
        before = self.bits(obj)
        drag = self.dragging(obj, Perspective())
        for place in range(5):
            drag.move(event('MOUSEMOVE', 13 * place, 7 * place))
        drag.cancel()
        self.assertEqual(self.bits(obj), before)

    def test_beside_the_mesh_nothing_is_held(self):
        obj = self.ball()
        before = self.bits(obj)
        drag = self.dragging(obj, Straight(), 900, 0)
        self.assertIsNone(drag.hit)
        drag.move(event('MOUSEMOVE', 0, 0))
        self.key('X', 'ONE')
        drag.cancel()
        self.assertEqual(self.bits(obj), before)
        self.assertIsNone(drag.axis_line(1.0))


def event(kind, x=0, y=0, value='PRESS', is_repeat=False, shift=False):
    return types.SimpleNamespace(type=kind, value=value, mouse_x=x, mouse_y=y, is_repeat=is_repeat, shift=shift)


class Straight:
    """A parallel view from above, whose middle is the world's; 100 pixels are a metre."""

    def ray(self, x, y):
        return Vector((x / 100.0, y / 100.0, 50.0)), Vector((0.0, 0.0, -1.0))

    def place_at(self, x, y, point):
        return Vector((x / 100.0, y / 100.0, point.z))

    def sight(self, _point):
        return Vector((0.0, 0.0, -1.0))

    def up(self):
        return Vector((0.0, 1.0, 0.0))

    def seen(self, point):
        return 100.0 * np.array(point)[:2]


class Perspective:
    """A viewer at the distance 10 from the world's middle; 100 pixels there are a metre."""

    def __init__(self, turn=None):
        self._turn = turn or Matrix.Identity(3)
        self._eye = self._turn @ Vector((0.0, 0.0, 10.0))

    def ray(self, x, y):
        return self._eye.copy(), self._turn @ Vector((x / 1000.0, y / 1000.0, -1.0)).normalized()

    def place_at(self, x, y, point):
        depth = -(self._turn.transposed() @ (point - self._eye)).z
        return self._eye + self._turn @ Vector((x / 1000.0, y / 1000.0, -1.0)) * depth

    def sight(self, point):
        return (point - self._eye).normalized()

    def up(self):
        return self._turn.col[1].copy()

    def seen(self, point):
        place = self._turn.transposed() @ (Vector(point) - self._eye)
        return 1000.0 * np.array(place)[:2] / -place.z
