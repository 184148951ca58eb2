"""A stroke of many dabs that is kept as a pin: at the strength 1 the mesh looks as after the stroke, at 0 as before it."""

import bpy
import numpy as np

import support
from pull.pins import pin_cases as cases
from pull.pins.pin_cases import add, basis, centre, evaluated
from support import go_to

motus = bpy.ops.motus
wiring, setup, solve = (support.addon(name) for name in ("core.wiring", "pull.pins.setup", "pull.pins.solve"))
ULP = 2.5e-7
"""What one rounding of numbers up to 2 may come to, in metres."""


def dab(vertex, way=(0.0, 0.0, 0.1), radius=1.0, is_first=False, kind='PULL'):
    """One dab, its lengths as shares of the brush's."""
    return {"name": "", "kind": kind, "vertex": vertex, "is_first": is_first, "strength": 0.3, "radius": radius, "displacement": tuple(way)}


def stroke(roots, **values):
    """The dabs of one stroke along these roots."""
    return [dab(root, is_first=index == 0, **values) for index, root in enumerate(roots)]


def problem(obj):
    found = wiring.problem(setup.system(), obj, bpy.context.view_layer.depsgraph)
    return found and found.sentence


class StrokesTestCase(cases.PinsTestCase):
    ALONG = (200, 201, 202, 223, 244, 244, 245, 246, 201, 200)

    def pull(self, obj, dabs, **brush):
        """(shape before, shape after)."""
        before = basis(obj)
        keywords = {"strength": 1.0, "radius": 0.6, **brush}
        self.assertEqual(motus.pick_pull(object=obj.name, dabs=dabs, **keywords), {'FINISHED'})
        self.assertGreater(np.abs(basis(obj) - before).max(), 0.05)
        return before, basis(obj)

    def pin(self, obj):
        self.assertEqual(motus.pin_add(object=obj.name, from_last=True), {'FINISHED'})
        return obj.motus.pull.pins[obj.motus.pull.active_pin]

    def assert_pinned(self, obj, before, after):
        """Pins the last pull, which has made the one shape the other; returns the pin."""
        pin = self.pin(obj)
        self.assert_bits(basis(obj), before)
        self.assert_shape(obj, after, ULP)
        pin.strength = 0.0
        self.assert_bits(evaluated(obj), before)
        pin.strength = 0.5
        self.assert_shape(obj, 0.5 * (before + after), ULP)
        pin.strength = 1.0
        return pin


