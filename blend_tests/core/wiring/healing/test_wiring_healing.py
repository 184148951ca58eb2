"""What the wiring mends by itself: settings driven later, copies of leaders, leaders that are gone; and what it keeps."""

import random

import bpy
import numpy as np

import support
from path.path_cases import PathTestCase

FRAMES = [1, 97, 33, 64.5, 12, 50.25, 88, 3]


REMOVED = """
import bpy
import support

def owner():
    thing = bpy.data.objects.new("Thing", None)
    bpy.context.scene.collection.objects.link(thing)
    for frame in (1, 10):
        thing.location.x = frame
        thing.keyframe_insert("location", frame=frame)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.motus.dynamics_add()

def rig():
    armature = bpy.data.armatures.new("Armature")
    found = bpy.data.objects.new("Rig", armature)
    bpy.context.scene.collection.objects.link(found)
    bpy.context.view_layer.objects.active = found
    bpy.ops.object.mode_set(mode='EDIT')
    armature.edit_bones.new("Bone").tail = (0.0, 0.0, 1.0)
    bpy.ops.object.mode_set(mode='OBJECT')
    return found

def linked():
    path = bpy.app.tempdir + "library.blend"
    found = bpy.data.objects.new("Linked", None)
    bpy.data.libraries.write(path, {found})
    bpy.data.objects.remove(found)
    with bpy.data.libraries.load(path, link=True) as (_, into):
        into.objects = ["Linked"]
    found = bpy.data.objects["Linked"]
    bpy.context.scene.collection.objects.link(found)
    return found

def remove_once(*collections):
    def removing(*_):
        bpy.app.handlers.depsgraph_update_post.remove(removing)
        for collection in collections:
            collection.remove(collection[-1])
        for _ in range(200):  # some of them come to lie where those were
            bpy.data.meshes.new("Other")
    bpy.app.handlers.depsgraph_update_post.insert(0, removing)

support.empty_scene()
owner()
bones, other = rig(), linked()
bpy.context.view_layer.update()
remove_once(bpy.data.armatures)
bones.data.bones[0].use_deform = False
bones.data.update_tag()
bpy.context.view_layer.update()
print("ALIVE", flush=True)
remove_once(bpy.data.libraries)
other.location.x = 1.0
bpy.context.view_layer.update()
print("ALIVE", flush=True)
"""


def drive(owner, path, source, source_path, expression="v", index=None):
    """A scripted driver of one variable."""
    curve = owner.driver_add(path) if index is None else owner.driver_add(path, index)
    variable = curve.driver.variables.new()
    variable.name = "v"
    variable.targets[0].id = source
    variable.targets[0].data_path = source_path
    curve.driver.expression = expression


class DrivenLaterTest(PathTestCase):
    """Settings that the user drives after the system was added."""

    def setUp(self):
        super().setUp()
        self.line(10.0)
        self.source = self.link("Source")
        for frame, x in ((1, 0.0), (97, 10.0)):
            self.source.location.x = x
            self.source.keyframe_insert("location", index=0, frame=frame)

    def place_of_source(self, frame):
        return self.at(self.source, frame).translation.x

    def test_setting(self):
        cars = [self.follow(f"Car {index}", timing='MANUAL') for index in range(8)]
        for car in cars:
            drive(car, "motus.path.distance_factor", self.source, "location.x", "v/10")
        for frame in FRAMES + random.Random(1).sample(range(1, 98), 30):
            wanted = self.place_of_source(frame)
            for car in cars:
                self.assertAlmostEqual(self.at(car).translation.x, wanted, places=4, msg=f"frame {frame}")

    def test_influence(self):
        car = self.follow(timing='MANUAL', distance_factor=1.0)
        self.source["share"] = 0.5
        self.source.update_tag()
        drive(car, "motus.path.influence", self.source, '["share"]')
        self.assertAlmostEqual(self.at(car, 5).translation.x, 5.0, places=5)
        self.source["share"] = 0.25
        self.source.update_tag()
        bpy.context.view_layer.update()
        self.assertAlmostEqual(self.at(car).translation.x, 2.5, places=5)

    def test_by_the_output_of_another_follower(self):
        first = [self.follow(f"First {index}", duration=4.0) for index in range(6)]
        second = [self.follow(f"Second {index}", timing='MANUAL') for index in range(6)]
        fraction = self.wiring.output_path(self.system, "fraction")
        for leader, car in zip(first, second):
            drive(car, "motus.path.distance_factor", leader, fraction)
        for frame in FRAMES:
            for car in second:
                self.assertAlmostEqual(self.at(car, frame).translation.x, (frame - 1) / 9.6, places=4)

    def test_driver_taken_away_again(self):
        car = self.follow(timing='MANUAL')
        drive(car, "motus.path.distance_factor", self.source, "location.x", "v/10")
        self.at(car, 49)
        car.driver_remove("motus.path.distance_factor")
        car.motus.path.distance_factor = 0.2
        self.assertAlmostEqual(self.at(car, 60).translation.x, 2.0, places=5)


