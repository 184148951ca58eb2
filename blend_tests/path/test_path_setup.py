"""Follow Path's operators: adding, trains, removing without a trace, and what is refused."""

import bpy
import numpy as np

import support
from path.path_cases import CLIMB, PathTestCase, circle_knots, dense, positions_at


def state(obj):
    """All of an object that a system could leave a trace in."""
    animation = obj.animation_data
    return {
        "matrix": obj.matrix_world.copy(),
        "location": tuple(obj.location),
        "rotation": tuple(obj.rotation_euler),
        "scale": tuple(obj.scale),
        "constraints": [(c.type, c.name, c.influence) for c in obj.constraints],
        "properties": sorted(obj.keys()),
        "drivers": [curve.data_path for curve in animation.drivers] if animation else None,
        "action": animation.action.name if animation and animation.action else None,
        "settings": obj.is_property_set("motus"),
    }


class Add(PathTestCase):
    def test_keywords_become_settings(self):
        self.cubic()
        given = {
            "spline": -1,
            "timing": 'SPEED',
            "duration": 3.0,
            "speed": 7.0,
            "start_frame": 12.0,
            "offset": 0.5,
            "distance_factor": 0.25,
            "ease_in": 0.25,
            "ease_out": 0.5,
            "extend": 'LOOP',
            "pins_by": 'DISTANCE',
            "orientation": 'CURVATURE',
            "curvature_outward": True,
            "forward_axis": 'NEG_Z',
            "up_axis": 'POS_Y',
            "lag_rate": 0.5,
            "lag_by": 'CURVATURE',
            "bank_strength": 0.75,
            "bank_limit": 0.5,
            "bank_smoothing": 1.5,
            "gravity": 2.0,
            "influence": 0.5,
        }
        settings = self.follow(**given).motus.path
        self.assertEqual({name: getattr(settings, name) for name in given}, given)
        self.assertEqual(settings.curve.name, "Course")

    def test_adding_again_changes_only_given_settings(self):
        self.cubic()
        car = self.follow(timing='SPEED', speed=3.0, orientation='BANKING')
        constraints = len(car.constraints)
        self.follow(speed=4.0)
        settings = car.motus.path
        self.assertEqual((settings.speed, settings.timing, settings.orientation), (4.0, 'SPEED', 'BANKING'))
        self.assertEqual(len(car.constraints), constraints)

    def test_adding_again_can_change_the_curve(self):
        self.line(10.0)
        self.line(20.0, "Other")
        car = self.follow(timing='MANUAL', distance_factor=1.0)
        car.motus.path.curve = bpy.data.objects["Other"]
        self.assertPlace(car, np.array((20.0, 0.0, 0.0)))
        car.motus.path.curve = None
        self.assertIn("Choose a curve", self.sentence(car))

    def test_selected_objects_follow_the_selected_curve(self):
        curve = self.line(10.0)
        cars = [self.link("Car A"), self.link("Car B")]
        for obj in (curve, *cars):
            obj.select_set(True)
        bpy.context.view_layer.objects.active = curve
        bpy.ops.motus.path_follow_add()
        self.assertTrue(all(car.motus.path.is_active and car.motus.path.curve == curve for car in cars))
        self.assertFalse(curve.motus.path.is_active)
        bpy.ops.motus.path_follow_remove()
        self.assertFalse(any(car.motus.path.is_active for car in cars))

    def test_a_curve_can_follow_by_name(self):
        self.line(10.0)
        self.cubic(name="Rider")
        rider = self.follow("Rider", timing='MANUAL', distance_factor=0.5)
        self.assertPlace(rider, np.array((5.0, 0.0, 0.0)))

    def test_two_followers_do_not_mind_each_other(self):
        self.line(10.0)
        first = self.follow("First", timing='MANUAL', distance_factor=0.2)
        second = self.follow("Second", timing='MANUAL', distance_factor=0.7)
        self.assertPlace(first, np.array((2.0, 0.0, 0.0)))
        bpy.ops.motus.path_follow_remove(object="First")
        self.assertPlace(second, np.array((7.0, 0.0, 0.0)))

    def test_refusals(self):
        curve = self.cubic()
        self.link("Car")
        add = bpy.ops.motus.path_follow_add
        self.assertRefused("no object Nobody", add, object="Nobody", curve="Course")
        self.assertRefused("no object Nowhere", add, object="Car", curve="Nowhere")
        self.assertRefused("Car is not a curve", add, object="Car", curve="Car")
        self.assertRefused("cannot follow itself", add, object="Course", curve="Course")
        curve.parent = self.link("Carrier")
        self.assertRefused("moved by Carrier", add, object="Carrier", curve="Course")
        self.assertRefused("Choose a curve", add, object="Car")
        self.assertFalse(bpy.data.objects["Car"].motus.path.is_active)
        self.assertRefused("Nothing here follows", bpy.ops.motus.path_follow_remove, object="Car")

    def test_linked_object_is_refused(self):
        self.line(10.0)
        self.link("Car")
        library = str(self.folder / "library.blend")
        bpy.data.libraries.write(library, {bpy.data.objects["Car"]}, fake_user=True)
        bpy.data.objects.remove(bpy.data.objects["Car"])
        with bpy.data.libraries.load(library, link=True) as (_, chosen):
            chosen.objects = ["Car"]
        self.scene.collection.objects.link(chosen.objects[0])
        self.assertRefused("linked", bpy.ops.motus.path_follow_add, object="Car", curve="Course")


