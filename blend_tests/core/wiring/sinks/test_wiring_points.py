"""Systems that make points: at any frame, in files, in copies, taken away, and damaged."""

import bpy
import numpy as np

import support
import toy_points_system as toy
import toy_system
from core.wiring.hubs import damaged_cases
from core.wiring.wiring_cases import frame_set

nodes = support.addon("core.blender.node_groups")
wiring = support.addon("core.wiring")
FRAMES = (30, 3, 12.5, 30.25, 90, 12.5)
FIELDS = {
    'FLOAT': ("value", 1),
    'INT': ("value", 1),
    'FLOAT_VECTOR': ("vector", 3),
    'FLOAT_COLOR': ("color", 4),
    'QUATERNION': ("value", 4),
}
LARGEST_FILE = 60_000  # bytes

BARE = """
import bpy
bpy.ops.wm.open_mainfile(filepath={path!r})
bpy.context.scene.frame_set(12)
print("KINDS", sorted({{one.object.type for one in bpy.context.evaluated_depsgraph_get().object_instances}}))
"""
FRESH = """
import support, toy_points_system as toy
support.register_systems(toy.SPARKS, toy.TRAILS)
import bpy
bpy.ops.wm.open_mainfile(filepath={path!r}, use_scripts=False)
from core.wiring.sinks.test_wiring_points import assert_sparks
for frame in (90, 30.25):
    assert_sparks(bpy.data.objects["Owner"], frame)
"""


def points_of(owner):
    """Attributes of the points that an owner has evaluated, arrays by their names; empty where there are none."""
    for one in bpy.context.evaluated_depsgraph_get().object_instances:
        if one.object.type == 'POINTCLOUD' and one.parent.original == owner:
            assert np.allclose(one.matrix_world, np.eye(4), atol=1e-5)
            return {attribute.name: _read(attribute) for attribute in one.object.data.attributes if attribute.data_type in FIELDS}
    return {}


def _read(attribute):
    field, width = FIELDS[attribute.data_type]
    found = np.empty(width * len(attribute.data), np.int32 if attribute.data_type == 'INT' else np.float32)
    attribute.data.foreach_get(field, found)
    return found if width == 1 else found.reshape(-1, width)


def show_curves_as_points(owner):
    """Put a modifier behind that turns curves into the points of which they are made; what is no mesh cannot be read otherwise."""
    group = bpy.data.node_groups.new("Points", 'GeometryNodeTree')
    nodes.add_sockets(group, [("Geometry", way, "NodeSocketGeometry") for way in ('INPUT', 'OUTPUT')])
    start = nodes.add_node(group, "NodeGroupInput")
    points = nodes.add_node(group, "GeometryNodeCurveToPoints", mode='EVALUATED')
    group.links.new(start.outputs[0], points.inputs[0])
    group.links.new(points.outputs[0], nodes.add_node(group, "NodeGroupOutput").inputs[0])
    owner.modifiers.new("Points", 'NODES').node_group = group


def tube_positions(owner):
    """Positions of the mesh that an owner of trails has at frame 20."""
    frame_set(20)
    mesh = owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    found = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", found)
    return found


def assert_sparks(owner, frame):
    """The owner has the points that the system says, to the last bit."""
    frame_set(frame)
    settings, render = owner.motus.sparks, bpy.context.scene.render
    numbers, ages = toy.alive(frame / (render.fps / render.fps_base), settings.rate, settings.lifetime)
    target = settings.target and settings.target.evaluated_get(bpy.context.evaluated_depsgraph_get())
    positions, velocities = toy.fly(numbers, ages, np.array(target.matrix_world.translation) if target else np.zeros(3))
    found = points_of(owner)
    for name, wanted in (("position", positions), ("velocity", velocities), ("id", numbers), ("age", ages)):
        np.testing.assert_array_equal(found[name], wanted.astype(found[name].dtype), name)
    np.testing.assert_array_equal(found["radius"], (0.01 + 0.01 * ages).astype(np.float32))
    np.testing.assert_array_equal(found["color"][:, 1], (1.0 - ages).astype(np.float32))
    if found["turn"].shape[1] == 4:
        np.testing.assert_array_equal(found["turn"][:, 1], np.sin(ages).astype(np.float32))
    else:  # Euler angles, before Blender 4.0
        np.testing.assert_allclose(np.sin(found["turn"]), np.sin(np.outer(2.0 * ages, (1.0, 0.0, 0.0))), atol=1e-5)


