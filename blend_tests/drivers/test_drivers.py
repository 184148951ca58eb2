"""Motion drivers: typed by hand and put on properties, also where scripts may not run by themselves."""

import json
import math

import bpy
import numpy as np

import support

MARK = "values: "
EXPRESSIONS = {
    "motus_pendulum(frame, 0.5, 2.0)": lambda n, t: n.single_pendulum(t, 0.5, length=2.0)[0],
    "motus_pendulum(frame - 12, 0.5, 2.0, 0.1, 1.6, 0.2, 2)": lambda n, t: n.single_pendulum((t - 0.5) * 2.0, 0.5, 0.1, 2.0, 1.6, 0.2)[0],
    "motus_pendulum(frame, theta=0.5, length=2.0, damping=0.1)": lambda n, t: n.single_pendulum(t, 0.5, length=2.0, damping=0.1)[0],
    "motus_double_pendulum(frame, 0, 2.0, 1.0)": lambda n, t: n.double_pendulum(t, 2.0, 1.0)[0],
    "motus_double_pendulum(frame, 3, 2.0, 1.0, 0, 0, 1, 0.5)": lambda n, t: n.double_pendulum(t, 2.0, 1.0, mass2=0.5)[3],
    "0.5 + 2 * motus_ease(frame, 24, 48, 0.2, 0.4)": lambda n, t: 0.5 + 2.0 * n.ease(t - 1.0, 0.2, 0.4),
    "motus_noise(frame, 1.5, 7)": lambda n, t: n.noise1(t * 1.5, 7),
    "3 * motus_sine(frame, 0.7, 0.25)": lambda n, t: 3.0 * math.cos(2.0 * math.pi * 0.7 * t),
    "motus_triangle(frame, 0.7)": lambda n, t: math.asin(math.sin(2.0 * math.pi * 0.7 * t)) * 2.0 / math.pi,
    "motus_saw(frame, 0.7, 0.1)": lambda n, t: 2.0 * ((0.7 * t + 0.1) % 1.0) - 1.0,
    "motus_square(frame, 0.7, 0, 0.3)": lambda n, t: 1.0 if 0.7 * t % 1.0 < 0.3 else -1.0,
    "motus_steps(frame, 0.7, 3, 0.25)": lambda n, t: n.steps(0.7 * t, 3, 0.25),
}
"""(native module, time in seconds at 24 frames a second) -> value."""


def driven_cubes():
    """An object for each of EXPRESSIONS, typed by hand on its location."""
    cubes = []
    for index, expression in enumerate(EXPRESSIONS):
        cube = bpy.data.objects.new(f"Cube {index}", None)
        bpy.context.scene.collection.objects.link(cube)
        cube.driver_add("location", 0).driver.expression = expression
        cubes.append(cube)
    return cubes


