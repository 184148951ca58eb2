"""What flakes land on: the ground, a mesh, the meshes of a collection; what moves, is recorded, or goes."""

import os
from unittest import mock

import bmesh
import bpy
import numpy as np

import support
from snow.snow_cases import SnowTestCase, flakes, state
from support import go_to, key_places

SQUARE = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]
FALLING = {"start_speed": 2.0, "lifetime": 4.0, "rate": 60.0}


class LandingCase(SnowTestCase):
    def board(self, name, place, size=(4.0, 4.0)):
        """A square mesh about a place, level."""
        return self.mesh(name, [(size[0] * (x - 0.5), size[1] * (y - 0.5), 0.0) for x, y, _ in SQUARE], [(0, 1, 2, 3)], place)

    def gathered(self, *objects):
        """A collection with these alone."""
        collection = bpy.data.collections.new("Scenery")
        bpy.context.scene.collection.children.link(collection)
        for obj in objects:
            bpy.context.scene.collection.objects.unlink(obj)
            collection.objects.link(obj)
        return collection

    def lying(self, emitter, height):
        """How many flakes lie at a height."""
        found = flakes(emitter)
        return int(np.count_nonzero((np.abs(found["position"][:, 2] - height) < 1e-4) & (np.abs(found["velocity"]).max(axis=1) == 0.0)))

    def add(self, **keywords):
        return super().add(all_attributes=True, **{"location": (0.0, 0.0, 3.0)} | FALLING | keywords)