class PointsTestCase(support.SceneTestCase):
    SYSTEMS = toy.SPARKS, toy.TRAILS, toy.LINES

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        support.register_systems(*cls.SYSTEMS)
        cls.addClassCleanup(support.unregister_systems, *cls.SYSTEMS)

    def sparks(self, **values):
        owner = toy_system.new_object("Owner", (1.0, 2.0, 3.0), bpy.data.meshes.new("Owner"))
        owner.rotation_euler, owner.scale = (0.3, 0.2, 0.1), (1.0, 2.0, -0.5)
        toy.make(toy.SPARKS, owner, target=toy_system.new_target(), **values)
        return owner

    def assert_all_frames(self, owner):
        for frame in FRAMES:
            with self.subTest(frame=frame):
                assert_sparks(owner, frame)

    def problem(self, owner, system=toy.SPARKS):
        return wiring.problem(system, owner, bpy.context.evaluated_depsgraph_get())


class PointsTest(PointsTestCase):
    def test_any_frame_in_any_order(self):
        owner = self.sparks()
        self.assert_all_frames(owner)
        self.assertIsNone(self.problem(owner))

    def test_they_stay_where_they_are_while_the_owner_moves(self):
        owner = self.sparks()
        for frame, place in ((1, 0.0), (100, 50.0)):
            owner.location.x = place
            owner.keyframe_insert("location", frame=frame)
        self.assert_all_frames(owner)

    def test_what_the_owner_has_by_itself(self):
        owner = self.sparks()
        owner.data.from_pydata([(0.0, 0.0, 1.0)] * 3, [], [(0, 1, 2)])
        self.assert_all_frames(owner)
        self.assertEqual(len(owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices), 3)

    def test_keyed_settings(self):
        owner = self.sparks()
        for frame, lifetime in ((1, 0.1), (100, 2.0)):
            owner.motus.sparks.lifetime = lifetime
            owner.motus.sparks.keyframe_insert("lifetime", frame=frame)
        self.assert_all_frames(owner)

    def test_none(self):
        owner = self.sparks()
        assert_sparks(owner, 30)
        for name, value, problem in (("rate", 0.0, toy.NO_RATE), ("influence", 0.0, None), ("lifetime", -1.0, None)):
            with self.subTest(name):
                kept = getattr(owner.motus.sparks, name)
                setattr(owner.motus.sparks, name, value)
                frame_set(30)
                self.assertEqual(len(points_of(owner).get("position", ())), 0)
                self.assertEqual(self.problem(owner), problem)
                setattr(owner.motus.sparks, name, kept)
                assert_sparks(owner, 30)

    def test_more_than_there_is_room_for(self):
        owner = self.sparks(rate=1_100_000.0)
        frame_set(40)
        capacity, found = toy.SPARKS.makes_points.capacity, points_of(owner)
        numbers, ages = toy.alive(40 / 24, 1_100_000.0, 1.0)
        self.assertGreater(len(numbers), capacity)
        np.testing.assert_array_equal(found["id"], numbers[:capacity])
        np.testing.assert_array_equal(found["age"], ages[:capacity].astype(np.float32))
        self.assertIn("only the first ones", self.problem(owner).sentence)
        self.assertFalse(self.problem(owner).blocking)
        owner.motus.sparks.rate = 10.0
        assert_sparks(owner, 40)
        self.assertIsNone(self.problem(owner))

    def test_tubes(self):
        owner = toy_system.new_object("Owner", (1.0, 2.0, 3.0), bpy.data.meshes.new("Owner"))
        toy.make(toy.TRAILS, owner, rate=5.0)
        frame_set(60)
        mesh = owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        numbers, ages = toy.alive(60 / 24, 5.0, 1.0)
        sides, count = 8, toy.TRAIL_POINTS
        # A trail that has no length yet is one that has not begun to fly.
        self.assertEqual(len(mesh.vertices), len(numbers) * count * sides)
        found = np.array([vertex.co for vertex in mesh.vertices]).reshape(len(numbers), count, sides, 3)
        ages = np.maximum(0.0, np.subtract.outer(ages, np.linspace(0.0, toy.TRAIL, count)))
        for index in range(len(numbers)):
            places, _ = toy.fly(np.full(count, numbers[index]), ages[index], np.zeros(3))
            np.testing.assert_allclose(found[index].mean(axis=1), places, atol=1e-5)
            radii = np.linalg.norm(found[index] - found[index].mean(axis=1, keepdims=True), axis=-1)
            if ages[index].min() > 0.0:
                np.testing.assert_allclose(radii, np.tile(0.01 + 0.01 * ages[index][:, None], sides), atol=1e-5)
        colors = _read(mesh.attributes["color"]).reshape(len(numbers), count, sides, 4)
        np.testing.assert_allclose(colors[:, :, 0, 0], ages, atol=1e-6)

    def test_curves(self):
        owner = toy_system.new_object("Owner", data=bpy.data.meshes.new("Owner"))
        toy.make(toy.LINES, owner, rate=5.0)
        frame_set(60)
        numbers, ages = toy.alive(60 / 24, 5.0, 1.0)
        ages = np.maximum(0.0, np.subtract.outer(ages, np.linspace(0.0, toy.TRAIL, toy.TRAIL_POINTS)))
        wanted = [toy.fly(np.full(toy.TRAIL_POINTS, number), some, np.zeros(3))[0] for number, some in zip(numbers, ages)]
        show_curves_as_points(owner)
        frame_set(60)
        found = points_of(owner)
        np.testing.assert_array_equal(found["position"], np.concatenate(wanted))
        np.testing.assert_array_equal(found["radius"], (0.01 + 0.01 * ages).astype(np.float32).ravel())
        np.testing.assert_array_equal(found["curve"], np.repeat(numbers, toy.TRAIL_POINTS))

    def test_a_hundred_thousand(self):
        owner = self.sparks(rate=100_000.0)
        assert_sparks(owner, 30)
        assert_sparks(owner, 23)

    def test_the_material_stays(self):
        owner = self.sparks()
        material = bpy.data.materials.new("Glow")
        wiring.set_points_material(toy.SPARKS, owner, material)
        owner.modifiers.new("Later", 'SUBSURF')
        wiring.refresh(toy.SPARKS, owner)
        frame_set(10)
        found = [
            list(one.object.data.materials)
            for one in bpy.context.evaluated_depsgraph_get().object_instances
            if one.object.type == 'POINTCLOUD'
        ]
        self.assertEqual([[one.original for one in some] for some in found], [[material]])
        self.assertEqual([one.name for one in owner.modifiers], ["Motus Sparks", "Later"])

    def test_instances(self):
        shapes = [toy_system.new_object(name, data=bpy.data.meshes.new(name)) for name in ("First", "Second")]
        collection = bpy.data.collections.new("Shapes")
        for shape in shapes:
            shape.data.from_pydata([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [], [(0, 1, 2)])
            collection.objects.link(shape)
        owner = self.sparks()
        node_groups = len(bpy.data.node_groups)
        for give, what, names in (
            (wiring.set_points_object, shapes[0], {"First"}),
            (wiring.set_points_collection, collection, {"First", "Second"}),
        ):
            give(toy.SPARKS, owner, what)
            wiring.refresh(toy.SPARKS, owner)
            self.assertEqual(len(bpy.data.node_groups), node_groups)
            frame_set(20)
            numbers, ages = toy.alive(20 / 24, 100.0, 1.0)
            found = [
                (one.object.name, np.array(one.matrix_world))
                for one in bpy.context.evaluated_depsgraph_get().object_instances
                if one.is_instance and one.object.type == 'MESH'
            ]
            self.assertEqual({name for name, _ in found}, names)
            matrices = np.array([matrix for _, matrix in found])
            places, _ = toy.fly(numbers, ages, np.array(owner.motus.sparks.target.matrix_world.translation))
            np.testing.assert_allclose(matrices[:, :3, 3], places, atol=1e-5)
            np.testing.assert_allclose(np.linalg.norm(matrices[:, :3, 0], axis=1), 0.01 + 0.01 * ages, rtol=1e-4)
            turned = matrices[:, :3, 1] / (0.01 + 0.01 * ages)[:, None]  # about X, by twice the age
            np.testing.assert_allclose(turned, np.stack((0.0 * ages, np.cos(2.0 * ages), np.sin(2.0 * ages)), axis=1), atol=1e-4)
        wiring.set_points_material(toy.SPARKS, owner, None)
        self.assertEqual((len(bpy.data.node_groups), collection.users), (node_groups, 0))
        self.assert_all_frames(owner)

    def test_removed(self):
        before = {kind: len(getattr(bpy.data, kind)) for kind in ("objects", "meshes", "node_groups")}
        owner = self.sparks()
        assert_sparks(owner, 20)
        wiring.detach(toy.SPARKS, owner)
        frame_set(21)
        self.assertEqual(points_of(owner), {})
        self.assertEqual(len(owner.modifiers), 0)
        self.assertEqual([name for name in owner.keys() if name.startswith("motus_")], [])
        after = {kind: len(getattr(bpy.data, kind)) for kind in before}
        self.assertEqual(after, {**before, "objects": 2, "meshes": before["meshes"] + 1})

    def test_copied(self):
        owner = self.sparks()
        assert_sparks(owner, 20)
        copy = owner.copy()
        bpy.context.scene.collection.objects.link(copy)
        copy.motus.sparks.rate = 20.0
        bpy.context.view_layer.update()
        self.assertNotEqual(copy.motus.sparks.hub, owner.motus.sparks.hub)
        for one in (owner, copy):
            self.assert_all_frames(one)
        bpy.data.objects.remove(owner)
        self.assert_all_frames(copy)


class PointsFilesTest(PointsTestCase):
    def test_saved_and_opened(self):
        owner = self.sparks()
        owner.motus.sparks.rate = 100_000.0
        assert_sparks(owner, 30)
        path = self.save()
        for use_scripts in (True, False):
            bpy.ops.wm.open_mainfile(filepath=path, use_scripts=use_scripts)
            self.assertEqual(len(bpy.data.objects["Owner"].motus.sparks.hub.data.vertices), 0)
            self.assert_all_frames(bpy.data.objects["Owner"])

    def test_rotations_of_a_file_of_an_older_blender(self):
        """They are Euler angles in a file that was saved before Blender 4.0."""
        owner = self.sparks()
        attributes = owner.motus.sparks.hub.data.attributes
        attributes.remove(attributes["turn"])
        attributes.new("turn", 'FLOAT_VECTOR', 'POINT')
        path = self.save()
        support.addon("core.wiring.sinks.made_points")._forms.clear()  # as in a session that has seen no other file
        bpy.ops.wm.open_mainfile(filepath=path)
        owner = bpy.data.objects["Owner"]
        self.assert_all_frames(owner)
        self.assertIsNone(self.problem(owner))
        self.assertEqual(points_of(owner)["turn"].shape[1], 3)

    def test_the_file_is_small(self):
        owner = self.sparks(rate=150_000.0)
        assert_sparks(owner, 30)
        with_points = (self.folder / self.save()).stat().st_size
        wiring.detach(toy.SPARKS, owner)
        self.assertLess(with_points - (self.folder / self.save("without.blend")).stat().st_size, LARGEST_FILE)

    def test_fresh_blenders(self):
        self.sparks()
        path = self.save()
        status, output = support.run_beside(FRESH.format(path=path))
        self.assertEqual(status, 0, output)
        status, output = support.run_beside(BARE.format(path=path), enabled=False)
        self.assertEqual(status, 0, output)
        self.assertIn("KINDS ['EMPTY', 'MESH']", output)

    def test_appended(self):
        self.sparks()
        owner = self.load(self.save(), False, "Owner", "Target")
        self.assert_all_frames(owner)
        wiring.detach(toy.SPARKS, owner)
        self.assertEqual((len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.node_groups)), (2, 1, 0))

    def test_linked(self):
        self.sparks()
        owner = self.load(self.save(), True, "Owner", "Target")
        self.assert_all_frames(owner)
        self.assertEqual(len(owner.motus.sparks.hub.data.vertices), 0)

    def test_linked_tubes(self):
        owner = toy_system.new_object("Owner", (1.0, 2.0, 3.0), bpy.data.meshes.new("Owner"))
        toy_system.new_target()
        toy.make(toy.TRAILS, owner)
        wanted = tube_positions(owner)
        np.testing.assert_array_equal(tube_positions(self.load(self.save(), True, "Owner", "Target")), wanted)

    def test_overridden(self):
        self.sparks()
        linked = self.load(self.save(), True, "Owner", "Target")
        owner = linked.override_create(remap_local_usages=True)
        self.assert_all_frames(owner)
        owner.motus.sparks.rate = 30.0
        self.assert_all_frames(owner)
        bpy.ops.wm.open_mainfile(filepath=self.save("over.blend"))
        owner = next(one for one in bpy.data.objects if one.override_library and one.type == 'MESH')
        self.assertAlmostEqual(owner.motus.sparks.rate, 30.0)
        self.assert_all_frames(owner)