def locations(frames):
    """x of all objects by name, on each frame."""
    found = []
    for frame in frames:
        support.go_to(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        found.append({obj.name: obj.evaluated_get(depsgraph).matrix_world.translation.x for obj in bpy.data.objects})
    return found


def print_locations(path, frames, use_scripts):
    bpy.ops.wm.open_mainfile(filepath=path, use_scripts=use_scripts)
    print(MARK + json.dumps(locations(frames)), flush=True)


def native():
    return support.addon("core.native").module


class DriverTestCase(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.cube = self.link("Cube")
        bpy.context.view_layer.objects.active = self.cube

    def value(self, frame, path="location", index=0, obj=None):
        support.go_to(frame)
        evaluated = (obj or self.cube).evaluated_get(bpy.context.evaluated_depsgraph_get())
        found = evaluated.path_resolve(path)
        return found[index] if index >= 0 else found

    def refused(self, sentence, operator=bpy.ops.motus.driver_add, **keywords):
        with self.assertRaisesRegex(RuntimeError, sentence):
            operator(**keywords)


class Functions(DriverTestCase):
    def test_hand_written_drivers_at_any_frame_and_frame_rate(self):
        cubes = driven_cubes()
        for fps, base in ((24, 1.0), (30, 1.001)):
            bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = fps, base
            for frame in (30, 1, 100.25, -7):
                (found,) = locations([frame])
                for cube, (expression, wanted) in zip(cubes, EXPRESSIONS.items()):
                    if fps != 24 and ("ease" in expression or "frame -" in expression):
                        continue  # what counts in frames
                    with self.subTest(expression, frame=frame, fps=fps):
                        self.assertAlmostEqual(found[cube.name], wanted(native(), frame * base / fps), 4)

    def test_steps_and_jumps_come_on_their_frames(self):
        """At 24 frames a second seconds are not exact, but waves and steps that take whole frames are."""
        for index, expression in enumerate(("motus_steps(frame, 2, 5)", "motus_saw(frame, 2)", "motus_square(frame, 2)")):
            self.cube.driver_add("location", index).driver.expression = expression
        for step in range(60):
            found = [[self.value(12 * step + frame, index=index) for index in range(3)] for frame in (0, 11, 11.75)]
            self.assertEqual(found[0][0], found[2][0])
            self.assertAlmostEqual(found[0][0], native().steps(step, 5), 6)
            self.assertEqual([row[1] for row in found], [-1.0, np.float32(2 * 11 / 12 - 1), np.float32(2 * 11.75 / 12 - 1)])
            self.assertEqual([row[2] for row in found], [1.0, -1.0, -1.0])

    def test_noise_that_loops(self):
        self.cube.driver_add("location", 0).driver.expression = "motus_noise(frame, 2, 7, 100)"
        for frame in (1, 30.5, 77, 99.75):
            self.assertEqual(self.value(frame), self.value(frame + 100))
            self.assertEqual(self.value(frame), self.value(frame + 2300))
        self.assertNotAlmostEqual(self.value(20), self.value(70), 2)
        # 100 frames are 4.17 seconds, and 8 units of noise, which is nowhere else than it would be without a loop.
        self.assertAlmostEqual(self.value(30), native().noise1(30 / 100 * 8.0, 7), 5)
        slopes = [(self.value(frame + 0.125) - self.value(frame - 0.125)) / 0.25 for frame in (99.75, 100, 100.25)]
        self.assertAlmostEqual(slopes[0], slopes[2], delta=0.01)
        self.assertAlmostEqual(slopes[1], (slopes[0] + slopes[2]) / 2.0, delta=1e-3)

    def test_without_auto_run(self):
        driven_cubes()
        frames = [30, 1, 77.5]
        wanted = locations(frames)
        path = str(self.folder / "driven.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        status, output = support.run_beside(
            f"from drivers import test_drivers as tests\ntests.print_locations({path!r}, {frames!r}, False)\n"
        )
        self.assertEqual(status, 0, output)
        self.assertEqual(json.loads(output.split(MARK)[1].splitlines()[0]), wanted)

    def test_bad_arguments_leave_the_driver_alive(self):
        driver = self.cube.driver_add("location", 0).driver
        for bad, rest in (
            ("motus_pendulum(frame, 0.5, 0)", 0.5),
            ("motus_pendulum(frame, 0.5, -2)", 0.5),
            ("motus_pendulum(frame, 0.25, 'a')", 0.25),
            ("motus_pendulum(frame, 1e400, 1)", 0.0),
            ("motus_pendulum(frame, 0.5, 1, 1.7e308, 1e-10)", 0.5),
            ("motus_pendulum(frame, 0.5, 5e-324)", 0.5),
            ("motus_pendulum(frame * 1e6, 0.5, 1, 0, 9.81, 1e4)", 0.5),
            ("motus_double_pendulum(frame, 7, 0.5, 0.5)", 0.0),
            ("motus_double_pendulum(frame * 1e12, 1, 2, 0.75)", 0.75),
            ("motus_ease(frame, 10, 5, 0.9, 0.9)", 1.0),
            ("motus_ease(frame, 1, 50, 0.9, 0.9)", 0.0),
            ("motus_noise(frame, 1, -3)", 0.0),
            ("motus_noise(frame, 1e12, 3, 100)", 0.0),
            ("motus_noise(frame, 1, 3, 'a')", 0.0),
            ("motus_sine(frame, 1e400)", 0.0),
            ("motus_square(frame, 1, 0, 2)", 0.0),
            ("motus_steps(frame, 1, 3, -1)", 0.0),
        ):
            with self.subTest(bad):
                driver.expression = bad
                self.assertAlmostEqual(self.value(20), rest, 6)
                self.assertTrue(driver.is_valid)
        driver.expression = "motus_pendulum(frame, 0.5, 2)"
        self.assertNotEqual(self.value(20), self.value(25))


class Add(DriverTestCase):
    def test_each_function_on_any_property(self):
        material = bpy.data.materials.new("Paint")
        material.use_nodes = True
        curve = self.link("Curve", bpy.data.curves.new("Curve", 'CURVE'))
        self.cube["own"] = 0.0
        self.cube["own row"] = [0.0, 1.0]
        curve.modifiers.new("Wave", 'WAVE')
        for names, function in (
            ({"datablock": "Cube", "data_path": "rotation_euler", "index": 1}, 'PENDULUM'),
            ({"datablock": "Cube", "data_path": "location[2]"}, 'DOUBLE_PENDULUM'),
            ({"datablock": "Cube", "data_path": '["own"]'}, 'NOISE'),
            ({"datablock": "Cube", "data_path": '["own row"][1]'}, 'EASE'),
            ({"datablock": "Curve", "data_path": 'modifiers["Wave"].height'}, 'NOISE'),
            ({"collection": 'curves', "datablock": "Curve", "data_path": "bevel_depth"}, 'PENDULUM'),
            (
                {
                    "collection": 'materials',
                    "datablock": "Paint",
                    "data_path": f'node_tree.nodes["{material.node_tree.nodes[0].name}"].inputs[0].default_value[0]',
                },
                'NOISE',
            ),
            ({"collection": 'scenes', "datablock": "Scene", "data_path": "gravity", "index": 2}, 'NOISE'),
        ):
            with self.subTest(names["data_path"]):
                self.assertEqual(bpy.ops.motus.driver_add(function=function, **names), {'FINISHED'})
        tree = material.node_tree
        self.assertEqual(
            [len(one.animation_data.drivers) for one in (self.cube, curve, curve.data, tree, bpy.context.scene)], [4, 1, 1, 1, 1]
        )
        self.assertTrue(all(one.driver.is_valid for one in self.cube.animation_data.drivers))

    def test_the_motion_is_about_the_value_that_is_there(self):
        self.cube.location = 1.0, 2.0, 3.0
        bpy.ops.motus.driver_add(
            datablock="Cube", data_path="location", index=1, function='PENDULUM', theta=0.5, length=2.0, amplitude=3.0, start=10.0
        )
        wanted = 2.0 + 3.0 * native().single_pendulum((37.0 - 10.0) / 24.0, 0.5, length=2.0)[0]
        self.assertAlmostEqual(self.value(37, index=1), wanted, 5)
        self.assertEqual(self.value(37, index=0), 1.0)
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", index=1, replace=True, base=0.0, theta=0.5, length=2.0)
        self.assertAlmostEqual(self.value(10, index=1), native().single_pendulum(10.0 / 24.0, 0.5, length=2.0)[0], 6)

    def test_all_components_at_once_each_by_a_noise_of_its_own(self):
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", function='NOISE', speed=2.0)
        found = [self.value(33, index=index) for index in range(3)]
        for index in range(3):
            self.assertAlmostEqual(found[index], native().noise1(33.0 / 12.0, index), 6)

    def test_removed_with_the_value_kept(self):
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", function='NOISE')
        shown = [self.value(50, index=index) for index in range(3)]
        self.assertEqual(bpy.ops.motus.driver_remove(datablock="Cube", data_path="location"), {'FINISHED'})
        self.assertFalse(self.cube.animation_data and self.cube.animation_data.drivers)
        self.assertEqual([self.value(80, index=index) for index in range(3)], shown)
        self.refused("has no motion driver", bpy.ops.motus.driver_remove, datablock="Cube", data_path="location")

    def test_removed_from_a_node_tree(self):
        lamp, paint = bpy.data.lights.new("Lamp", 'POINT'), bpy.data.materials.new("Paint")
        lamp.use_nodes = paint.use_nodes = True
        ball = self.link("Ball", bpy.data.meshes.new("Ball"))
        ball.data.materials.append(paint)
        for collection, holder, obj in (("materials", paint, ball), ("lights", lamp, self.link("Lamp", lamp))):
            with self.subTest(collection):
                tree = holder.node_tree
                path = next(
                    f'nodes["{node.name}"].inputs[{index}].default_value'
                    for node in tree.nodes
                    for index, socket in enumerate(node.inputs)
                    if socket.type == 'VALUE'
                )
                names = {"collection": collection, "datablock": holder.name}
                bpy.ops.motus.driver_add(data_path=f"node_tree.{path}", function='NOISE', **names)
                (found,) = support.addon("drivers.places").of_object(obj)
                self.assertEqual((found.holder, found.path), (tree, f"node_tree.{path}"))
                shown = tree.evaluated_get(bpy.context.evaluated_depsgraph_get()).path_resolve(path)
                self.assertEqual(bpy.ops.motus.driver_remove(**names), {'FINISHED'})
                self.assertFalse(tree.animation_data and tree.animation_data.drivers)
                self.assertEqual(tree.path_resolve(path), shown)

    def test_an_image_that_an_empty_shows(self):
        """Blender animates no images, and says nothing of what does."""
        self.cube.empty_display_type, self.cube.data = 'IMAGE', bpy.data.images.new("Card", 4, 4)
        self.assertEqual(support.addon("drivers.places").of_object(self.cube), [])
        self.refused("can be driven", collection='images', datablock="Card", data_path="generated_color")

    def test_removed_though_the_property_is_gone(self):
        cube = self.cube
        cube["gone"], cube["word"], cube["short"] = 1.0, 1.0, [1.0, 2.0, 3.0]
        for path in ('["gone"]', '["word"]', '["short"]', "scale"):
            bpy.ops.motus.driver_add(datablock="Cube", data_path=path, function='NOISE')
        del cube["gone"]
        cube["word"], cube["short"] = "a", [1.0]
        bpy.ops.motus.driver_remove(datablock="Cube", data_path='["gone"]')
        self.assertEqual(sorted({one.data_path for one in cube.animation_data.drivers}), ['["short"]', '["word"]', "scale"])
        bpy.ops.motus.driver_remove(datablock="Cube")
        self.assertFalse(cube.animation_data and cube.animation_data.drivers)

    def test_invalid_properties_are_refused(self):
        self.cube.driver_add("location", 0).driver.expression = "frame"
        self.cube["word"] = "a"
        self.refused("location has a driver already", datablock="Cube", data_path="location", index=0)
        self.refused("location has a driver already", datablock="Cube", data_path="location")
        self.assertEqual(len(self.cube.animation_data.drivers), 1)
        for sentence, keywords in (
            ("There is no Gone in objects", {"datablock": "Gone", "data_path": "location"}),
            ("Cube has no property nothing", {"data_path": "nothing"}),
            ("Cube has no property", {"data_path": 'modifiers["Gone"].strength'}),
            ("Cube has no property", {"data_path": "__class__.x"}),
            ("name is no number", {"data_path": "name"}),
            ("parent is no number", {"data_path": "parent"}),
            ("location.x is no number", {"data_path": "location.x"}),
            ("keys is no number", {"data_path": "keys"}),
            ("matrix_world is no number", {"data_path": "matrix_world"}),
            (r'\["word"\] is no number', {"data_path": '["word"]'}),
            ("location has 3 components", {"data_path": "location", "index": 5}),
            ("There is no Gone in materials", {"collection": 'materials', "datablock": "Gone", "data_path": "roughness"}),
            ("length: must be greater than 0", {"data_path": "scale", "index": 0, "length": 0.0}),
            ("is not a finite number", {"data_path": "scale", "index": 0, "theta": math.inf}),
            ("Point at a property", {}),
        ):
            with self.subTest(sentence, **keywords):
                self.refused(sentence, **keywords)
        self.assertEqual(len(self.cube.animation_data.drivers), 1)

    def test_what_the_dialog_begins_with_has_no_driver(self):
        free = support.addon("drivers.places").free_channel
        self.assertEqual(free(self.cube), 'ROTATION_X')
        bpy.ops.motus.driver_add(channel='ROTATION_X')
        self.cube.driver_add("rotation_euler", 1)
        self.assertEqual(free(self.cube), 'ROTATION_Z')
        self.cube.rotation_mode = 'QUATERNION'
        self.assertEqual(free(self.cube), 'LOCATION_X')

    def test_linked_data_is_refused(self):
        path = str(self.folder / "library.blend")
        bpy.data.libraries.write(path, {self.cube})
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, into):
            into.objects = ["Cube"]
        self.refused("is linked from another file", datablock="Cube", data_path="location", index=0)


class Tried(DriverTestCase):
    """What acts while the dialog is open (drivers/trial.py)."""

    def described(self):
        animation = self.cube.animation_data
        drivers = animation and [
            (one.data_path, one.array_index, one.driver.type, one.driver.use_self, one.driver.expression) for one in animation.drivers
        ]
        return drivers, [*self.cube.location, *self.cube.rotation_euler, *self.cube.scale], self.cube.rotation_mode

    def test_taken_back_exactly(self):
        places = support.addon("drivers.places")
        self.cube.location = 0.1, 0.2, 0.3
        self.cube.rotation_mode = 'ZYX'
        self.cube.rotation_euler = 0.4, 0.5, 0.6
        for is_driven in (False, True):
            if is_driven:
                bpy.ops.motus.driver_add(datablock="Cube", data_path="location", index=1, function='PENDULUM')
                self.cube.driver_add("scale", 2).driver.type = 'MAX'
                support.go_to(9)
            before = self.described()
            tried = support.addon("drivers.trial").Trial()
            for frame in (3, 20, 9):
                tried.take_back()
                for path, index in (("location", -1), ("rotation_euler", 1), ("scale", 2)):
                    for place in places.find(self.cube, path, index):
                        tried.put(place, f"motus_noise(frame, 2, {frame})")
                self.assertAlmostEqual(self.value(frame, index=1), native().noise1(frame / 12.0, frame), 5)
            self.assertNotEqual(self.described(), before)
            tried.end()
            support.go_to(9)
            self.assertEqual(self.described(), before)


class WriteOut(DriverTestCase):
    """motus.driver_write_out."""

    FRAMES = 1, 7.25, 30, 59.5, 100, -20

    def added(self, function, index=0, **keywords):
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", index=index, function=function, **keywords)

    def written(self, index=0, **keywords):
        bpy.ops.motus.driver_write_out(datablock="Cube", data_path="location", index=index, **keywords)
        return self.cube.animation_data.drivers.find("location", index=index)

    def test_waves_and_ease_become_expressions_without_python(self):
        scene = bpy.context.scene
        for fps, base in ((24, 1.0), (30, 1.001)):
            scene.render.fps, scene.render.fps_base = fps, base
            for function, keywords in (
                ('SINE', {"frequency": 0.7, "phase": 0.2, "start": 5.5}),
                ('SINE', {}),
                ('TRIANGLE', {"frequency": 1.3, "start": -3.0}),
                ('SAW', {"frequency": 0.9}),
                ('SQUARE', {"frequency": 0.8, "share": 0.3, "phase": 0.6}),
                ('EASE', {"frame_start": 10.0, "frame_end": 60.0}),
                ('EASE', {"frame_start": 10.0, "frame_end": 60.0, "ease_in": 0.0, "ease_out": 1.0}),
                ('EASE', {"frame_start": 10.0, "frame_end": 60.0, "ease_in": 0.0, "ease_out": 0.0}),
                ('EASE', {"frame_start": 60.0, "frame_end": 10.0}),
            ):
                with self.subTest(function, fps=fps, **keywords):
                    self.added(function, base=2.0, amplitude=-3.0, **keywords)
                    wanted = [self.value(frame) for frame in self.FRAMES]
                    driver = self.written().driver
                    self.assertNotIn("motus", driver.expression)
                    self.assertTrue(driver.is_simple_expression, driver.expression)
                    for frame, value in zip(self.FRAMES, wanted):
                        self.assertAlmostEqual(self.value(frame), value, 5)
                    self.cube.driver_remove("location", 0)

    def test_other_motions_become_few_keys(self):
        for function, keywords in (
            ('NOISE', {"speed": 2.0, "seed": 3}),
            ('PENDULUM', {"theta": 1.0, "damping": 0.2}),
            ('DOUBLE_PENDULUM', {}),
            ('STEPS', {"frequency": 2.0, "blend": 0.4}),
        ):
            counts = []
            for tolerance in (0.0005, 0.02):
                with self.subTest(function, tolerance=tolerance):
                    self.added(function, amplitude=2.0, **keywords)
                    frames = [1.0 + step * 0.625 for step in range(190)]
                    wanted = [self.value(frame) for frame in frames]
                    self.assertIsNone(self.written(tolerance=tolerance, frame_start=1, frame_end=120))
                    curve = support.addon("core.blender.actions").find(self.cube, "location", 0)
                    counts.append(len(curve.keyframe_points))
                    found = [self.value(frame) for frame in frames]
                    np.testing.assert_allclose(found, wanted, atol=1.25 * tolerance)
                    self.cube.animation_data_clear()
                    self.cube.location.x = 0.0
            self.assertLess(counts[1], 0.8 * counts[0])
            self.assertLess(counts[0], 120)

    def test_steps_become_a_held_key_each(self):
        self.added('STEPS', frequency=1.6, seed=2, start=4.0)
        frames = [1.0 + step * 0.25 for step in range(480)]
        wanted = [self.value(frame) for frame in frames]
        self.written(frame_start=1, frame_end=120)
        curve = support.addon("core.blender.actions").find(self.cube, "location", 0)
        self.assertEqual([key.co.x for key in curve.keyframe_points], [1.0, *(4.0 + 15.0 * step for step in range(8))])
        self.assertEqual([self.value(frame) for frame in frames], wanted)

    def test_steps_between_frames_have_the_values_that_are_shown(self):
        self.added('STEPS', frequency=0.7, seed=2, start=0.3)
        frames = [1.0 + step * 0.25 for step in range(480)]
        wanted = [self.value(frame) for frame in frames]
        self.written(frame_start=1, frame_end=120)
        self.assertEqual([self.value(frame) for frame in frames], wanted)

    def test_a_loop_becomes_one_cycle(self):
        self.added('NOISE', loop=48, seed=5)
        frames = [3.0, 20.5, 47.0, 200.0, 1001.25, -77.0]
        wanted = [self.value(frame) for frame in frames]
        self.written(tolerance=1e-4)
        curve = support.addon("core.blender.actions").find(self.cube, "location", 0)
        self.assertEqual([modifier.type for modifier in curve.modifiers], ['CYCLES'])
        self.assertEqual(curve.keyframe_points[-1].co.x - curve.keyframe_points[0].co.x, 48.0)
        np.testing.assert_allclose([self.value(frame) for frame in frames], wanted, atol=2e-4)

    def test_all_of_an_object_in_one_pass(self):
        """Also what was written by hand, what follows keys that stand on the property itself, and where time is stretched."""
        bpy.context.scene.render.frame_map_new = 150
        for frame, place in ((1, 0.0), (30, 2.0), (50, 0.0)):
            self.cube.location.z = place
            self.cube.keyframe_insert("location", index=2, frame=frame)
        self.added('SECOND_ORDER', index=2)
        self.added('SAW', index=1)
        driver = self.cube.driver_add("scale", 0).driver
        driver.expression = "1 + motus_noise(frame, 2) * motus_sine(frame, 1)"
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 100
        frames = [1, 20, 50.5, 99]
        wanted = [[self.value(frame, path, index) for path, index in (("location", 2), ("location", 1), ("scale", 0))] for frame in frames]
        support.go_to(17)
        bpy.ops.motus.driver_write_out(datablock="Cube", tolerance=1e-4)
        self.assertEqual(bpy.context.scene.frame_current, 17)
        self.assertEqual([curve.data_path for curve in self.cube.animation_data.drivers], ["location"])
        for frame, values in zip(frames, wanted):
            found = [self.value(frame, path, index) for path, index in (("location", 2), ("location", 1), ("scale", 0))]
            np.testing.assert_allclose(found, values, atol=3e-4)
        self.assertEqual(support.addon("drivers.places").of_object(self.cube), [])

    def test_a_node_of_a_material(self):
        paint = bpy.data.materials.new("Paint")
        paint.use_nodes = True
        self.link("Ball", bpy.data.meshes.new("Ball")).data.materials.append(paint)
        name = paint.node_tree.nodes[0].name
        path = next(
            f'nodes["{name}"].inputs[{index}].default_value'
            for index, one in enumerate(paint.node_tree.nodes[0].inputs)
            if one.type == 'VALUE'
        )
        names = {"collection": 'materials', "datablock": "Paint"}
        bpy.ops.motus.driver_add(data_path=f"node_tree.{path}", function='NOISE', **names)
        wanted = [self.value(frame, path, -1, paint.node_tree) for frame in (5, 40.5)]
        bpy.ops.motus.driver_write_out(tolerance=1e-4, **names)
        self.assertFalse(paint.node_tree.animation_data.drivers)
        np.testing.assert_allclose([self.value(frame, path, -1, paint.node_tree) for frame in (5, 40.5)], wanted, atol=2e-4)

    def test_keys_where_expressions_are_not_wanted_and_on_whole_numbers(self):
        self.cube["count"] = 3
        bpy.ops.motus.driver_add(datablock="Cube", data_path='["count"]', function='SINE', base=5.0, amplitude=4.0)
        wanted = [self.value(frame, '["count"]', -1) for frame in range(1, 60)]
        bpy.ops.motus.driver_write_out(datablock="Cube", data_path='["count"]', as_keys=True, frame_start=1, frame_end=60)
        self.assertFalse(self.cube.animation_data.drivers)
        self.assertEqual([self.value(frame, '["count"]', -1) for frame in range(1, 60)], wanted)

    def test_refused(self):
        write = bpy.ops.motus.driver_write_out
        self.refused("Cube has no motion driver", write, datablock="Cube")
        self.added('NOISE')
        for sentence, keywords in (
            ("The end must come after the start", {"frame_start": 10, "frame_end": 10}),
            ("At most 20000 frames", {"frame_start": 1, "frame_end": 100000}),
            ("has no motion driver", {"data_path": "scale"}),
            ("is not a finite number", {"tolerance": math.nan}),
        ):
            self.refused(sentence, write, datablock="Cube", **keywords)
        self.cube.hide_viewport = True
        self.refused("does not evaluate Cube", write, datablock="Cube")
        self.cube.hide_viewport = False
        self.cube.hide_set(True)
        self.refused("does not evaluate Cube", write, datablock="Cube")
        self.cube.hide_set(False)
        paint = bpy.data.materials.new("Paint")
        bpy.ops.motus.driver_add(collection='materials', datablock="Paint", data_path="roughness", function='NOISE')
        self.refused("does not evaluate Paint", write, collection='materials', datablock="Paint")
        self.assertTrue(paint.animation_data.drivers)
        self.added('STEPS', index=1, frequency=1e6)
        self.refused("More than 20000 steps", write, datablock="Cube")
        self.assertEqual(len(self.cube.animation_data.drivers), 2)


class CopyToSelected(DriverTestCase):
    """motus.driver_copy."""

    def setUp(self):
        super().setUp()
        self.others = [self.link(f"Other {number}") for number in range(3)]
        for number, obj in enumerate((self.cube, *self.others)):
            obj.select_set(True)
            obj.location = number, 0.0, 0.0

    def expression(self, obj, path="location", index=0):
        return obj.animation_data.drivers.find(path, index=index).driver.expression

    def test_to_objects_with_seeds_bases_and_delays_of_their_own(self):
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", function='NOISE', speed=2.0, seed=4)
        bpy.ops.motus.driver_copy(datablock="Cube", data_path="location", delay=3.0)
        for number, obj in enumerate(self.others, start=1):
            self.assertEqual(self.expression(obj), f"{number} + motus_noise(frame - {3 * number}, 2, {4 + 16 * number})")
            self.assertEqual(self.expression(obj, index=2), f"motus_noise(frame - {3 * number}, 2, {6 + 16 * number})")
        bpy.ops.motus.driver_copy(datablock="Cube", data_path="location[0]", own_base=False, own_seeds=False)
        self.assertEqual({self.expression(obj) for obj in self.others}, {"motus_noise(frame, 2, 4)"})
        bpy.ops.motus.driver_add(datablock="Cube", data_path="scale", index=0, function='EASE')
        bpy.ops.motus.driver_copy(datablock="Cube", data_path="scale", index=0, delay=10.0)
        self.assertEqual(self.expression(self.others[1], "scale"), "1 + motus_ease(frame, 21, 70)")

    def test_to_data_and_not_twice_to_what_is_shared(self):
        lights = [bpy.data.lights.new(name, 'POINT') for name in ("A", "B")]
        lamps = [self.link(f"Lamp {number}", lights[number // 2]) for number in range(4)]
        for lamp in lamps:
            lamp.select_set(True)
        lights[0].energy, lights[1].energy = 10.0, 20.0
        bpy.context.view_layer.objects.active = lamps[0]
        names = {"collection": 'lights', "datablock": "A", "data_path": "energy"}
        bpy.ops.motus.driver_add(function='SINE', amplitude=5.0, **names)
        bpy.ops.motus.driver_copy(**names)
        self.assertEqual(self.expression(lights[1], "energy"), "20 + 5 * motus_sine(frame)")
        self.assertEqual(self.expression(lights[0], "energy"), "10 + 5 * motus_sine(frame)")

    def test_to_bones(self):
        rig = self.link("Rig", bpy.data.armatures.new("Rig"))
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        for name in ('a', 'b "c"'):
            bone = rig.data.edit_bones.new(name)
            bone.tail = 0.0, 0.0, 1.0
        bpy.ops.object.mode_set(mode='POSE')
        for bone in rig.pose.bones:
            bone.rotation_mode = 'XYZ'
        bpy.ops.pose.select_all(action='SELECT')
        path = 'pose.bones["a"].rotation_euler'
        bpy.ops.motus.driver_add(datablock="Rig", data_path=path, index=1, function='STEPS', frequency=2.0)
        bpy.ops.motus.driver_copy(datablock="Rig", data_path=path, index=1)
        self.assertEqual(self.expression(rig, rig.pose.bones[1].path_from_id("rotation_euler"), 1), "motus_steps(frame, 2, 16)")
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_what_follows_keys_follows_its_own(self):
        for obj in (self.cube, self.others[0]):
            for frame, place in ((1, 0.0), (20, 2.0)):
                obj.location.x = place
                obj.keyframe_insert("location", index=0, frame=frame)
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", index=0, function='SECOND_ORDER')
        bpy.ops.motus.driver_copy(datablock="Cube", data_path="location", index=0)
        self.assertEqual(self.expression(self.others[0]), self.expression(self.cube))
        self.assertFalse(any(obj.animation_data for obj in self.others[1:]))

    def test_refused(self):
        copy = bpy.ops.motus.driver_copy
        self.refused("location has no motion driver", copy, datablock="Cube", data_path="location")
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", index=0, function='SINE')
        for obj in self.others:
            obj.driver_add("location", 0).driver.expression = "7"
        self.refused("Nothing else that is selected", copy, datablock="Cube", data_path="location", index=0)
        self.assertEqual({self.expression(obj) for obj in self.others}, {"7"})


class FollowedKeys(DriverTestCase):
    """motus_second_order."""

    def setUp(self):
        super().setUp()
        bpy.context.scene.frame_start = 1
        for frame, place in ((1, 0.0), (20, 0.0), (40, 2.0), (70, -1.0)):
            self.cube.location.x = place
            self.cube.keyframe_insert("location", index=0, frame=frame)

    def wanted(self, frame, numbers, fps=24.0):
        """By the filter over the F-curve, sampled more finely than the driver does."""
        curve = support.addon("core.blender.actions").find(self.cube, "location", 0)
        frames = [1.0 + part / 32.0 for part in range(32 * 150)]
        track = native().Track(
            native().SecondOrder(*numbers), [(one - 1.0) / fps for one in frames], [[curve.evaluate(one)] for one in frames]
        )
        return track.evaluate((frame - 1.0) / fps)[0]

    def test_own_keys_and_those_of_another_property(self):
        numbers = 2.0, 0.3, 0.5
        keywords = dict(zip(("frequency", "damping_ratio", "response"), numbers))
        bpy.ops.motus.driver_add(
            datablock="Cube", data_path="location", index=2, function='SECOND_ORDER', source="location", source_index=0, **keywords
        )
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", index=0, function='SECOND_ORDER', **keywords)
        frames = [45, 1, 100, 30.25, 72, -20]
        found = [[self.value(frame, index=index) for index in (0, 2)] for frame in frames]
        for frame, (own, other) in zip(frames, found):
            with self.subTest(frame=frame):
                self.assertAlmostEqual(own, self.wanted(frame, numbers), delta=2e-3)
                self.assertEqual(own, other)
        # Played to from the first frame on: the same bits.
        played = {frame: self.value(frame) for frame in range(1, 101)}
        for frame, (own, _) in zip(frames, found):
            if frame in played:
                self.assertEqual(played[frame], own)
        curve = support.addon("core.blender.actions").find(self.cube, "location", 0)
        curve.keyframe_points[2].co.y = 5.0
        curve.update()
        self.assertAlmostEqual(self.value(45), self.wanted(45, numbers), delta=5e-3)

    def test_two_properties_that_follow_each_other(self):
        """Both follow keys, which no driver sets: there is no loop."""
        for frame, value in ((1, 0.0), (20, 2.0)):
            self.cube.location.y = value
            self.cube.keyframe_insert("location", index=1, frame=frame)
        for index, source in ((0, 1), (1, 0)):
            bpy.ops.motus.driver_add(
                datablock="Cube", data_path="location", index=index, function='SECOND_ORDER', source="location", source_index=source
            )
        self.assertAlmostEqual(self.value(45, index=1), self.wanted(45, (1.0, 0.5, 0.0)), delta=2e-3)
        self.assertAlmostEqual(self.value(5000), 2.0, places=4)

    def test_far_frames_and_frame_rates(self):
        bpy.ops.motus.driver_add(datablock="Cube", data_path="location", index=0, function='SECOND_ORDER')
        late = self.value(5000)
        self.assertAlmostEqual(late, -1.0, places=4)
        self.assertEqual(self.value(1e6), late)
        bpy.context.scene.render.fps = 48
        self.assertAlmostEqual(self.value(45), self.wanted(45, (1.0, 0.5, 0.0), 48.0), delta=2e-3)

    def test_refused_and_at_rest_without_keys(self):
        self.refused("has no keys", datablock="Cube", data_path="scale", index=0, function='SECOND_ORDER')
        self.refused("has no property", datablock="Cube", data_path="scale", index=0, function='SECOND_ORDER', source="gone")
        driver = self.cube.driver_add("scale", 0).driver
        driver.use_self = True
        self.cube.scale.x = 3.0
        for expression, rest in (
            ("motus_second_order(self, 'location', 1, frame, 1, 0.5, 0)", 0.0),
            ("motus_second_order(self, 'gone', 0, frame, 1, 0.5, 0)", 0.0),
            ("motus_second_order(self, 'location', 0, frame, -1, 0.5, 0)", None),
            ("motus_second_order(7, 'location', 0, frame, -1, 0.5, 0)", 0.0),
        ):
            with self.subTest(expression):
                driver.expression = expression
                value = self.value(20, "scale", 0)
                self.assertTrue(driver.is_valid)
                self.assertAlmostEqual(value, self.value(20) if rest is None else rest, 5)


@support.in_one_blender
class Expressions(DriverTestCase):
    def test_the_graph_shows_what_the_functions_give(self):
        """Each function as an expression, and in the dialog's graph."""
        preview, expressions = support.addon("drivers.preview"), support.addon("drivers.expressions")
        own = {"theta": 0.7, "length": 2.0, "theta1": 1.0, "theta2": 2.0, "which": 'THETA2', "frame_start": 10.0, "frame_end": 60.0}
        frames = [0.0, 12.0, 40.5, 100.0]
        for function in expressions.FUNCTIONS:
            if function.follows:
                continue
            for loop in (0, 50) if "loop" in function.arguments else (0,):
                with self.subTest(function.identifier, loop=loop):
                    first = len(function.arguments) - len(function.defaults)
                    keywords = (
                        dict(zip(function.arguments[first:], function.defaults)) | own | {"function": function.identifier, "loop": loop}
                    )
                    shown = preview.sample(keywords, frames, 1.0 / 24.0)
                    self.cube.driver_remove("location", 0)
                    keywords |= {"start": 0.0, "amplitude": 1.0, "base": 0.0}
                    self.cube.driver_add("location", 0).driver.expression = expressions.compose(keywords)
                    for frame, value in zip(frames, shown):
                        self.assertAlmostEqual(self.value(frame), value, 4)

    def test_round_numbers_on_the_axes(self):
        ticks = support.addon("core.interface.view.graph").ticks
        for (low, high), wanted in (
            ((-1.0, 1.0), [-1.0, -0.5, 0.0, 0.5, 1.0]),
            ((0.0, 1.0), [0.0, 0.25, 0.5, 0.75, 1.0]),
            ((-28.6, 28.6), [-30.0, -15.0, 0.0, 15.0, 30.0]),
            ((3.0, 3.0), None),
            ((0.0, 0.0), None),
            ((99.97, 100.04), [99.96, 99.98, 100.0, 100.02, 100.04]),
        ):
            with self.subTest(low=low, high=high):
                found = ticks(low, high)
                self.assertTrue(found[0] <= low + 1e-9 and high - 1e-9 <= found[-1] and len(set(found)) == 5, found)
                if wanted:
                    np.testing.assert_allclose(found, wanted, atol=1e-9)

    def test_expressions_are_composed_and_parsed(self):
        expressions = support.addon("drivers.expressions")
        for text in (
            "motus_pendulum(frame, 0.5, 1)",
            "2 * motus_pendulum(frame - 12, 0.5, 2, 0, 1.6)",
            "0.1 + 0.5 * motus_noise(frame + 3, 2, 5)",
            "-1 + motus_ease(frame, 1, 50, 0.25)",
            "motus_double_pendulum(frame, 3, 2, -1, 0, 0, 1, 0.5)",
            "2 + motus_square(frame - 1, 2, 0.5, 0.25)",
            "motus_steps(frame, 0.5, 9)",
            "motus_noise(frame, 1, 0, 48)",
            "motus_second_order(self, 'pose.bones[\"a\\'b\"].location', 2, frame, 2, 0.5, -1)",
        ):
            with self.subTest(text):
                self.assertEqual(expressions.compose(self._filled(expressions.read(text))), text)
        for text in (
            "",
            "frame",
            "motus_pendulum(",
            "motus_pendulum(frame)",
            "motus_noise(frame, var)",
            "motus_gone(frame, 1)",
            "motus_pendulum(frame, 0.5, 2, key=1)",
            "(" * 5000,
            "motus_double_pendulum(frame, 9, 1, 1)",
            "motus_noise(frame, 1, 2.5)",
            "motus_noise(frame, 1, 3, 48.5)",
            "motus_noise(frame, 1, 1e400)",
        ):
            with self.subTest(text[:40]):
                self.assertIsNone(expressions.read(text))

    @staticmethod
    def _filled(keywords):
        return {"seed": 0, **keywords}
