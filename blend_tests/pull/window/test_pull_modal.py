"""What Pick & Pull does in the window, as far as it needs none: strokes, numbers, the cursor's shape, the tools."""

import itertools
import math
import types
import unittest
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

import support

WAY = types.SimpleNamespace


def strokes():
    return support.addon("pull.window.strokes")


def a_brush(**settings):
    return support.addon("pull.brush").Brush(**settings)


def event(kind, value='PRESS', **state):
    return WAY(type=kind, value=value, **{"mouse_x": 0, "mouse_y": 0, "shift": False, "ctrl": False, **state})


class Dabs(unittest.TestCase):
    """strokes.Way on a surface that reaches from x = 0 to x = 1000."""

    def setUp(self):
        self.way = strokes().Way(lambda x, y: (x, y) if 0 <= x <= 1000 else None, lambda found: 100.0)

    def test_press_of_the_mouse_makes_one_dab(self):
        self.assertEqual(self.way.move(50, 5), [(50, 5)])

    def test_a_tenth_of_the_radius_apart(self):
        self.way.move(0, 0)
        self.assertEqual(self.way.move(35, 0), [(10, 0), (20, 0), (30, 0)])
        # The rest of the way counts on.
        self.assertEqual(self.way.move(41, 0), [(40, 0)])

    def test_many_small_movements_are_one_long_one(self):
        self.way.move(0, 0)
        found = [place for x in range(1, 101) for place in self.way.move(x, 0)]
        self.assertEqual([round(x) for x, _ in found], list(range(10, 101, 10)))

    def test_turning_back_is_a_way_too(self):
        self.way.move(0, 0)
        self.way.move(8, 0)
        self.assertEqual(self.way.move(4, 0), [(6, 0)])

    def test_a_jump_is_limited(self):
        self.way.move(0, 0)
        found = self.way.move(1000, 0)
        self.assertEqual(len(found), strokes().MOST)
        self.assertEqual(found[-1], (1000, 0))

    def test_nothing_beside_the_surface(self):
        self.way.move(5, 0)
        self.assertEqual(self.way.move(-50, 0), [])
        self.assertIsNone(self.way.found)
        self.assertEqual(self.way.wait(), [])
        self.assertEqual(self.way.move(5, 0), [(5, 0)], "it begins anew where it comes back")

    def test_held_still_it_goes_on_by_the_clock(self):
        self.way.move(5, 0)
        self.assertEqual(self.way.wait(), [], "the press itself was a dab in this tick")
        self.assertEqual(self.way.wait(), [(5, 0)])
        self.way.move(30, 0)
        self.assertEqual(self.way.wait(), [], "the movement made dabs in this tick")
        self.way.move(31, 0)
        self.assertEqual(self.way.wait(), [(31, 0)], "too short a movement is no dab")

    def test_a_radius_of_no_pixels_ends(self):
        way = strokes().Way(lambda x, y: (x, y), lambda found: 0.0)
        way.move(0, 0)
        self.assertLessEqual(len(way.move(500, 500)), strokes().MOST)


class Pen(unittest.TestCase):
    def test_a_mouse_presses_fully(self):
        self.assertEqual(strokes().pressure(WAY(is_tablet=False, pressure=0.0)), 1.0)

    def test_a_pen_as_hard_as_it_does(self):
        self.assertEqual(strokes().pressure(WAY(is_tablet=True, pressure=0.25)), 0.25)
        self.assertEqual(strokes().pressure(WAY(is_tablet=True, pressure=1.5)), 1.0)