class CopiedLeaderTest(PathTestCase):
    def setUp(self):
        super().setUp()
        self.line(10.0)
        for name in "ABC":
            self.link(name)
        bpy.ops.motus.path_train_add(objects="A,B,C", curve="Course", gap=1.0, timing='MANUAL', offset=5.0)

    def places(self, names):
        return [round(self.at(bpy.data.objects[name], 10).translation.x, 4) for name in names]

    def test_duplicated_train_is_independent_from_its_first_change_on(self):
        for name in "ABC":
            bpy.data.objects[name].select_set(True)
        bpy.context.view_layer.objects.active = bpy.data.objects["A"]
        bpy.ops.object.duplicate()
        bpy.context.view_layer.objects.active.motus.path.offset = 9.0
        self.assertEqual(self.places(["A.001", "B.001", "C.001"]), [9.0, 8.0, 7.0])
        self.assertEqual(self.places("ABC"), [5.0, 4.0, 3.0])

    def test_copy_of_the_leader_alone(self):
        copy = bpy.data.objects["A"].copy()
        self.scene.collection.objects.link(copy)
        copy.motus.path.offset = 8.0
        self.assertEqual(self.places(["A.001", "A", "B", "C"]), [8.0, 5.0, 4.0, 3.0])

    def test_copied_wagon_is_released_alone(self):
        copy = bpy.data.objects["B"].copy()
        self.scene.collection.objects.link(copy)
        self.assertTrue(self.wiring.has_sinks(self.system, copy))
        self.wiring.release(self.system, copy)
        self.assertFalse(self.wiring.has_sinks(self.system, copy))
        self.assertEqual(len(copy.constraints), 0)
        self.assertEqual(self.places(["B.001", "A", "B", "C"]), [0.0, 5.0, 4.0, 3.0])

    def test_leader_removed_from_the_file(self):
        bpy.data.objects["B"].location.x = -3.0
        self.places("ABC")
        bpy.data.objects.remove(bpy.data.objects["A"])
        if "motus_still" not in bpy.data.meshes[0]:
            self.assertEqual(self.places("BC"), [-3.0, 0.0])
        for name in "BC":
            self.wiring.release(self.system, bpy.data.objects[name])
        self.assertEqual(self.places("BC"), [-3.0, 0.0])
        self.assertEqual(len(bpy.data.meshes), 0)


class RemovedTest(PathTestCase):
    def test_by_a_handler_that_is_called_before(self):
        """Rigs and libraries: Blender's copies of what was edited are still there, and point to freed memory."""
        status, said = support.run_beside(REMOVED, arguments=("--factory-startup", "--debug-memory"))
        self.assertEqual((status, said.count("ALIVE")), (0, 2), said)
        self.assertNotIn("could not be wired again", said)