class Replaced(PathTestCase):
    def test_animation_of_its_own_that_the_path_replaces_is_told(self):
        """The place does not change by what is told, and does by what is not."""
        replaces = support.addon("path.panel").replaces_animation
        self.cubic()
        car = self.link("Car")
        self.follow(orientation='NONE')
        self.assertFalse(replaces(car))
        for number, (path, orientation, influence, is_told) in enumerate(
            (
                ("location", 'NONE', 1.0, True),
                ("location", 'NONE', 0.5, False),
                ("scale", 'BANKING', 1.0, False),
                ("rotation_euler", 'NONE', 1.0, False),
                ("rotation_euler", 'BANKING', 1.0, True),
            ),
            1,
        ):
            with self.subTest(path=path, orientation=orientation, influence=influence):
                car.motus.path.orientation, car.motus.path.influence = orientation, influence
                self.at(car, 1)
                before = car.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.copy()
                driver = car.driver_add(path, 0).driver
                driver.expression = f"0.1 * {number}"
                self.assertEqual(replaces(car), is_told)
                self.at(car, 1)
                after = car.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world
                self.assertEqual(np.allclose(before, after, atol=1e-6), is_told)
                car.driver_remove(path, 0)


class Presets(PathTestCase):
    def test_presets_are_saved_and_applied_again(self):
        self.line(10.0)
        car = self.follow(timing='SPEED', speed=9.0, orientation='BANKING', start_frame=33.0)
        bpy.context.view_layer.objects.active = car
        take_up = self.keep_preset("path")
        self.follow(timing='DURATION', speed=1.0, orientation='NONE', start_frame=2.0)
        take_up()
        settings = car.motus.path
        self.assertEqual((settings.timing, settings.speed, settings.orientation), ('SPEED', 9.0, 'BANKING'))
        self.assertEqual(settings.start_frame, 2.0, "belongs to the shot, not to the preset")
        turning = [one for one in car.constraints if getattr(one, "mix_rot", False) or getattr(one, "map_to", "") == 'ROTATION']
        self.assertEqual(len(turning), 1)


class Remove(PathTestCase):
    def test_removing_a_baked_follower_is_refused(self):
        self.line(10.0)
        car = self.follow(duration=4.0)
        bpy.ops.motus.bake(object="Car", frame_start=1, frame_end=10)
        self.assertRefused("baked", bpy.ops.motus.path_follow_remove, object="Car")
        self.assertRefused("baked", bpy.ops.motus.path_follow_add, object="Car", curve="Course", duration=2.0)
        bpy.ops.motus.unbake(object="Car")
        bpy.ops.motus.path_follow_remove(object="Car")
        self.assertFalse(car.motus.path.is_active)

    def test_removing_leaves_nothing(self):
        self.cubic()
        car = self.link("Car")
        car.location, car.rotation_euler, car.scale = (1, 2, 3), (0.1, 0.2, 0.3), (1, 2, 3)
        car.constraints.new('COPY_SCALE').name = "Own"
        bpy.context.view_layer.update()
        before = state(car), len(bpy.data.objects), len(bpy.data.meshes)
        self.follow(orientation='BANKING', timing='SPEED')
        car.motus.path.speed = 4.0
        car.keyframe_insert("motus.path.speed", frame=1)
        car.motus.path.driver_add("offset").driver.expression = "1.0"
        self.at(car, 10)
        self.assertNotEqual(state(car), before[0])
        bpy.ops.motus.path_follow_remove(object="Car")
        self.at(car, 1)
        self.assertEqual((state(car), len(bpy.data.objects), len(bpy.data.meshes)), before)

    def test_own_keys_and_drivers_stay(self):
        self.cubic()
        car = self.link("Car")
        car.keyframe_insert("location", frame=1)
        car.driver_add("scale", 0).driver.expression = "2.0"
        self.at(car)
        before = state(car)
        self.follow(influence=0.5)
        car.keyframe_insert("motus.path.influence", frame=1)
        bpy.ops.motus.path_follow_remove(object="Car")
        self.at(car)
        after = state(car)
        self.assertEqual(after.pop("matrix").translation, before.pop("matrix").translation)
        self.assertEqual(after, before)

    def test_nothing_is_left_in_a_file_of_an_older_blender(self):
        """Of whose settings Blender 5 makes a custom property too, which keeps alive what they point to."""
        if not support.addon("core.blender.capabilities").keeps_settings_apart():
            self.skipTest("settings are one with custom properties")
        self.cubic()
        car = self.follow()
        before = len(bpy.data.objects) - 2  # the hub and the order proxy
        car["motus"] = {"path": {"curve": bpy.data.objects["Course"], "order_proxy": car.motus.path.order_proxy}}
        self.assertGreater(car.motus.path.order_proxy.users, 1)
        bpy.ops.motus.path_follow_remove(object="Car")
        self.assertEqual(len(bpy.data.objects), before)
        self.assertEqual(list(car.keys()), [])

    def test_removed_settings_are_the_defaults_again(self):
        self.cubic()
        car = self.follow(speed=9.0, timing='SPEED')
        bpy.ops.motus.path_follow_remove(object="Car")
        self.assertEqual((car.motus.path.speed, car.motus.path.timing, car.motus.path.curve), (5.0, 'DURATION', None))