class PointsDamagedTest(PointsTestCase):
    def test_said_or_harmless(self):
        case = damaged_cases.Case("sparks", self.sparks, None, None)
        owner = self.sparks()
        self.assertIsNone(self.problem(owner))
        path = self.save()
        every = list(damaged_cases.damages(case, owner))
        self.assertGreater(len(every), 60)
        with damaged_cases.raised() as errors:
            for damage in every:
                with self.subTest(damage.name):
                    bpy.ops.wm.open_mainfile(filepath=path)
                    support.addon("core.wiring.sinks.made_points")._forms.clear()
                    self.check(bpy.data.objects["Owner"], damage)
        self.assertEqual(errors, [])

    def check(self, owner, damage):
        damage.act(owner)
        for block in (*bpy.data.objects, *bpy.data.meshes):
            block.update_tag()
        bpy.context.view_layer.update()
        for frame in (20, 30.25):
            frame_set(frame)
        if self.problem(owner) is None:
            assert_sparks(owner, 30.25)
        wiring.refresh(toy.SPARKS, owner)
        assert_sparks(owner, 30.25)
        self.assertIsNone(self.problem(owner))

    def test_inputs_removed(self):
        owner = self.sparks()
        group = owner.modifiers[0].node_group
        if hasattr(group, "interface"):
            group.interface.clear()
        else:
            group.inputs.clear()
        frame_set(20)
        wiring.refresh(toy.SPARKS, owner)
        assert_sparks(owner, 20)