class Landing(LandingCase):
    @support.in_one_blender
    def test_a_frame_without_a_window_looks_at_as_many_as_it_has_time_for(self):
        self.board("Meadow", (0.0, 0.0, 0.0))
        emitter = self.add(collider="Meadow", rate=600.0)
        go_to(100)
        every = flakes(emitter)["position"]
        bounds, landings = support.addon("core.measures.bounds"), support.addon("snow.landings")
        support.addon("snow.flakes")._snows.clear()
        emitter.motus.snow.seed += 1
        emitter.motus.snow.seed -= 1
        with mock.patch.object(bounds, "AT_ONCE", 3 * landings.BLOCK):
            counts = []
            while len(counts) < 5:
                emitter.update_tag()
                go_to(100)
                counts.append(len(flakes(emitter)["position"]))
        self.assertLess(0, counts[0])
        self.assertLessEqual(counts[0], 3 * 256)
        self.assertEqual(counts, sorted(counts))
        np.testing.assert_array_equal(flakes(emitter)["position"], every)

    @support.in_one_blender
    def test_emitters_share_the_time_of_a_frame(self):
        self.board("Meadow", (0.0, 0.0, 0.0))
        emitters = [self.add(collider="Meadow", rate=600.0, seed=seed) for seed in (1, 2)]
        bounds, landings = support.addon("core.measures.bounds"), support.addon("snow.landings")
        go_to(100)
        support.addon("snow.flakes")._snows.clear()
        for emitter in emitters:
            emitter.motus.snow.seed += 2
        with mock.patch.object(bounds, "AT_ONCE", 4 * landings.BLOCK):
            go_to(100)
            found = sum(len(flakes(emitter)["position"]) for emitter in emitters)
        self.assertLessEqual(found, 4 * 256)

    def test_the_ground(self):
        emitter = self.add(use_ground=True, ground=1.0)
        go_to(121)
        found = flakes(emitter)
        landed = found["age"] > 1.0
        self.assertGreater(np.count_nonzero(landed), 100)
        np.testing.assert_allclose(found["position"][landed, 2], 1.0, atol=1e-5)
        np.testing.assert_allclose(found["position"][~landed, 2], 3.0 - 2.0 * found["age"][~landed], atol=1e-5)
        self.assertPlayedAsCold(emitter)

    def assertPlayedAsCold(self, emitter):
        played = {}
        for frame in (40, 80, 121):
            go_to(frame)
            played[frame] = flakes(emitter)["position"]
        for frame in (121, 40, 80):
            go_to(frame)
            np.testing.assert_array_equal(flakes(emitter)["position"], played[frame])

    def test_a_mesh_in_the_way(self):
        roof = self.mesh("Roof", SQUARE, [(0, 1, 2, 3)], place=(-2.0, -2.0, 2.0))
        roof.scale = 2.0, 4.0, 1.0  # x from -2 to 0
        bpy.context.view_layer.update()
        emitter = self.add(collider="Roof", location=(0.0, 0.0, 3.0))
        go_to(121)
        found = flakes(emitter)
        below = found["position"][found["position"][:, 2] < 2.0 - 1e-4]
        self.assertGreater(len(below), 30)
        self.assertGreater(below[:, 0].min(), 0.0)
        lying = np.abs(found["position"][:, 2] - 2.0) < 1e-4
        self.assertGreater(np.count_nonzero(lying & (found["age"] > 0.6)), 30)
        self.assertEqual(self.sentence(emitter), "")
        self.assertPlayedAsCold(emitter)
        roof.location.z = 2.5
        bpy.context.view_layer.update()
        self.assertGreater(np.count_nonzero(np.abs(flakes(emitter)["position"][:, 2] - 2.5) < 1e-4), 30)

    def test_melting(self):
        emitter = self.add(use_ground=True, ground=2.0, collision='MELT', melt_time=0.5, location=(0.0, 0.0, 3.0))
        go_to(121)
        found = flakes(emitter)
        self.assertLess(found["age"].max(), 1.0 + 1e-3)
        whole, melting = (found["radius"][choice] for choice in (found["age"] < 0.5, found["age"] > 0.8))
        self.assertLess(melting.max(), 0.6 * whole.min())

    def test_faults_are_said(self):
        roof = self.board("Roof", (0.0, 0.0, 1.0))
        emitter = self.add(collider="Roof")
        go_to(100)
        self.assertGreater(self.lying(emitter, 1.0), 50)
        roof.data.clear_geometry()
        go_to(101)
        self.assertIn("has no faces", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        curve = bpy.data.objects.new("Curve", bpy.data.curves.new("Curve", 'CURVE'))
        bpy.context.scene.collection.objects.link(curve)
        emitter.motus.snow.collider = curve
        self.assertIn("has no faces", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        emitter.motus.snow.collider = roof
        bpy.context.scene.collection.objects.unlink(roof)
        for frame in (102, 103):
            go_to(frame)
        self.assertIn("collider is gone", self.sentence(emitter))
        self.assertRefused("is no mesh", bpy.ops.motus.snow_add, collider=bpy.data.objects.new("Empty", None).name)
        self.assertRefused("There is no collection", bpy.ops.motus.snow_add, colliders="Nowhere")
        self.assertRefused("Nothing was recorded", bpy.ops.motus.snow_colliders_clear, object=emitter.name)
        emitter.motus.snow.collider = None
        self.assertRefused("nothing with faces", bpy.ops.motus.snow_colliders_record, object=emitter.name)


class Collection(LandingCase):
    def test_its_meshes_are_landed_on(self):
        low, high = self.board("Low", (1.0, 0.0, 0.5), (2.0, 4.0)), self.board("High", (-1.0, 0.0, 1.5), (2.0, 4.0))
        scenery = self.gathered(low, high)
        # The emitter may stand in it.
        emitter = self.add(colliders="Scenery")
        scenery.objects.link(emitter)
        bpy.context.view_layer.update()
        go_to(100)
        lower, higher = self.lying(emitter, 0.5), self.lying(emitter, 1.5)
        self.assertTrue(lower > 30 and higher > 30)
        self.assertEqual(self.sentence(emitter), "")
        # Edits, objects that come and go.
        low.location.z = 0.25
        bpy.context.view_layer.update()
        self.assertEqual(self.lying(emitter, 0.5), 0)
        self.assertAlmostEqual(self.lying(emitter, 0.25), lower, delta=8)  # they fall for longer
        low.modifiers.new("Array", 'ARRAY').constant_offset_displace = 0.0, 0.0, 0.5
        low.modifiers[0].use_relative_offset, low.modifiers[0].use_constant_offset = False, True
        bpy.context.view_layer.update()
        self.assertAlmostEqual(self.lying(emitter, 0.75), lower, delta=8)
        scenery.objects.unlink(low)
        bpy.context.view_layer.update()
        self.assertEqual((self.lying(emitter, 0.75), self.lying(emitter, 1.5)), (0, higher))
        scenery.objects.link(self.board("Third", (0.0, 0.0, 2.0)))
        bpy.context.view_layer.update()
        self.assertEqual(self.lying(emitter, 1.5), 0)
        self.assertGreater(self.lying(emitter, 2.0), 60)

    def test_an_empty_one_and_one_without_faces(self):
        self.gathered()
        emitter = self.add(colliders="Scenery")
        go_to(100)
        self.assertIn("has no faces", self.sentence(emitter))
        self.assertGreater(len(flakes(emitter)["id"]), 0)
        bpy.data.collections["Scenery"].objects.link(self.mesh("Wire", SQUARE, []))
        bpy.context.view_layer.update()
        self.assertIn("has no faces", self.sentence(emitter))
        bpy.data.collections.remove(bpy.data.collections["Scenery"])
        self.assertEqual(self.sentence(emitter), "")

    def test_instanced_collections(self):
        part = bpy.data.collections.new("Part")
        board = self.board("Board", (0.0, 0.0, 0.5))
        part.objects.link(board)
        bpy.context.scene.collection.objects.unlink(board)
        part.instance_offset = 0.0, 0.0, 0.25
        empty = bpy.data.objects.new("Instance", None)
        empty.instance_type, empty.instance_collection = 'COLLECTION', part
        empty.location = 0.0, 0.0, 1.0
        bpy.context.scene.collection.objects.link(empty)
        self.gathered(empty)
        emitter = self.add(colliders="Scenery")
        go_to(100)
        self.assertGreater(self.lying(emitter, 1.25), 60)
        empty.location.z = 0.5
        bpy.context.view_layer.update()
        self.assertGreater(self.lying(emitter, 0.75), 60)

    def test_a_linked_collection(self):
        board = self.board("Board", (0.0, 0.0, 1.0))
        scenery = self.gathered(board)
        file = os.path.join(self.folder, "scenery.blend")
        bpy.data.libraries.write(file, {scenery})
        bpy.data.objects.remove(board)
        bpy.data.collections.remove(scenery)
        with bpy.data.libraries.load(file, link=True) as (_, wanted):
            wanted.collections = ["Scenery"]
        bpy.context.scene.collection.children.link(wanted.collections[0])
        emitter = self.add(colliders="Scenery")
        for frame in (100, 3, 100):
            go_to(frame)
        self.assertGreater(self.lying(emitter, 1.0), 60)
        self.assertEqual(self.sentence(emitter), "")

    def test_edits_of_a_mesh(self):
        board = self.board("Board", (0.0, 0.0, 0.0))
        self.gathered(board)
        emitter = self.add(colliders="Scenery")
        go_to(100)

        def lift(height):
            board.data.vertices.foreach_set("co", [part for one in board.data.vertices for part in (*one.co[:2], height)])
            board.data.update()

        def one_by_one(height):
            for one in board.data.vertices:
                one.co.z = height

        def in_edit_mode(height):
            bpy.context.view_layer.objects.active = board
            bpy.ops.object.mode_set(mode='EDIT')
            mesh = bmesh.from_edit_mesh(board.data)
            for one in mesh.verts:
                one.co.z = height
            bmesh.update_edit_mesh(board.data)
            bpy.ops.object.mode_set(mode='OBJECT')

        def other_mesh(height):
            kept, board.data = board.data, board.data.copy()
            lift(height)
            bpy.data.meshes.remove(kept)

        for number, edit in enumerate((lift, one_by_one, in_edit_mode, other_mesh)):
            with self.subTest(edit.__name__):
                height = 0.25 + 0.25 * number
                edit(height)
                bpy.context.view_layer.update()
                self.assertGreater(self.lying(emitter, height), 60)

    def test_a_large_one_is_built_once(self):
        side = 150
        positions = [(0.03 * column - 2.2, 0.03 * row - 2.2, 0.5) for row in range(side) for column in range(side)]
        faces = [(at, at + 1, at + side + 1, at + side) for at in range(side * (side - 1)) if at % side < side - 1]
        self.gathered(self.mesh("Field", positions, faces))
        emitter = self.add(colliders="Scenery")
        flakes_of = support.addon("snow.flakes")
        flakes_of._colliders.clear()
        making, reading = mock.Mock(wraps=flakes_of._collider), mock.Mock(wraps=support.addon("core.scenery.meshes")._read)
        with mock.patch.object(flakes_of, "_collider", making), mock.patch.object(support.addon("core.scenery.meshes"), "_read", reading):
            for frame in (60, 3, 100, 61):
                go_to(frame)
                emitter.motus.snow.friction += 0.01
                bpy.context.view_layer.update()
        self.assertGreater(self.lying(emitter, 0.5), 20)
        self.assertEqual(making.call_count, 1)
        self.assertLessEqual(reading.call_count, 1)

    def test_a_file_that_is_opened_cold(self):
        self.gathered(self.board("Low", (1.0, 0.0, 0.5)), self.board("High", (-1.0, 0.0, 1.5)))
        emitter = self.add(colliders="Scenery", use_steering=True, steering_per_flake=True)
        go_to(90)
        before, name = state(emitter), emitter.name
        file = os.path.join(self.folder, "snow.blend")
        bpy.ops.wm.save_as_mainfile(filepath=file, check_existing=False)
        go_to(3)
        bpy.ops.wm.open_mainfile(filepath=file)
        self.assertEqual(state(bpy.data.objects[name]), before)


class Moving(LandingCase):
    def assertFallsThrough(self, emitter, height):
        go_to(60)
        self.assertIn("colliders that may move", self.sentence(emitter))
        self.assertEqual(self.lying(emitter, height), 0)
        self.assertGreater(len(flakes(emitter)["id"]), 0)

    def test_what_moves_is_fallen_through_until_it_is_recorded(self):
        still, roof = self.board("Still", (0.0, 0.0, 0.0)), self.board("Roof", (0.0, 0.0, 1.0))
        self.gathered(still, roof)
        emitter = self.add(colliders="Scenery")
        hoist = support.link("Hoist")
        key_places(hoist, {1: (0.0, 0.0, 1.0), 50: (0.0, 0.0, 2.0)})
        roof.constraints.new('COPY_LOCATION').target = hoist
        self.assertFallsThrough(emitter, 2.0)
        self.assertGreater(self.lying(emitter, 0.0), 20)
        go_to(1)
        self.assertEqual(bpy.ops.motus.snow_colliders_record(object=emitter.name), {'FINISHED'})
        self.assertEqual(emitter.motus.snow.recorded_frame, 1.0)
        found = {}
        for _ in range(2):
            for frame in (60, 30, 90):
                go_to(frame)
                self.assertEqual(self.sentence(emitter), "")
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter))
        self.assertGreater(self.lying(emitter, 1.0), 60)
        self.assertEqual(bpy.ops.motus.snow_colliders_clear(object=emitter.name), {'FINISHED'})
        self.assertEqual([obj.name for obj in bpy.data.objects if obj.name.startswith(".Motus Colliders")], [])
        self.assertFallsThrough(emitter, 1.0)
        go_to(1)
        bpy.ops.motus.snow_colliders_record(object=emitter.name)
        bpy.ops.motus.snow_remove(object=emitter.name)
        self.assertEqual([mesh.name for mesh in bpy.data.meshes if mesh.name.startswith(".Motus")], [])

    def test_recorded_again(self):
        roof = self.board("Roof", (0.0, 0.0, 1.0))
        emitter = self.add(collider="Roof")
        go_to(60)
        for height in (1.0, 2.0):
            roof.location.z = height
            self.assertEqual(bpy.ops.motus.snow_colliders_record(object=emitter.name), {'FINISHED'})
            bpy.context.view_layer.update()
            self.assertGreater(self.lying(emitter, height), 20)
        self.assertEqual(self.lying(emitter, 1.0), 0)
        self.assertEqual(len([mesh for mesh in bpy.data.meshes if mesh.name.startswith(".Motus Colliders")]), 1)
        # What was recorded stays where there is nothing to record.
        before = state(emitter)
        roof.data.clear_geometry()
        self.assertRefused("nothing with faces", bpy.ops.motus.snow_colliders_record, object=emitter.name)
        bpy.context.view_layer.update()
        self.assertEqual(state(emitter), before)

    def test_what_may_move(self):
        def shape_key(obj):
            obj.shape_key_add(name="Basis")
            key = obj.shape_key_add(name="Up")
            key.keyframe_insert("value", frame=1)

        def keyed_modifier(obj):
            obj.modifiers.new("Array", 'ARRAY').keyframe_insert("count", frame=1)

        def moved_by_another(obj):
            other = bpy.data.objects.new("Other", None)
            bpy.context.scene.collection.objects.link(other)
            key_places(other, {1: (0.0, 0.0, 0.0), 50: (1.0, 0.0, 0.0)})
            obj.modifiers.new("Mirror", 'MIRROR').mirror_object = other

        def constraint(obj):
            obj.constraints.new('COPY_LOCATION').target = self.board("Target", (0.0, 0.0, 1.0))

        def scene_time(obj):
            group = bpy.data.node_groups.new("Time", 'GeometryNodeTree')
            support.addon("core.blender.node_groups").add_sockets(
                group, (("Geometry", 'INPUT', "NodeSocketGeometry"), ("Geometry", 'OUTPUT', "NodeSocketGeometry"))
            )
            start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
            group.links.new(start.outputs[0], end.inputs[0])
            group.nodes.new("GeometryNodeInputSceneTime")
            obj.modifiers.new("Nodes", 'NODES').node_group = group

        def wave(obj):
            obj.modifiers.new("Wave", 'WAVE')

        def cut_by_a_collection(obj):
            cutter = self.board("Cutter", (0.0, 0.0, 1.0))
            key_places(cutter, {1: (0.0, 0.0, 0.0), 50: (1.0, 0.0, 0.0)})
            boolean = obj.modifiers.new("Boolean", 'BOOLEAN')
            boolean.operand_type, boolean.collection = 'COLLECTION', bpy.data.collections.new("Cutters")
            boolean.collection.objects.link(cutter)

        for number, change in enumerate((shape_key, keyed_modifier, moved_by_another, constraint, scene_time, wave, cut_by_a_collection)):
            with self.subTest(change.__name__):
                roof = self.board(f"Roof {number}", (0.0, 0.0, 1.0))
                emitter = self.add(collider=roof.name)
                go_to(60)
                self.assertEqual(self.sentence(emitter), "")
                change(roof)
                bpy.context.view_layer.update()
                self.assertIn("may move", self.sentence(emitter))

    def test_what_stands_still(self):
        roof = self.board("Roof", (0.0, 0.0, 1.0))
        parent = bpy.data.objects.new("Parent", None)
        bpy.context.scene.collection.objects.link(parent)
        parent.location.x = 0.1
        roof.parent = parent
        other = self.board("Other", (3.0, 0.0, 0.0))
        roof.modifiers.new("Mirror", 'MIRROR').mirror_object = other
        roof.modifiers.new("Subdivision", 'SUBSURF')
        roof.keyframe_insert("location", frame=1)
        emitter = self.add(collider="Roof")
        go_to(60)
        self.assertEqual(self.sentence(emitter), "")