class Train(PathTestCase):
    def setUp(self):
        super().setUp()
        self.names = [f"Wagon {index}" for index in range(4)]
        self.wagons = [self.link(name) for name in self.names]

    def couple(self, names=None, **keywords):
        keywords.setdefault("curve", "Course")
        self.assertEqual(bpy.ops.motus.path_train_add(objects=",".join(names or self.names), **keywords), {'FINISHED'})

    def assertGaps(self, distances, points=CLIMB, frame=None):
        """Members stand at these distances along the curve."""
        course = dense(points)
        length = np.linalg.norm(np.diff(course, axis=0), axis=1).sum()
        for wagon, distance in zip(self.wagons, distances):
            self.assertPlace(wagon, positions_at(course, distance / length)[0], frame, tolerance=4e-7)

    def test_gaps_are_exact_along_the_arc(self):
        self.cubic()
        self.couple(gap=1.25, timing='MANUAL', distance_factor=0.75)
        leading = self.output(self.wagons[0], "distance")
        self.assertGaps([leading - 1.25 * index for index in range(4)])
        self.wagons[0].motus.path.wagons[1].gap = 2.0
        self.assertGaps([leading, leading - 1.25, leading - 3.25, leading - 4.5])

    def test_orientation_of_each_wagon_is_its_own(self):
        self.bezier(circle_knots(20.0), cyclic=True)
        self.couple(gap=3.0, timing='SPEED', speed=5.0, extend='LOOP', orientation='WORLD_UP')
        for wagon in self.wagons:
            step = self.place(wagon, 100.05) - self.place(wagon, 99.95)
            along = np.array(self.at(wagon, 100).to_quaternion().to_matrix().col[1])
            self.assertAlmostEqual(along @ step / np.linalg.norm(step), 1.0, places=4)

    def test_train_waits_before_the_start(self):
        self.line(10.0)
        self.couple(gap=2.0, timing='SPEED', speed=1.0, extend='EXTRAPOLATE')
        for index, wagon in enumerate(self.wagons):
            self.assertPlace(wagon, np.array((-2.0 * index, 0.0, 0.0)), 1)

    def test_ends_as_the_curve_asks_for(self):
        self.line(10.0)
        self.couple(timing='SPEED', speed=1.0)
        leader = self.wagons[0].motus.path
        self.assertEqual(leader.extend, 'LINE_UP')
        gaps = [wagon.gap for wagon in leader.wagons]
        self.assertEqual(gaps, [2.0, 2.0, 2.0])  # empties of 1 m to each side
        for frame, front in ((1, 0.0), (1 + 24 * 5, 5.0), (1 + 24 * 30, 10.0)):
            for index, wagon in enumerate(self.wagons):
                self.assertPlace(wagon, np.array((front - 2.0 * index, 0.0, 0.0)), frame, tolerance=1e-6)
        self.couple(extend='PING_PONG')
        self.couple()
        self.assertEqual(leader.extend, 'PING_PONG')  # what is set up keeps its own

    def test_closed_curves_are_gone_round(self):
        self.bezier(circle_knots(20.0), cyclic=True)
        self.couple(gap=3.0)
        self.assertEqual(self.wagons[0].motus.path.extend, 'LOOP')
        car = self.follow("Car")
        self.assertEqual(car.motus.path.extend, 'LOOP')
        self.assertEqual(self.follow("Van", extend='CLAMP').motus.path.extend, 'CLAMP')

    def test_gap_of_all_and_from_sizes(self):
        self.line(100.0)
        self.couple(gap=1.0)
        settings = self.wagons[0].motus.path
        settings.wagons[1].gap = 4.0
        settings.gap_of_all = 2.5
        self.assertEqual([wagon.gap for wagon in settings.wagons], [2.5, 2.5, 2.5])
        self.wagons[2].empty_display_size = 3.0
        bpy.ops.motus.path_wagons_touch(object="Wagon 0")
        self.assertEqual([wagon.gap for wagon in settings.wagons], [2.0, 4.0, 4.0])

    def test_move_wagons(self):
        self.line(100.0)
        self.couple(gap=2.0, timing='MANUAL', distance_factor=0.5)
        settings = self.wagons[0].motus.path
        settings.wagons[0].gap = 5.0
        bpy.ops.motus.path_wagon_move(object="Wagon 0", index=0, direction='DOWN')
        self.assertEqual([wagon.object.name for wagon in settings.wagons], ["Wagon 2", "Wagon 1", "Wagon 3"])
        self.assertEqual(settings.active_wagon, 1)
        for wagon, place in zip(self.wagons, (50.0, 43.0, 45.0, 41.0)):
            self.assertPlace(wagon, np.array((place, 0.0, 0.0)))
        for index, direction in ((0, 'UP'), (2, 'DOWN')):
            self.assertRefused("at the end of the train", bpy.ops.motus.path_wagon_move, object="Wagon 0", index=index, direction=direction)
        self.assertRefused("no such wagon", bpy.ops.motus.path_wagon_move, object="Wagon 0", index=3)

    def test_a_lone_follower_with_its_first_wagon(self):
        self.line(100.0)
        car = self.follow("Car")
        self.assertEqual(car.motus.path.extend, 'CLAMP')
        bpy.ops.motus.path_wagon_add(object="Car", wagon="Wagon 0")
        self.assertEqual(car.motus.path.extend, 'LINE_UP')
        self.assertPlace(self.wagons[0], np.array((-2.0, 0.0, 0.0)), 1)

    def test_what_was_selected_is_active_and_the_curve_knows_it(self):
        course = self.line(100.0)
        layer = bpy.context.view_layer
        for obj in bpy.context.selected_objects:
            obj.select_set(False)
        for obj in (self.wagons[0], self.wagons[1], course):
            obj.select_set(True)
        layer.objects.active = course
        self.assertEqual(bpy.ops.motus.path_train_add(), {'FINISHED'})
        self.assertEqual(layer.objects.active, self.wagons[0])
        layer.objects.active = course
        self.assertEqual(bpy.ops.motus.path_select_follower(), {'FINISHED'})
        self.assertEqual((layer.objects.active, bpy.context.selected_objects), (self.wagons[0], [self.wagons[0]]))
        layer.objects.active = self.wagons[1]
        self.assertRefused("Nothing follows this curve", bpy.ops.motus.path_select_follower)

    def test_gap_from_the_objects_lengths(self):
        self.line(100.0)
        for index in range(len(self.wagons)):
            mesh = bpy.data.meshes.new("Box")
            mesh.from_pydata([(x, y, 0.0) for x in (-1, 1) for y in (-1.0, 2.0)], [], [(0, 1, 3, 2)])
            box = bpy.data.objects.new(f"Box {index}", mesh)
            box.scale = (1.0, index + 1.0, 1.0)
            self.scene.collection.objects.link(box)
        bpy.context.view_layer.update()
        self.couple([f"Box {index}" for index in range(4)], gap=0.0, timing='MANUAL', distance_factor=0.5)
        # From -1 to 2 along Y, scaled by 1, 2, 3, 4: each front touches the rear before it.
        gaps = [entry.gap for entry in bpy.data.objects["Box 0"].motus.path.wagons]
        self.assertTrue(np.allclose(gaps, [1.0 + 4.0, 2.0 + 6.0, 3.0 + 8.0]))

    def test_train_with_influence_on_every_frame(self):
        self.line(10.0)
        self.couple(gap=1.0, duration=4.0, influence=0.5)
        for wagon in self.wagons:
            wagon.location.y = 4.0
        for frame in (73, 49, 60.5):
            for index, wagon in enumerate(self.wagons):
                wanted = (0.5 * ((frame - 1.0) / 9.6 - index), 2.0, 0.0)
                self.assertPlace(wagon, np.array(wanted), frame, tolerance=1e-6)

    def test_taking_out_a_wagon_leaves_the_others_in_place(self):
        self.line(100.0)
        self.couple(gap=2.0, timing='MANUAL', distance_factor=0.5)
        bpy.ops.motus.path_follow_remove(object="Wagon 1")
        self.assertPlace(self.wagons[1], np.zeros(3))
        self.assertEqual(len(self.wagons[1].constraints), 0)
        for index in (0, 2, 3):
            self.assertPlace(self.wagons[index], np.array((50.0 - 2.0 * index, 0.0, 0.0)))
        bpy.ops.motus.path_wagon_remove(object="Wagon 0", index=1)
        bpy.ops.motus.path_follow_remove(object="Wagon 2")
        self.assertPlace(self.wagons[0], np.array((50.0, 0.0, 0.0)))
        self.assertEqual(len(self.wagons[0].motus.path.wagons), 0)

    def test_add_a_wagon(self):
        self.line(100.0)
        self.couple(self.names[:2], gap=2.0, timing='MANUAL', distance_factor=0.5)
        bpy.ops.motus.path_wagon_add(object="Wagon 0", wagon="Wagon 3", gap=5.0)
        self.assertPlace(self.wagons[3], np.array((43.0, 0.0, 0.0)))
        self.assertEqual(self.wagons[3].motus.path.leader, self.wagons[0])

    def test_select_the_leader(self):
        self.line(100.0)
        self.couple(self.names[:2], gap=2.0)
        layer = bpy.context.view_layer
        layer.objects.active = self.wagons[1]
        self.assertEqual(bpy.ops.motus.path_select_leader(), {'FINISHED'})
        self.assertEqual((layer.objects.active, bpy.context.selected_objects), (self.wagons[0], [self.wagons[0]]))
        for lone in (self.wagons[0], self.wagons[3], None):
            layer.objects.active = lone
            with self.assertRaisesRegex(RuntimeError, "^Error: Nothing here is a wagon of a train"):
                bpy.ops.motus.path_select_leader()
            self.assertEqual(layer.objects.active, lone)
        layer.objects.active = self.wagons[1]
        for collection in self.wagons[0].users_collection:
            collection.objects.unlink(self.wagons[0])
        with self.assertRaisesRegex(RuntimeError, "Wagon 0 is not in this view layer"):
            bpy.ops.motus.path_select_leader()

    def test_remove_the_train(self):
        self.cubic()
        before = [state(wagon) for wagon in self.wagons]
        objects = len(bpy.data.objects), len(bpy.data.meshes)
        self.couple(gap=1.0)
        self.at(self.wagons[0], 30)
        bpy.ops.motus.path_follow_remove(object="Wagon 0")
        self.at(self.wagons[0], 1)
        self.assertEqual([state(wagon) for wagon in self.wagons], before)
        self.assertEqual((len(bpy.data.objects), len(bpy.data.meshes)), objects)

    def test_deleting_a_wagon_leaves_the_others(self):
        self.line(100.0)
        self.couple(gap=2.0, timing='MANUAL', distance_factor=0.5)
        bpy.data.objects.remove(self.wagons[1])
        for index in (0, 2, 3):
            self.assertPlace(self.wagons[index], np.array((50.0 - 2.0 * index, 0.0, 0.0)))

    def test_adding_a_train_again_replaces_its_wagons(self):
        self.line(100.0)
        self.couple(gap=2.0, timing='MANUAL', distance_factor=0.5)
        self.couple(self.names[::3], gap=1.0)
        self.assertPlace(self.wagons[3], np.array((49.0, 0.0, 0.0)))
        self.assertPlace(self.wagons[1], np.zeros(3))
        self.assertIsNone(self.wagons[1].motus.path.leader)

    def test_refusals(self):
        self.cubic()
        add = bpy.ops.motus.path_train_add
        self.assertRefused("two objects", add, objects="Wagon 0", curve="Course")
        self.assertRefused("only once", add, objects="Wagon 0,Wagon 1,Wagon 0", curve="Course")
        self.follow("Wagon 1")
        self.assertRefused("path of its own", add, objects="Wagon 0,Wagon 1", curve="Course")
        self.couple(["Wagon 2", "Wagon 3"])
        self.assertRefused("a wagon of Wagon 2", add, objects="Wagon 0,Wagon 3", curve="Course")
        self.assertRefused("a wagon of Wagon 2", bpy.ops.motus.path_follow_add, object="Wagon 3", curve="Course")