class StrokeTest(StrokesTestCase):
    def test_a_drag_across_the_surface(self):
        grid = cases.new_grid()
        before, after = self.pull(grid, stroke(self.ALONG))
        self.assertGreater(np.abs(after - before).max(), 0.5)
        self.assert_pinned(grid, before, after)
        self.assertEqual(len(grid.motus.pull.pins), 1)

    def test_stroke_pins_repeat_strokes_of_every_brush(self):
        for brush in (
            {"falloff": 'SPHERE'},
            {"falloff": 'CLASSIC', "scale_factor": 1.5},
            {"distance": 'SURFACE'},
            {"distance": 'EDGES', "radius": 4.0},
            {"mirror": {'X'}},
            {"mirror": {'X', 'Y'}, "unit": 'LOCAL'},
            {"use_maximum": True, "maximum": 0.15},
            {"use_maximum": True, "maximum": 0.15, "unit": 'LOCAL'},
            {"vertex_group": "Half"},
            {"accumulate": False},
        ):
            with self.subTest(brush):
                support.empty_scene()
                grid = cases.new_grid()
                grid.rotation_euler, grid.scale = (0.3, 0.4, 0.5), (1.0, 1.5, 0.8)
                grid.vertex_groups.new(name="Half").add(range(200, 441), 0.5, 'REPLACE')
                bpy.context.view_layer.update()
                self.assert_pinned(grid, *self.pull(grid, stroke(self.ALONG, way=(0.02, 0.03, 0.1)), **brush))

    def test_limits_of_the_world_on_a_turned_object(self):
        """They are along none of the object's axes, so a pull of one dab has to be kept as a shape too."""
        grid = cases.new_grid()
        grid.rotation_euler = 0.3, 0.4, 0.5
        bpy.context.view_layer.update()
        for roots in (self.ALONG, (220,)):
            shapes = self.pull(grid, stroke(roots, way=(0.0, 0.0, 0.5)), use_maximum=True, maximum=0.1)
            self.assert_pinned(grid, *shapes)
            motus.pin_remove(all=True)

    def test_what_is_hidden_or_masked_stays(self):
        for count in (1, 4):
            support.empty_scene()
            grid = cases.new_grid()
            for vertex in range(220):
                grid.data.vertices[vertex].hide = True
            before, after = self.pull(grid, stroke((230,) * count, way=(0.0, 0.0, 0.2)))
            self.assertEqual(np.abs(after - before)[:220].max(), 0.0)
            self.assert_pinned(grid, before, after)

    def test_smoothing_within_it(self):
        monkey = cases.new_monkey()
        dabs = [dab(10, is_first=True), dab(11, kind='SMOOTH'), dab(12), dab(13)]
        self.assert_pinned(monkey, *self.pull(monkey, dabs, radius=0.4))

    def test_held_still_it_is_one_pull_whose_settings_can_be_changed(self):
        for brush in ({}, {"mirror": {'X'}}, {"use_maximum": True, "maximum": 0.4}, {"distance": 'SURFACE'}):
            support.empty_scene()
            grid = cases.new_grid()
            root = centre(grid) + 2
            before, after = self.pull(grid, stroke((root,) * 7), **brush)
            pin = self.pin(grid)
            self.assertEqual((pin.shape, pin.vertex, len(grid.data.attributes.get("motus_pin").data)), ("", root, 441))
            self.assertAlmostEqual(pin.displacement[2], 0.7, places=5)
            self.assert_bits(basis(grid), before)
            self.assert_shape(grid, after, 1e-6)

    def test_one_root_with_different_radii(self):
        grid = cases.new_grid()
        dabs = [dab(220, radius=radius, is_first=radius == 1.0) for radius in (1.0, 0.7, 0.4)]
        self.assert_pinned(grid, *self.pull(grid, dabs))

    def test_only_the_last_of_several_strokes(self):
        grid = cases.new_grid()
        first = stroke((100, 101, 122))
        for root in (330, 122):
            support.empty_scene()
            grid = cases.new_grid()
            self.pull(grid, first)
            between = basis(grid)
            support.empty_scene()
            grid = cases.new_grid()
            _, after = self.pull(grid, first + stroke((root, root, root)))
            pin = self.pin(grid)
            self.assert_bits(basis(grid), between)
            self.assertEqual(pin.shape, "", "at one root, on the shape that the first stroke has left")
            self.assert_shape(grid, after, 1e-6)

    def test_each_stroke_that_does_not_accumulate_begins_with_the_first_shape(self):
        grid = cases.new_grid()
        before = basis(grid)
        _, after = self.pull(grid, stroke((100, 101)) + stroke((300, 301)), accumulate=False)
        self.assert_pinned(grid, before, after)

    def test_one_after_another(self):
        grid = cases.new_grid()
        wanted = basis(grid)
        for roots in ((100, 101, 102), (110, 131), (101, 102, 103)):
            before, after = self.pull(grid, stroke(roots))
            wanted = wanted + (after - before)
            self.pin(grid)
        self.assertEqual(len({pin.shape for pin in grid.motus.pull.pins}), 3)
        add(grid, 300, radius=0.6)
        self.assert_shape(grid, cases.pulled(wanted, 300, (0.0, 0.0, 1.0), 0.6, source=basis(grid)), 2 * ULP)
        motus.pin_move(index=0, place=2)
        motus.pin_remove(index=0)
        self.assertEqual(len([name for name in grid.data.attributes.keys() if name.startswith("motus_pin_")]), 2)

    def test_stroke_pin_of_a_shape_key(self):
        for value in (1.0, 0.25):
            support.empty_scene()
            grid = cases.new_grid()
            grid.shape_key_add(name="Basis")
            key = grid.shape_key_add(name="Key")
            key.value = value
            grid.active_shape_key_index = 1
            before = evaluated(grid)
            motus.pick_pull(dabs=stroke(self.ALONG), strength=1.0, radius=0.6)
            after = evaluated(grid)
            pin = self.pin(grid)
            self.assert_shape(grid, after, ULP)
            pin.strength = 0.0
            self.assert_bits(evaluated(grid), before)

    def test_of_a_shape_key_that_is_not_seen(self):
        grid = cases.new_grid()
        grid.shape_key_add(name="Basis")
        grid.shape_key_add(name="Key").value = 0.0
        grid.active_shape_key_index = 1
        motus.pick_pull(dabs=stroke(self.ALONG), strength=1.0, radius=0.6)
        self.assert_refused("The shape key Key is not seen", motus.pin_add, from_last=True)

    def test_stroke_pin_after_redo(self):
        """Undo and redo of the two operators; the brush's session has its own undo."""
        grid = cases.new_grid()
        bpy.ops.ed.undo_push(message="built")
        before, after = self.pull(grid, stroke(self.ALONG))
        bpy.ops.ed.undo_push(message="pulled")
        self.pin(grid)
        bpy.ops.ed.undo_push(message="pinned")
        bpy.ops.ed.undo()
        grid = bpy.data.objects["Grid"]
        self.assertEqual(len(grid.motus.pull.pins), 0)
        self.assert_bits(evaluated(grid), after)
        bpy.ops.ed.redo()
        grid = bpy.data.objects["Grid"]
        self.assert_bits(basis(grid), before)
        self.assert_shape(grid, after, ULP)


