"""Followers of one curve that share a solver: who does, what they leave it for, and that nobody sees any of it."""

from unittest import mock

import bpy
import mathutils
import numpy as np

import support
from path.path_cases import CLIMB, PathTestCase, dense, length_of, positions_at

FRAMES = (1, 60, 12.5, 97, 30)
WRITES = "matrices" if bpy.app.version >= (5, 0) else "write_slots"
"""Method of the native PoseBuffer by which poses become what the members' constraints read."""


class SharedTestCase(PathTestCase):
    def setUp(self):
        super().setUp()
        self.sharing = support.addon("core.wiring.hubs.sharing")
        self.line(20.0)

    def cars(self, count=4, **keywords):
        return [
            self.follow(f"Car {index}", timing='SPEED', speed=1.0 + 0.1 * index, offset=0.5 * index, **keywords) for index in range(count)
        ]

    def hub(self, car):
        return car.motus.path.hub

    def is_shared(self, car):
        return self.sharing.has_rows(self.hub(car).data)

    def assertRuns(self, car, speed, offset, frames=FRAMES):
        for frame in frames:
            wanted = min(offset + speed * max(0.0, frame - 1.0) / 24.0, 20.0)
            self.assertAlmostEqual(self.at(car, frame).translation.x, wanted, places=4, msg=f"{car.name} at {frame}")

    def assertAllRun(self, cars):
        for index, car in enumerate(cars):
            self.assertRuns(car, 1.0 + 0.1 * index, 0.5 * index)
            self.assertIsNone(self.wiring.problem(self.system, car, bpy.context.evaluated_depsgraph_get()))