class StillMembersTest(PathTestCase):
    """Members that have nothing of their own that moves them; in Blender 5 the solver blends them itself."""

    def setUp(self):
        super().setUp()
        self.line(10.0)
        for name in "ABC":
            self.link(name).rotation_euler.z = 0.5
        self.wagon = bpy.data.objects["B"]
        self.wagon.location = (1.0, 2.0, 3.0)
        self.wagon.scale = (1.0, 2.0, 3.0)
        bpy.ops.motus.path_train_add(objects="A,B,C", curve="Course", gap=1.0, timing='MANUAL', offset=5.0, forward_axis='POS_X')
        self.leader = bpy.data.objects["A"]

    def test_influence_between(self):
        self.leader.motus.path.influence = 0.25
        matrix = self.at(self.wagon, 2)
        for value, expected in zip(matrix.translation, (1.75, 1.5, 2.25)):
            self.assertAlmostEqual(value, expected, places=5)
        self.assertAlmostEqual(matrix.to_euler().z, 0.375, places=5)
        for value, expected in zip(matrix.to_scale(), (1.0, 2.0, 3.0)):
            self.assertAlmostEqual(value, expected, places=5)

    def test_problem_leaves_them_where_they_stand(self):
        self.leader.motus.path.up_axis = 'POS_X'
        matrix = self.at(self.wagon, 2)
        for value, expected in zip(matrix.translation, (1.0, 2.0, 3.0)):
            self.assertAlmostEqual(value, expected, places=5)
        self.assertAlmostEqual(matrix.to_euler().z, 0.5, places=5)
        self.wagon.location.x = 4.0
        self.assertAlmostEqual(self.at(self.wagon, 3).translation.x, 4.0, places=5)

    def test_keyed_influence(self):
        for frame, value in ((1, 1.0), (11, 0.0)):
            self.leader.motus.path.influence = value
            self.leader.keyframe_insert("motus.path.influence", frame=frame)
        self.assertAlmostEqual(self.at(self.wagon, 6).translation.y, 1.0, places=4)
        self.assertAlmostEqual(self.at(self.wagon, 11).translation.y, 2.0, places=5)
        self.assertAlmostEqual(self.at(self.wagon, 1).translation.y, 0.0, places=5)


class RefreshTest(PathTestCase):
    def test_sinks_keep_their_place_in_the_stack(self):
        self.line(10.0)
        self.line(20.0, "Other")
        car = self.follow(timing='MANUAL', distance_factor=0.5)
        sinks = len(car.constraints)
        car.constraints.new('LIMIT_SCALE').name = "Mine"
        car.constraints[0].mute = True
        car.motus.path.curve = bpy.data.objects["Other"]
        self.assertEqual(car.constraints[sinks].name, "Mine")
        self.assertEqual([constraint.mute for constraint in car.constraints], [True] + [False] * sinks)

    def test_scale_that_comes_to_mirror(self):
        """Of the follower, and of its parent: forward stays along the path, alone and with another follower on the same curve."""
        self.line(10.0)
        for count in (1, 2):
            car, parent = self.follow(f"Car {count}"), self.link(f"Parent {count}")
            car.parent = parent
            self.at(car)
            for thing, scale in ((car, -1.0), (parent, -2.0), (car, 1.0), (parent, 1.0)):
                thing.scale.x = scale
                bpy.context.view_layer.update()
                self.at(car, 5)
                world = self.at(car, 6)
                with self.subTest(count=count, thing=thing.name, scale=scale):
                    self.assertIsNone(self.wiring.problem(self.system, car, bpy.context.evaluated_depsgraph_get()))
                    np.testing.assert_allclose(world.to_3x3().col[1].normalized(), (1.0, 0.0, 0.0), atol=1e-5)
                    np.testing.assert_allclose(world.to_3x3().col[2].normalized(), (0.0, 0.0, 1.0), atol=1e-5)
                    self.assertEqual(world.is_negative, (car.scale.x < 0.0) != (parent.scale.x < 0.0))