class KeptTest(StrokesTestCase):
    def stroked(self, obj=None):
        obj = obj or cases.new_grid()
        before, after = self.pull(obj, stroke(self.ALONG))
        return obj, self.pin(obj), before, after

    def test_keyed(self):
        grid, pin, before, after = self.stroked()
        cases.key_strength(pin, {1: 0.0, 11: 1.0})
        shapes = {}
        for frame in (6, 1, 3.5, 50, 6, 3.5):
            go_to(frame)
            share = min((frame - 1.0) / 10.0, 1.0)
            self.assert_shape(grid, before + share * (after - before), ULP)
            shape = evaluated(grid)
            self.assert_bits(shape, shapes.setdefault(frame, shape))

    def test_influence_and_mute(self):
        grid, pin, before, after = self.stroked()
        grid.motus.pull.influence = 0.25
        self.assert_shape(grid, before + 0.25 * (after - before), ULP)
        pin.is_muted = True
        self.assert_bits(evaluated(grid), before)

    def test_applied(self):
        for to in ('MESH', 'KEY', 'KEYS'):
            support.empty_scene()
            grid, pin, before, after = self.stroked()
            if to == 'KEYS':
                cases.key_strength(pin, {1: 0.0, 11: 1.0})
                go_to(11)
            self.assertEqual(motus.pin_apply(to=to), {'FINISHED'})
            self.assert_shape(grid, after, ULP)
            self.assertEqual([name for name in grid.data.attributes.keys() if name.startswith("motus")], [])
            if to == 'KEYS':
                go_to(1)
                self.assert_shape(grid, before, ULP)

    def test_removed(self):
        grid, _, before, after = self.stroked()
        active = grid.data.attributes.new("Own", 'FLOAT', 'POINT')
        grid.data.attributes.active = active
        twin = grid.copy()
        twin.name = "Twin"
        bpy.context.scene.collection.objects.link(twin)
        bpy.context.view_layer.update()
        motus.pin_remove(object="Grid", all=True)
        self.assert_bits(evaluated(grid), before)
        self.assert_shape(twin, after, ULP)
        motus.pin_remove(object="Twin", all=True)
        self.assert_bits(evaluated(twin), before)
        self.assertEqual([name for name in grid.data.attributes.keys() if name.startswith("motus")], [])
        self.assertEqual(grid.data.attributes.active.name, "Own")

    def test_saved_and_linked(self):
        _, _, _, after = self.stroked()
        path = str(self.folder / "stroke.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assert_shape(bpy.data.objects["Grid"], after, ULP)
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, into):
            into.objects = ["Grid"]
        bpy.context.scene.collection.objects.link(into.objects[0])
        bpy.context.view_layer.update()
        self.assert_shape(into.objects[0], after, ULP)

    def test_the_mesh_is_edited(self):
        """New vertices between others go between them; those that are left go where they went."""
        grid, _, before, after = self.stroked()
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.mesh.select_all(action='SELECT')
        bpy.ops.mesh.subdivide()
        bpy.context.view_layer.update()
        self.assertIsNone(problem(grid), "in Edit Mode")
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertIsNone(problem(grid))
        found, flat = evaluated(grid), basis(grid)
        for index in range(441):
            at = int(((flat - before[index]) ** 2).sum(axis=1).argmin())
            self.assertLess(np.abs(found[at] - after[index]).max(), ULP)
        middle = int(((flat - 0.5 * (before[200] + before[201])) ** 2).sum(axis=1).argmin())
        self.assertLess(np.abs(found[middle] - 0.5 * (after[200] + after[201])).max(), 2 * ULP)

    def test_stroke_pin_on_a_joined_mesh(self):
        """What joins in moves by what it has under that name, and what has nothing there stays."""
        grid, _, before, after = self.stroked()
        copied = grid.copy()
        copied.data = grid.data.copy()
        plain = cases.new_grid(name="Plain")
        bpy.context.scene.collection.objects.link(copied)
        bpy.context.view_layer.objects.active = grid
        for obj in (grid, copied, plain):
            obj.select_set(True)
        bpy.ops.object.join()
        parts = np.split(evaluated(grid), 3)  # in whichever order Blender has joined them
        for wanted, count in ((after, 2), (before, 1)):
            self.assertEqual(sum(np.abs(part - wanted).max() <= ULP for part in parts), count)
        self.assertIsNone(problem(grid))

    def test_without_a_root_there_is_nothing_to_bind_or_mirror(self):
        self.stroked()
        self.assert_refused("keeps the shape of a stroke", motus.pin_rebind)
        self.assert_refused("keeps the shape of a stroke", motus.pin_mirror)