class TypedNumbers(unittest.TestCase):
    def typed(self, *keys, takes_numpad=False):
        made = support.addon("core.interface.dragging.number_entry").NumberEntry(takes_numpad)
        return made, [made.key(key) for key in keys]

    def test_number_entry_takes_digits(self):
        made, taken = self.typed('ONE', 'PERIOD', 'TWO', 'FIVE')
        self.assertTrue(all(taken))
        self.assertEqual(made.value, 1.25)

    def test_one_decimal_point(self):
        self.assertEqual(self.typed('ONE', 'COMMA', 'TWO', 'PERIOD', 'FIVE')[0].value, 1.25)

    def test_back_space(self):
        made, _ = self.typed('ONE', 'TWO', 'BACK_SPACE')
        self.assertEqual(made.value, 1.0)
        made.key('BACK_SPACE')
        self.assertFalse(made.is_open)
        self.assertIsNone(made.value)
        self.assertFalse(made.key('BACK_SPACE'), "there is nothing to take away")

    def test_the_keypad_turns_the_view_until_a_number_has_begun(self):
        self.assertEqual(self.typed('NUMPAD_1')[1], [False])
        self.assertEqual(self.typed('ONE', 'NUMPAD_1')[0].value, 11.0)
        self.assertEqual(self.typed('NUMPAD_1', takes_numpad=True)[0].value, 1.0)

    def test_the_sign_changes_wherever_it_is_typed(self):
        self.assertEqual(self.typed('MINUS', 'ONE', 'PERIOD', 'FIVE')[0].value, -1.5)
        made, taken = self.typed('TWO', 'NUMPAD_MINUS')
        self.assertEqual((made.value, taken), (-2.0, [True, True]))
        made.key('MINUS')
        self.assertEqual(made.value, 2.0)
        self.assertEqual(self.typed('NUMPAD_MINUS')[1], [False])
        self.assertIsNone(self.typed('MINUS')[0].value)

    def test_a_point_alone_is_no_number(self):
        self.assertIsNone(self.typed('PERIOD')[0].value)


class Adjusting(unittest.TestCase):
    def adjustment(self, name="radius", **settings):
        self.brush = a_brush(**settings)
        return support.addon("pull.window.adjusting").Adjustment(name, self.brush, 100, 50.0, None, None)

    def handle(self, adjustment, *events):
        return [adjustment.handle(bpy.context, self.brush, one) for one in events][-1]

    def test_radius_follows_the_mouse(self):
        adjustment = self.adjustment(radius=1.0)
        self.assertEqual(self.handle(adjustment, event('MOUSEMOVE', mouse_x=125)), ('SET', 1.5))

    def test_shift_is_finer(self):
        adjustment = self.adjustment(radius=1.0)
        _, value = self.handle(adjustment, event('MOUSEMOVE', mouse_x=125, shift=True))
        self.assertAlmostEqual(value, 1.05)

    def test_radius_stays_above_zero(self):
        _, value = self.handle(self.adjustment(radius=1.0), event('MOUSEMOVE', mouse_x=-5000))
        self.assertGreater(value, 0.0)

    def test_strength_may_go_below_zero(self):
        _, value = self.handle(self.adjustment("strength", strength=0.1), event('MOUSEMOVE', mouse_x=0))
        self.assertLess(value, 0.0)

    def test_edges_are_whole_numbers(self):
        _, value = self.handle(self.adjustment(radius=3.0, distance='EDGES'), event('MOUSEMOVE', mouse_x=147))
        self.assertEqual(value, 5)

    def test_esc_and_right_button_take_it_back(self):
        for kind in ('ESC', 'RIGHTMOUSE'):
            adjustment = self.adjustment(radius=2.0)
            self.assertEqual(self.handle(adjustment, event('MOUSEMOVE', mouse_x=300), event(kind)), ('CANCEL', 2.0))

    def test_click_keeps_it(self):
        self.assertEqual(self.handle(self.adjustment(), event('LEFTMOUSE')), ('KEEP', None))

    def test_a_typed_number_holds_against_the_mouse(self):
        adjustment = self.adjustment(radius=1.0)
        self.assertEqual(self.handle(adjustment, event('FOUR')), ('SET', 4.0))
        self.assertEqual(self.handle(adjustment, event('MOUSEMOVE', mouse_x=900)), (None, None))

    def test_typed_in_the_scenes_unit(self):
        support.empty_scene()
        bpy.context.scene.unit_settings.scale_length = 0.01
        _, value = self.handle(self.adjustment(), event('FOUR'))
        self.assertAlmostEqual(value, 400.0, places=3)

    def test_wheel_changes_the_number(self):
        adjusting = support.addon("pull.window.adjusting")
        self.assertGreater(adjusting.notched(a_brush(radius=1.0), "radius", 1), 1.0)
        self.assertEqual(adjusting.notched(a_brush(radius=3.0, distance='EDGES'), "radius", -1), 2.0)
        self.assertEqual(adjusting.notched(a_brush(radius=1.0, distance='EDGES'), "radius", -1), 1.0)