class Sharing(SharedTestCase):
    def test_followers_of_a_curve_share_a_hub(self):
        cars = self.cars()
        self.line(20.0, "Other")
        other = self.follow("Other Car", curve="Other")
        self.assertEqual(len({self.hub(car) for car in cars}), 1)
        self.assertNotEqual(self.hub(other), self.hub(cars[0]))
        self.assertFalse(self.is_shared(other))
        self.assertEqual(sorted(car.motus.path.row for car in cars), [0, 1, 2, 3])
        self.assertAllRun(cars)

    def test_followers_of_a_curve_are_solved_in_one_call_a_frame(self):
        self.cars()
        self.at(bpy.data.objects["Car 0"], 3)
        kind = support.addon("core.wiring.solving.solving").RowsSolver
        with mock.patch.object(kind, "solve", autospec=True, side_effect=kind.solve) as solve:
            bpy.context.scene.frame_set(5)
        self.assertEqual(solve.call_count, 1)

    def plans_made(self, frames):
        """How many native plans of followers are made while frames are evaluated."""
        native = support.addon("core.native").module
        with mock.patch.object(native, "FollowPlan", wraps=native.FollowPlan) as made:
            for frame in frames:
                self.go_to(frame)
        return made.call_count

    def test_a_curve_that_moves_needs_no_new_plan(self):
        curve, points = self.cubic(name="Bend"), dense(np.array(CLIMB))
        for frame, scale, place in ((1, 1.0, (0.0, 0.0, 0.0)), (60, 2.0, (10.0, 7.0, -3.0))):
            curve.scale, curve.location, curve.rotation_euler = (scale, scale, scale), place, place
            for path in ("scale", "location", "rotation_euler"):
                curve.keyframe_insert(path, frame=frame)
        alone = self.follow("Alone", curve="Bend", timing='SPEED', speed=2.0)
        along = 2.0 * 11.0 / 24.0 / length_of(points)
        for count in (1, 3):  # alone, and with two more that share its hub
            with self.subTest(followers=count):
                for index in range(1, count):
                    self.follow(f"Car {index}", curve="Bend", timing='SPEED', speed=2.0)
                self.assertEqual(self.is_shared(alone), count > 1)
                self.at(alone, 2)
                self.assertEqual(self.plans_made(range(3, 13)), 0)
                (wanted,) = positions_at(points, along / self.at(curve).to_scale().x)
                self.assertPlace(alone, np.array(self.at(curve) @ mathutils.Vector(wanted)), tolerance=1e-6)

    def test_a_curve_that_grows_moves_what_reads_its_length(self):
        curve = self.line(20.0, "Bend")
        for frame, scale in ((1, 1.0), (49, 2.0)):
            curve.scale = scale, scale, scale
            curve.keyframe_insert("scale", frame=frame)
        keywords = {"by hand": {"timing": 'MANUAL', "distance_factor": 0.5}, "by duration": {"timing": 'DURATION', "duration": 4.0}}
        cars = {name: self.follow(name, curve="Bend", **one) for name, one in keywords.items()}
        self.follow("By Speed", curve="Bend", timing='SPEED', speed=1.0)
        for frame in (1, 25, 49, 13):
            length = 20.0 * self.at(curve, frame).to_scale().x
            self.assertPlace(cars["by hand"], np.array((0.5 * length, 0.0, 0.0)), frame, 1e-6)
            self.assertPlace(cars["by duration"], np.array((length * (frame - 1.0) / 96.0, 0.0, 0.0)), frame, 1e-6)

    def test_what_stands_still_is_written_once(self):
        for count in (1, 3):  # alone, and with two more that share its hub
            with self.subTest(followers=count):
                cars = [self.follow(f"Car {index}", timing='MANUAL', distance_factor=0.1 + 0.2 * index) for index in range(count)]
                self.at(cars[0], 2)
                self.assertEqual(self.poses_written(range(3, 9)), 0)
                cars[0].motus.path.distance_factor = 0.6
                self.assertEqual(self.poses_written((9, 10, 11)), 1)
                self.assertAlmostEqual(self.place(cars[0])[0], 12.0, places=5)
                cars[0].motus.path.distance_factor = 0.1

    def test_what_stands_still_comes_back_after_a_fault(self):
        car = self.follow(timing='MANUAL', distance_factor=0.5)
        self.at(car, 2)
        solving = support.addon("core.wiring.solving.solving")
        with mock.patch.object(solving, "solver_of", side_effect=KeyError("a fault")), self.assertLogs(level='ERROR'):
            self.at(car, 3)
        self.assertAlmostEqual(self.place(car, 4)[0], 10.0, places=5)

    def poses_written(self, frames):
        """How many times new poses are written to the hubs' meshes or outboxes while frames are evaluated."""
        buffer = support.addon("core.native").module.PoseBuffer
        write, written = getattr(buffer, WRITES), []

        def noted(poses, *arguments, **keywords):
            found = write(poses, *arguments, **keywords)
            if found is not None and found is not False:
                written.append(poses)
            return found

        with mock.patch.object(buffer, WRITES, noted):
            for frame in frames:
                self.go_to(frame)
        return len(written)

    def test_shared_followers_get_the_same_bits_as_alone(self):
        keywords = {"orientation": 'BANKING', "extend": 'LOOP', "lag_rate": 0.3}
        rows = support.addon("core.wiring.hubs.sharing")
        self.cubic(name="Bend")
        found = []
        for is_shared in (True, False):
            with (
                mock.patch.object(rows, "can_share", wraps=rows.can_share)
                if is_shared
                else mock.patch.object(rows, "can_share", return_value=False)
            ):
                cars = [
                    self.follow(f"Car {index} {is_shared}", curve="Bend", timing=timing, offset=0.3 * index, **keywords)
                    for index, timing in enumerate(('SPEED', 'DURATION', 'MANUAL', 'SPEED'))
                ]
                self.assertEqual([self.is_shared(car) for car in cars], [is_shared] * 4)
                found.append([[self.at(car, frame) for car in cars] for frame in FRAMES])
        self.assertEqual(*found)

    def test_shared_follower_with_edited_settings(self):
        cars = self.cars()
        cars[2].motus.path.speed = 3.0
        self.assertRuns(cars[2], 3.0, 1.0)
        self.assertRuns(cars[1], 1.1, 0.5)
        cars[1].motus.path.influence = 0.5
        self.assertAlmostEqual(self.at(cars[1], 25).translation.x, 0.8, places=4)

    def test_a_problem_is_one_followers_own(self):
        cars = self.cars()
        cars[1].location = (0.0, 3.0, 0.0)
        cars[1].motus.path.up_axis = 'POS_Y'
        self.assertEqual(self.at(cars[1], 30).translation[:], (0.0, 3.0, 0.0))
        graph = bpy.context.evaluated_depsgraph_get()
        self.assertTrue(self.wiring.problem(self.system, cars[1], graph).blocking)
        for index in (0, 2, 3):
            self.assertRuns(cars[index], 1.0 + 0.1 * index, 0.5 * index)

    def test_what_a_file_holds_of_one_is_damaged(self):
        cars = self.cars()
        self.hub(cars[0]).data[f"motus_path_row_{cars[1].motus.path.row}"] = '{"name": "Car 1"}'
        self.hub(cars[0]).data.update_tag()
        self.at(cars[0], 30)
        told = self.wiring.problem(self.system, cars[1], bpy.context.evaluated_depsgraph_get())
        self.assertIn("damaged", told.sentence)
        self.assertEqual(self.at(cars[1], 30).translation.x, 0.0)
        self.assertRuns(cars[2], 1.2, 1.0)
        bpy.ops.motus.refresh(object="Car 1", system="path")
        self.assertAllRun(cars)

    def test_curve_is_edited(self):
        cars = self.cars(2)
        curve = bpy.data.objects["Course"]
        self.assertAllRun(cars)
        curve.scale.x = 0.1
        self.assertAlmostEqual(self.at(cars[1], 97).translation.x, 2.0, places=4)
        curve.scale.x = 1.0
        point = curve.data.splines[0].bezier_points[1]
        for name in ("co", "handle_left", "handle_right"):
            setattr(point, name, [0.5 * value for value in getattr(point, name)])
        self.assertAlmostEqual(self.at(cars[1], 250).translation.x, 10.0, places=4)
        bpy.context.view_layer.objects.active = curve
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.curve.select_all(action='SELECT')
        bpy.ops.transform.translate(value=(0.0, 0.0, 2.0))
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertAlmostEqual(self.at(cars[1], 30).translation.z, 2.0, places=4)

    def test_outputs(self):
        cars = self.cars()
        self.at(cars[3], 25)
        graph = bpy.context.evaluated_depsgraph_get()
        self.assertAlmostEqual(self.wiring.output(self.system, cars[3], "distance", graph), 2.8, places=5)
        self.assertAlmostEqual(cars[3].evaluated_get(graph)["motus_path_out"][4], 2.8, places=5)
        path = self.wiring.output_path(self.system, "distance", cars[3])
        self.assertAlmostEqual(self.hub(cars[3]).data.evaluated_get(graph).path_resolve(path), 2.8, places=5)

    def test_reader_of_a_hubs_slot(self):
        """A driver that reads an output from the hub, as tools make it, reads it when the follower has left, too."""
        cars = self.cars()
        reader = self.link("Reader")
        driver = reader.driver_add("location", 2).driver
        driver.type = 'SUM'
        target = driver.variables.new().targets[0]
        target.id_type, target.id = 'MESH', self.hub(cars[2]).data
        target.data_path = self.wiring.output_path(self.system, "distance", cars[2])
        self.assertAlmostEqual(self.at(reader, 25).translation.z, 2.2, places=4)
        cars[2].keyframe_insert("motus.path.offset", frame=1)
        self.at(reader, 48)  # here it is noticed
        self.assertAlmostEqual(self.at(reader, 49).translation.z, 3.4, places=4)
        self.assertFalse(self.is_shared(cars[2]))
        self.assertAlmostEqual(self.at(reader, 25).translation.z, 2.2, places=4)