class StrangeFileTest(StrokesTestCase):
    """The attribute that a pin names is somebody else's: it is looked at before it is used."""

    def build(self):
        grid = cases.new_grid()
        self.pull(grid, stroke(self.ALONG))
        name = self.pin(grid).shape
        root = 60
        add(grid, root, radius=0.3)
        self.other = cases.pulled(basis(grid), root, (0.0, 0.0, 1.0), 0.3)
        return grid, name

    def assert_does_nothing(self, grid, sentence):
        grid.data.update()
        setup.rewire(grid)
        self.assert_shape(grid, self.other)
        self.assertEqual(problem(grid), sentence.sentence)

    def test_gone(self):
        grid, name = self.build()
        grid.data.attributes.remove(grid.data.attributes[name])
        self.assert_does_nothing(grid, solve.NO_SHAPE)
        grid.motus.pull.active_pin = 0
        self.assertEqual(motus.pin_apply(index=1), {'FINISHED'})
        self.assertEqual(motus.pin_remove(index=0), {'FINISHED'})
        self.assert_shape(grid, self.other)

    def test_of_another_kind(self):
        for kind, domain in (
            ('FLOAT', 'POINT'),
            ('FLOAT_COLOR', 'POINT'),
            ('INT', 'POINT'),
            ('FLOAT_VECTOR', 'FACE'),
            ('FLOAT_VECTOR', 'CORNER'),
            ('FLOAT_VECTOR', 'EDGE'),
            ('FLOAT2', 'CORNER'),
        ):
            with self.subTest(f"{kind} {domain}"):
                support.empty_scene()
                grid, name = self.build()
                grid.data.attributes.remove(grid.data.attributes[name])
                grid.motus.pull.pins[0].shape = grid.data.attributes.new("motus_pin_shape", kind, domain).name
                self.assert_does_nothing(grid, solve.NO_SHAPE)

    def test_named_wrongly(self):
        grid, _ = self.build()
        for name in ("nothing", "UVMap", "motus_pin", "a" * 500, '"]', "../x"):
            grid.motus.pull.pins[0].shape = name
            self.assert_does_nothing(grid, solve.NO_SHAPE)

    def test_numbers_that_are_none(self):
        for value in (np.nan, np.inf, -np.inf, 3e38, 2e18):
            support.empty_scene()
            grid, name = self.build()
            data = grid.data.attributes[name].data
            values = np.zeros(3 * len(data), np.float32)
            values[100] = value
            data.foreach_set("vector", values)
            self.assert_does_nothing(grid, solve.UNUSABLE)

    def test_a_strength_that_is_too_large(self):
        grid, _ = self.build()
        for strength in (1e30, -3e38):
            grid.motus.pull.pins[0].strength = strength
            self.assert_does_nothing(grid, solve.UNUSABLE)