class CursorShape(unittest.TestCase):
    def shape(self):
        return support.addon("pull.window.cursor_shape")

    def test_the_circle_lies_across_the_normal(self):
        normal = Vector((1.0, -2.0, 0.5)).normalized()
        axes = self.shape().frame(normal, None)
        np.testing.assert_allclose(axes @ axes.T, np.eye(2), atol=1e-12)
        np.testing.assert_allclose(axes @ np.array(normal), 0.0, atol=1e-12)

    def test_local_lengths_on_a_scaled_object(self):
        """Each point of the circle is as far from the root as the radius, in the object."""
        matrix = np.array(Matrix.Diagonal((1.0, 3.0, 0.5)) @ Euler((0.3, 0.2, 0.9)).to_matrix())
        axes = self.shape().frame((0.0, 0.6, 0.8), matrix)
        points = self.shape().circle(np.zeros(3), axes, 2.0)
        np.testing.assert_allclose(np.linalg.norm(points @ np.linalg.inv(matrix).T, axis=1), 2.0, atol=1e-9)
        np.testing.assert_allclose(points @ np.array((0.0, 0.6, 0.8)), 0.0, atol=1e-9)

    def test_dots_leave_room_between_them(self):
        thinned = self.shape().thinned
        grid = np.stack(np.meshgrid(np.arange(100.0), np.arange(100.0)), axis=-1).reshape(-1, 2)
        step, size = thinned(grid, 2.0, 5.0, 2.0)
        self.assertEqual(size, 2.0)
        self.assertAlmostEqual(100.0 * 100.0 / (len(grid) / step), 16.0, delta=1.0)
        step, size = thinned(8.0 * grid, 2.0, 5.0, 2.0)
        self.assertEqual(step, 1)
        self.assertAlmostEqual(size, 4.0, places=1)
        self.assertEqual(thinned(100.0 * grid, 2.0, 5.0, 2.0), (1, 5.0))
        self.assertEqual(thinned(np.zeros((0, 2)), 2.0, 5.0, 2.0)[0], 1)

    def test_the_disc_has_the_falloffs_forces(self):
        shape = self.shape()
        points, forces, triangles = shape.disc(np.zeros(3), np.eye(3)[:2], a_brush(radius=2.0, falloff='LINEAR'))
        distances = np.linalg.norm(points, axis=1)
        np.testing.assert_allclose(forces, 1.0 - distances / 2.0, atol=2e-3)
        self.assertLess(triangles.max(), len(points))
        corners = points[triangles]
        doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(doubled, axis=1).sum() / 2.0
        self.assertAlmostEqual(area, 4.0 * math.pi, delta=0.05)

    def test_a_falloff_that_ends_sharply_shows_it(self):
        _, forces, _ = self.shape().disc(np.zeros(3), np.eye(3)[:2], a_brush(falloff='CONSTANT'))
        np.testing.assert_array_equal(forces, 1.0)

    def test_classic_reaches_as_far_as_the_radius_root(self):
        points, _, _ = self.shape().disc(np.zeros(3), np.eye(3)[:2], a_brush(radius=4.0, falloff='CLASSIC'))
        self.assertAlmostEqual(np.linalg.norm(points, axis=1).max(), 2.0, places=5)

    def test_the_bump_rises_at_the_root(self):
        line = self.shape().bump(np.zeros(3), np.eye(3)[:2], a_brush(), (0.0, 0.0, 0.5), np.array((1.0, 0.0, 0.0)))
        self.assertAlmostEqual(line[:, 2].max(), 0.5, places=5)
        self.assertAlmostEqual(abs(line[len(line) // 2, 0]), 0.0, places=6)
        np.testing.assert_allclose(line[:, 1], 0.0, atol=1e-9)


class Inset(unittest.TestCase):
    def corners(self, size=(4.0, 3.0, 2.0)):
        return [Vector((1.0, 2.0, 3.0)) + Vector(sides) * Vector(size) / 2.0 for sides in itertools.product((-1, 1), repeat=3)]

    def camera(self, rotation, *size):
        return support.addon("pull.window.inset").camera(rotation.to_quaternion(), self.corners(*size), 1.5)

    def test_the_whole_box_fills_the_picture(self):
        views = Euler((0.0, 0.0, 0.0)), Euler((math.pi / 2.0, 0.0, 0.0)), Euler((1.1, 0.0, 0.8))
        for rotation, size in itertools.product(views, ((4.0, 3.0, 2.0), (5.0, 5.0, 0.0), (0.1, 0.1, 9.0))):
            view, projection = self.camera(rotation, size)
            reached = 0.0
            for corner in self.corners(size):
                place = projection @ view @ corner.to_4d()
                self.assertGreater(place.w, 0.0)
                self.assertLessEqual(abs(place.z) / place.w, 1.0)
                reached = max(reached, abs(place.x) / place.w, abs(place.y) / place.w)
            self.assertLess(reached, 1.0)
            self.assertGreater(reached, 0.85)

    def test_an_object_without_size(self):
        view, projection = self.camera(Euler((0.3, 0.0, 0.0)), (0.0, 0.0, 0.0))
        place = projection @ view @ Vector((1.0, 2.0, 3.0, 1.0))
        self.assertLess(max(abs(place.x), abs(place.y), abs(place.z)) / place.w, 1.0)

    def test_it_looks_from_another_side(self):
        for rotation in (Euler((0.0, 0.0, 0.0)), Euler((math.pi / 2.0, 0.0, 0.7)), Euler((1.1, 0.0, -2.0))):
            view, _ = self.camera(rotation)
            worked_from = rotation.to_matrix() @ Vector((0.0, 0.0, 1.0))
            shown_from = view.inverted().to_3x3() @ Vector((0.0, 0.0, 1.0))
            self.assertGreater(worked_from.angle(shown_from), math.radians(40.0))

    def test_sidebars_and_shelves_are_kept_clear_of(self):
        inset = support.addon("pull.window.inset")
        region = WAY(x=100, y=50, width=1000, height=700)
        around = [
            WAY(type='UI', x=880, y=50, width=220, height=700),
            WAY(type='TOOLS', x=100, y=50, width=60, height=700),
            WAY(type='ASSET_SHELF', x=100, y=50, width=1000, height=90),
            WAY(type='HEADER', x=100, y=720, width=1000, height=30),
            WAY(type='UI', x=1100, y=50, width=1, height=1),
            WAY(type='TOOLS', x=0, y=50, width=100, height=700),
        ]
        x, y, width, _ = inset.rectangle(region, around)
        self.assertGreater(x, 60)
        self.assertLess(x + width, 780)
        self.assertGreater(y, 90)
        self.assertEqual(width, int((780 - 60) * inset.SHARE))
        self.assertEqual(inset.rectangle(region, around[4:]), inset.rectangle(region))
        self.assertIsNone(inset.rectangle(WAY(x=0, y=0, width=400, height=300), [WAY(type='UI', x=150, y=0, width=250, height=300)]))

    def test_no_room_no_inset(self):
        inset = support.addon("pull.window.inset")
        self.assertIsNone(inset.rectangle(WAY(width=200, height=500)))
        x, y, width, height = inset.rectangle(WAY(width=1000, height=700))
        self.assertLess(x + width, 1000)
        self.assertGreater(min(x, y, height), 0)


class Toolbar(unittest.TestCase):
    MODES = ('OBJECT', 'EDIT_MESH', 'SCULPT')

    def tools(self, mode):
        from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active

        found = VIEW3D_PT_tools_active._tools[mode]
        return [tool for tool in VIEW3D_PT_tools_active._tools_flatten(found) if getattr(tool, "idname", "") == "motus.pick_pull"]

    def test_in_three_modes_while_enabled(self):
        for mode in self.MODES:
            self.assertEqual(len(self.tools(mode)), 1, mode)
        support.disable()
        self.addCleanup(support.enable)
        for mode in self.MODES:
            self.assertEqual(self.tools(mode), [], mode)

    def test_the_icon_is_packaged_and_valid(self):
        (tool,) = self.tools('OBJECT')
        icon = bpy.app.icons.new_triangles_from_file(f"{tool.icon}.dat")
        self.assertGreater(icon, 0)
        bpy.app.icons.release(icon)

    def test_the_icon_is_what_its_script_draws(self):
        script = support.CLONE / "docs" / "scripts" / "tool_icons.py"
        made = {"__name__": "icons", "__file__": str(script)}
        exec(compile(script.read_text(encoding="utf-8"), str(script), "exec"), made)
        (tool,) = self.tools('OBJECT')
        self.assertEqual(Path(f"{tool.icon}.dat").read_bytes(), made["pick_pull"]())

    def test_keys_name_operators_and_properties_that_exist(self):
        for identifier, _, options in support.addon("pull.window.keymap").TOOL_KEYMAP:
            area, name = identifier.split(".")
            properties = getattr(getattr(bpy.ops, area), name).get_rna_type().properties
            for key, value in options["properties"]:
                self.assertIn(key, properties)
                if properties[key].type == 'ENUM':
                    self.assertIn(value, properties[key].enum_items)

    def test_status_names_icons_that_exist(self):
        """In the newest Blender; an older one may lack some, and shows the text alone."""
        known = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
        status = support.addon("pull.window.status")
        for key in status.SESSION_KEYS + status.ADJUSTING_KEYS + status.GRABBING_KEYS + status.DRAGGING_KEYS:
            for icon in key.icons:
                if bpy.app.version >= (4, 3, 0):
                    self.assertIn(icon, known)

    def test_presets_name_settings_that_exist(self):
        brush = bpy.context.scene.motus.pull
        for name in support.addon("pull.presets").NAMES:
            self.assertTrue(hasattr(brush, name), name)


class WithoutAWindow(support.SceneTestCase):
    def test_adjusting_by_notches(self):
        brush = bpy.context.scene.motus.pull
        brush.radius = 1.0
        self.assertEqual(bpy.ops.motus.pull_adjust(number='RADIUS', steps=2), {'FINISHED'})
        self.assertAlmostEqual(brush.radius, 1.21, places=5)
        bpy.ops.motus.pull_adjust(number='STRENGTH', steps=-1)
        self.assertAlmostEqual(brush.strength, 0.1 / 1.1, places=6)

    def test_many_notches_are_one_step(self):
        brush, adjust = bpy.context.scene.motus.pull, support.addon("pull.window.adjust")
        self.addCleanup(setattr, adjust, "notched", adjust.notched)
        asked, notched = [], adjust.notched
        adjust.notched = lambda *arguments: asked.append(arguments) or notched(*arguments)
        brush.radius = 1.0
        bpy.ops.motus.pull_adjust(number='RADIUS', steps=100)
        self.assertEqual(len(asked), 1)
        self.assertAlmostEqual(brush.radius / 1.1**100, 1.0, places=6)
        bpy.ops.motus.pull_adjust(number='RADIUS', steps=-100)
        self.assertAlmostEqual(brush.radius, 1.0, places=5)
        for steps in (2**31 - 1, -(2**31)):
            self.assertEqual(bpy.ops.motus.pull_adjust(number='RADIUS', steps=steps), {'FINISHED'})
            self.assertTrue(np.isfinite(brush.radius))
        self.assertEqual(len(asked), 4)

    def test_nothing_is_kept_of_a_closed_file(self):
        hover = support.addon("pull.window.hover")
        hover._kept["key"] = "something"
        support.empty_scene()
        self.assertEqual(hover._kept, {})