class Leaving(SharedTestCase):
    def test_keyed_and_back(self):
        cars = self.cars()
        self.assertAllRun(cars)
        for frame, offset in ((1, 0.0), (97, 8.0)):
            cars[1].motus.path.offset = offset
            cars[1].keyframe_insert("motus.path.offset", frame=frame)
        curve = support.addon("core.blender.actions").find(cars[1], "motus.path.offset")
        for frame in (60, 25):
            wanted = curve.evaluate(frame) + 1.1 * (frame - 1) / 24
            self.assertAlmostEqual(self.at(cars[1], frame).translation.x, wanted, places=4)
        self.assertFalse(self.is_shared(cars[1]))
        self.assertRuns(cars[2], 1.2, 1.0)
        support.addon("core.blender.actions").remove(cars[1], ("motus.path.",))
        cars[1].motus.path.offset = 0.5
        self.at(cars[1], 3)
        bpy.context.view_layer.update()
        self.assertTrue(self.is_shared(cars[1]))
        self.assertAllRun(cars)

    def test_driven_by_a_script(self):
        cars = self.cars()
        self.assertAllRun(cars)
        cars[1].driver_add("motus.path.offset").driver.expression = "0.05*frame"
        for frame in (60, 25):
            self.assertAlmostEqual(self.at(cars[1], frame).translation.x, 0.05 * frame + 1.1 * (frame - 1) / 24, places=4)
        self.assertFalse(self.is_shared(cars[1]))

    def test_shared_follower_with_settings_that_are_not_finite(self):
        cars = self.cars()
        cars[1].motus.path.speed = float("inf")
        self.assertIn("finite", self.sentence(cars[1], 30))
        self.assertRuns(cars[2], 1.2, 1.0)
        cars[1].motus.path.speed = 1.1
        self.assertAllRun(cars)

    def test_shared_follower_is_removed(self):
        cars = self.cars()
        row = cars[1].motus.path.row
        bpy.ops.motus.path_follow_remove(object="Car 1")
        self.assertEqual(self.at(cars[1], 30).translation.x, 0.0)
        self.assertRuns(cars[3], 1.3, 1.5)
        new = self.follow("New", timing='SPEED', speed=1.0)
        self.assertEqual(new.motus.path.row, row)
        for car in (cars[0], cars[2], cars[3], new):
            bpy.ops.motus.path_follow_remove(object=car.name)
        self.assertEqual(len(bpy.data.meshes), 0)
        self.assertEqual([key for key in bpy.data.objects["Course"].data.keys() if key.startswith("motus")], [])

    def test_deleted(self):
        cars = self.cars()
        self.assertAllRun(cars)
        hub, row = self.hub(cars[0]), cars[1].motus.path.row
        with bpy.context.temp_override(selected_objects=[cars[1]]):
            bpy.ops.object.delete()
        bpy.context.view_layer.update()
        self.assertNotIn("Car 1", bpy.data.objects)
        self.assertNotIn(f"motus_path_row_{row}", hub.data)
        self.assertRuns(cars[2], 1.2, 1.0)