class Threads(LandingCase):
    def test_one_thread_and_two(self):
        """The same bits, of flakes and of where they land."""
        emitter = self.add(use_ground=True, rate=5000.0, use_steering=True, steering_per_flake=True, random_lifetime=True, tumble=1.0)
        self.gathered(self.board("Board", (0.0, 0.0, 1.0), (1.0, 1.0)))
        emitter.motus.snow.colliders = bpy.data.collections["Scenery"]
        file = os.path.join(self.folder, "threads.blend")
        go_to(70)
        expected = state(emitter)
        bpy.ops.wm.save_as_mainfile(filepath=file, check_existing=False)
        for threads in (1, 2):
            out = os.path.join(self.folder, f"threads{threads}")
            status, said = support.run_blender(
                THREADS.format(file=file, name=emitter.name, out=out), arguments=("--factory-startup", "-t", str(threads))
            )
            self.assertEqual(status, 0, said)
            with open(out, "rb") as opened:
                self.assertEqual(opened.read(), expected, threads)


THREADS = """
import bpy
bpy.ops.wm.open_mainfile(filepath={file!r})
from snow.snow_cases import state
bpy.context.scene.frame_set(70)
with open({out!r}, "wb") as opened:
    opened.write(state(bpy.data.objects[{name!r}]))
"""