class Copies(SharedTestCase):
    def test_shared_follower_is_copied(self):
        cars = self.cars(2)
        self.assertAllRun(cars)
        copy = cars[1].copy()
        self.scene.collection.objects.link(copy)
        self.at(copy, 3)
        bpy.context.view_layer.update()
        self.assertEqual(len({car.motus.path.row for car in (*cars, copy)}), 3)
        copy.motus.path.offset = 4.0
        self.assertRuns(copy, 1.1, 4.0)
        self.assertAllRun(cars)

    def test_copied_and_changed_before_anything_is_evaluated(self):
        cars = self.cars(2)
        copy = cars[1].copy()
        self.scene.collection.objects.link(copy)
        copy.motus.path.offset = 4.0
        self.assertRuns(copy, 1.1, 4.0)
        self.assertAllRun(cars)

    def test_shared_follower_is_renamed(self):
        cars = self.cars(2)
        cars[0].name = "Renamed"
        self.follow("Car 0", timing='SPEED', speed=3.0)
        cars[0].motus.path.offset = 0.25
        self.assertRuns(cars[0], 1.0, 0.25)
        self.assertRuns(bpy.data.objects["Car 0"], 3.0, 0.0)
        self.assertRuns(cars[1], 1.1, 0.5)

    def test_exchanged_names(self):
        cars = self.cars(2)
        cars[0].name, cars[1].name = "Other", "Car 0"
        cars[0].name = "Car 1"
        self.assertAllRun(cars)
        cars[0].motus.path.offset, cars[1].motus.path.offset = 1.0, 2.0
        self.assertRuns(cars[0], 1.0, 1.0)
        self.assertRuns(cars[1], 1.1, 2.0)

    def test_shared_follower_after_undo(self):
        bpy.context.preferences.edit.use_global_undo = True
        self.cars(2)
        bpy.ops.ed.undo_push(message="two")
        bpy.data.objects["Car 1"].motus.path.offset = 5.0
        self.follow("Third", timing='SPEED', speed=2.0)
        bpy.ops.ed.undo_push(message="three")
        bpy.ops.ed.undo()
        self.scene = bpy.context.scene
        self.assertAllRun([bpy.data.objects[f"Car {index}"] for index in range(2)])
        bpy.ops.ed.redo()
        self.scene = bpy.context.scene
        self.assertRuns(bpy.data.objects["Car 1"], 1.1, 5.0)
        self.assertRuns(bpy.data.objects["Third"], 2.0, 0.0)


class Files(SharedTestCase):
    def save(self):
        path = str(self.folder / "shared.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        return path

    def test_shared_followers_in_a_reopened_file(self):
        self.cars()
        bpy.ops.wm.open_mainfile(filepath=self.save())
        self.scene = bpy.context.scene
        self.assertAllRun([bpy.data.objects[f"Car {index}"] for index in range(4)])

    def test_one_of_shared_followers_is_appended(self):
        self.cars()
        folder = f"{self.save()}/Object/"
        for is_new in (True, False):
            with self.subTest(is_new=is_new):
                support.empty_scene()
                self.scene = bpy.context.scene
                if not is_new:
                    self.line(20.0)
                    self.cars(3)
                bpy.ops.wm.append(filepath=folder + "Car 2", directory=folder, filename="Car 2")
                car = bpy.data.objects["Car 2" if is_new else "Car 2.001"]
                self.assertRuns(car, 1.2, 1.0)
                bpy.context.view_layer.update()
                self.assertEqual(len([obj for obj in bpy.data.objects if obj.name.startswith("Car")]), 1 if is_new else 4)
                rows = [key for key in self.hub(car).data.keys() if key.startswith("motus_path_row_")]
                self.assertEqual(len(rows), 1)
                car.motus.path.offset = 3.0
                self.assertRuns(car, 1.2, 3.0)
                if not is_new:
                    self.assertAllRun([bpy.data.objects[f"Car {index}"] for index in range(3)])

    def test_one_of_shared_followers_is_linked_and_overridden(self):
        self.cars()
        path = self.save()
        support.empty_scene()
        self.scene = bpy.context.scene
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.objects = ["Car 2"]
        (car,) = wanted.objects
        self.scene.collection.objects.link(car)
        self.assertRuns(car, 1.2, 1.0)
        self.assertEqual([obj.name for obj in bpy.data.objects if obj.name.startswith("Car")], ["Car 2"])
        car = car.override_create(remap_local_usages=True)
        self.assertRuns(car, 1.2, 1.0)
        car.motus.path.offset = 3.0
        self.assertRuns(car, 1.2, 3.0)
        bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "override.blend"))
        bpy.ops.wm.open_mainfile(filepath=str(self.folder / "override.blend"))
        self.scene = bpy.context.scene
        car = next(obj for obj in bpy.data.objects if obj.name == "Car 2" and obj.override_library)
        self.assertRuns(car, 1.2, 3.0)
