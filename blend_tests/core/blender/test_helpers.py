"""Helpers of all systems (hubs, proxies, shapes of flakes): they come along with what needs them, unseen, and leave with it."""

import functools
import os
import tempfile
from pathlib import Path

import bpy

import live_scenes
import support

KEY = "motus_helper"


def helpers():
    return [obj for obj in bpy.data.objects if KEY in obj]


def hub_meshes():
    return [mesh for mesh in bpy.data.meshes if "motus_owner" in mesh or "motus_shared" in mesh]


def select(names):
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj.name in names)


def is_owner(obj):
    return any(getattr(getattr(obj.motus, name, None), "is_active", False) for name in obj.motus.bl_rna.properties.keys())


@functools.cache
def live_file():
    """A file in which all systems are at work: (its path, names of its objects, their states, what deletes it at the end)."""
    folder = tempfile.TemporaryDirectory(prefix="motus-test-")
    path = str(Path(folder.name, "live.blend"))
    live_scenes.opened()
    props = bpy.data.collections.new("Props")
    bpy.context.scene.collection.children.link(props)
    for obj in list(bpy.context.scene.collection.objects):
        bpy.context.scene.collection.objects.unlink(obj)
        props.objects.link(obj)
    bpy.data.objects["Snow"].motus.snow.look = 'FLAKE'
    names, states = [obj.name for obj in bpy.context.view_layer.objects], live_scenes.states()
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    return path, names, states, folder


class LiveFile(support.SceneTestCase):
    """Each test opens a file in which all systems are at work."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.path, cls.names, cls.states, _ = live_file()

    def open(self):
        bpy.ops.wm.open_mainfile(filepath=self.path)
        bpy.context.view_layer.update()

    def assert_unseen(self):
        bpy.context.view_layer.update()
        self.assertEqual([obj.name for obj in helpers() if obj.users_collection], [])
        self.assertEqual([obj.name for obj in helpers() if not obj.name.startswith(".")], [])
        self.assertEqual([obj.name for obj in bpy.context.view_layer.objects if obj.name.startswith(".")], [])
        self.assertEqual([obj.name for obj in bpy.data.objects if obj.data in hub_meshes() and KEY not in obj], [])
        self.assertEqual([obj.name for obj in helpers() if obj.hide_viewport != obj.hide_render or obj.hide_viewport != bool(obj[KEY])], [])

    def assert_moves(self, named=lambda name: name):
        """That all that shows is where it is in the file. named: the name that an object has there."""
        for frame, found in live_scenes.states().items():
            self.assertGreater(len(found), 0)
            wanted = {key: self.states[frame][named(key[0]), key[1]] for key in found}
            self.assertEqual(support.differ(found, wanted, 2e-5, 1e-7), set(), f"on frame {frame}")


class TestArriving(LiveFile):
    def test_in_the_file(self):
        self.open()
        self.assertGreater(len(helpers()), 25)
        self.assert_unseen()
        self.assertEqual([mesh.name for mesh in hub_meshes() if not mesh.name.startswith(".")], [])

    def test_no_lines_to_the_origin(self):
        self.open()
        self.assert_collapsed()

    def assert_collapsed(self):
        open_ones = [
            (thing.name, one.name)
            for obj in bpy.data.objects
            for thing in (obj, *(obj.pose.bones if obj.pose else ()))
            for one in thing.constraints
            if one.name.startswith("Motus") and one.show_expanded
        ]
        self.assertEqual(open_ones, [])

    def test_pasted_into_another_file(self):
        self.open()
        select(self.names)
        bpy.ops.view3d.copybuffer()
        support.empty_scene()
        bpy.ops.view3d.pastebuffer(autoselect=True)
        self.assert_unseen()
        self.assertEqual({obj.name for obj in bpy.context.view_layer.objects}, set(self.names))
        self.assert_moves()

    def test_pasted_alone(self):
        for name in ("Car", "Arm", "Snow", "Parcel", "Grid", "Hook"):
            with self.subTest(name):
                self.open()
                select([name])
                bpy.ops.view3d.copybuffer()
                support.empty_scene()
                bpy.ops.view3d.pastebuffer(autoselect=True)
                self.assert_unseen()
                needed = {obj for obj in helpers() if obj.users > int(obj.use_fake_user)}
                self.assertEqual(set(helpers()), needed)
                self.assert_moves()

    def test_pasted_beside_itself(self):
        self.open()
        select(["Car", "Arm", "Parcel", "Hook"])
        bpy.ops.view3d.copybuffer()
        for _ in range(2):
            bpy.ops.view3d.pastebuffer(autoselect=True)
            self.assert_unseen()
        self.assert_moves(lambda name: name if name in self.names else name.rpartition(".")[0])

    def test_appended_collection(self):
        for instanced in (False, True):
            with self.subTest(instanced=instanced):
                support.empty_scene()
                bpy.ops.wm.append(
                    filepath=os.path.join(self.path, "Collection", "Props"),
                    directory=os.path.join(self.path, "Collection") + os.sep,
                    filename="Props",
                    instance_collections=instanced,
                )
                self.assert_unseen()
                if not instanced:
                    self.assert_moves()

    def test_undo_leaves_them_away(self):
        self.open()
        select(["Arm"])
        bpy.ops.view3d.copybuffer()
        support.empty_scene()
        bpy.ops.ed.undo_push(message="empty")
        bpy.ops.view3d.pastebuffer(autoselect=True)
        bpy.ops.ed.undo_push(message="pasted")
        self.assert_unseen()
        bpy.data.objects["Arm"].location.x = 5.0
        bpy.ops.ed.undo_push(message="moved")
        bpy.ops.ed.undo()
        self.assert_unseen()
        bpy.ops.ed.undo()
        self.assertEqual(len(bpy.data.objects), 0)
        bpy.ops.ed.redo()
        self.assert_unseen()


class TestCopies(LiveFile):
    def test_duplicated(self):
        for linked in (False, True):
            with self.subTest(linked=linked):
                self.open()
                select(self.names)
                before = len(helpers())
                bpy.ops.object.duplicate(linked=linked)
                self.assert_unseen()
                self.assertGreater(len(helpers()), before)
                self.assert_moves(lambda name: name if name in self.names else self._first(name))

    def _first(self, name):
        # Blender counts a name's own number on.
        stem = name.rpartition(".")[0]
        return stem if stem in self.names else f"{stem}.{int(name.rpartition('.')[2]) - 2}"

    def test_duplicate_leaves_readers_with_the_first(self):
        """Users' drivers that read a follower's outlet or a rig's hub go on to read what they did."""
        self.open()
        for name, carrier in (("Gauge", bpy.data.objects["Car"]), ("Strain", bpy.data.objects["Arm"].motus.ik.hub.data)):
            reader = bpy.data.objects.get(name) or bpy.data.objects.new(name, None)
            if name == "Strain":
                bpy.context.scene.collection.objects.link(reader)
                variable = reader.driver_add("location", 0).driver.variables.new()
                target = variable.targets[0]
                target.id_type, target.id = 'MESH', carrier
                target.data_path = f'["{next(key for key in carrier.keys() if key.startswith("motus_ik_out"))}"][2]'
        read = self._read()
        for name in ("Car", "Arm"):
            select([name])
            bpy.ops.object.duplicate()
            bpy.context.view_layer.update()
        self.assertEqual({place: found for place, found in self._read().items() if place in read}, read)
        copy = bpy.data.objects["Car.001"]
        own = [target.id for curve in copy.animation_data.drivers for variable in curve.driver.variables for target in variable.targets]
        self.assertNotIn(copy, own)

    def _read(self):
        return {
            (obj.name, curve.data_path, curve.array_index): (target.id.name, target.data_path)
            for obj in bpy.context.view_layer.objects
            if obj.animation_data
            for curve in obj.animation_data.drivers
            for variable in curve.driver.variables
            for target in variable.targets
            if target.id
        }

    def test_instances_made_real_are_the_artists(self):
        self.open()
        bpy.context.scene.frame_set(40)
        select(["Snow"])
        bpy.context.view_layer.objects.active = bpy.data.objects["Snow"]
        bpy.ops.object.duplicates_make_real()
        self.assert_unseen()
        flakes = [obj for obj in bpy.context.view_layer.objects if obj.name.startswith("Motus Flake")]
        self.assertGreater(len(flakes), 10)
        self.assertEqual([obj.name for obj in flakes if obj.keys()], [])


class TestPurge(LiveFile):
    """*Purge* of *File > Clean Up*, with all that it can do: what is in the scene stays whole."""

    def purge(self):
        before = {obj.name for obj in bpy.data.objects}
        for _ in range(2):
            bpy.ops.outliner.orphans_purge(do_local_ids=True, do_linked_ids=True, do_recursive=True)
        self.assertEqual({obj.name for obj in bpy.data.objects}, before)

    def test_in_the_file(self):
        self.open()
        self.purge()
        self.assert_moves()

    def test_in_a_file_of_an_earlier_version(self):
        self.open()
        for mesh in hub_meshes():
            mesh.use_fake_user = False
        path = str(self.folder / "earlier.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.purge()
        self.assert_moves()

    def test_appended(self):
        with bpy.data.libraries.load(self.path) as (_, wanted):
            wanted.collections = ["Props"]
        bpy.context.scene.collection.children.link(wanted.collections[0])
        bpy.context.view_layer.update()
        self.purge()
        self.assert_moves()


class TestLeaving(LiveFile):
    def delete(self, *names):
        """And save, by which owners leave a Blender without a window."""
        select(names)
        bpy.ops.object.delete()
        bpy.context.view_layer.update()
        with tempfile.TemporaryDirectory(prefix="motus-test-") as folder:
            bpy.ops.wm.save_as_mainfile(filepath=str(Path(folder, "deleted.blend")), copy=True)

    def test_a_script_may_put_an_owner_back(self):
        """Taken out of its collection, evaluated without, and linked to another one."""
        self.open()
        for name in self.names:
            (obj,) = (one for one in bpy.context.view_layer.objects if one.name == name)
            homes = list(obj.users_collection)
            for home in homes:
                home.objects.unlink(obj)
            bpy.context.view_layer.update()
            homes[0].objects.link(obj)
        self.assert_moves()

    def test_owner_goes_with_its_helpers(self):
        for name in ("Arm", "Figure", "Puppet", "Parcel", "Grid", "Crane", "Snow Cover", "Eyes", "Spider", "Racer", "Balloon"):
            with self.subTest(name):
                self.open()
                named = [name, *(child.name for child in bpy.data.objects[name].children_recursive if name == "Crane")]
                before = len(hub_meshes())
                self.delete(*named)
                self.assertNotIn(name, bpy.data.objects)
                self.assertLess(len(hub_meshes()), before)
                self.assertEqual([mesh.name for mesh in hub_meshes() if mesh.get("motus_owner", mesh) is None], [])

    def test_all(self):
        self.open()
        self.delete(*self.names)
        self.assertEqual([obj.name for obj in bpy.data.objects], [])
        self.assertEqual(hub_meshes(), [])

    def test_what_is_used_stays(self):
        """A locomotive whose wagons are still there goes on to lead them; an owner with a fake user."""
        self.open()
        bpy.data.objects["Parcel"].use_fake_user = True
        self.delete("Engine", "Parcel")
        for name in ("Engine", "Parcel"):
            self.assertIn(name, bpy.data.objects)

    def test_owner_that_a_script_removes(self):
        self.open()
        for name in self.names:
            bpy.data.objects.remove(bpy.data.objects[name])
        with tempfile.TemporaryDirectory(prefix="motus-test-") as folder:
            path = str(Path(folder, "removed.blend"))
            for _ in range(2):  # Blender writes a mesh that only an unused object uses; its users are counted again when it is read
                bpy.ops.wm.save_as_mainfile(filepath=path)
                bpy.ops.wm.open_mainfile(filepath=path)
        self.assertEqual(hub_meshes(), [])
        self.assertEqual([obj.name for obj in helpers()], [])

    def test_owner_whose_hub_a_script_has_removed(self):
        self.open()
        bpy.data.objects.remove(bpy.data.objects["Parcel"])
        self.delete("Arm")
        self.assertNotIn("Arm", bpy.data.objects)

    def test_an_artists_object_with_the_mesh_of_a_hub_stays(self):
        """As a script or the list of meshes can bring about."""
        self.open()
        hub = next(obj for obj in helpers() if obj.data in hub_meshes() and obj.data["motus_owner"] == bpy.data.objects["Parcel"])
        obj, mesh = bpy.data.objects.new("Mine", hub.data), hub.data
        bpy.context.scene.collection.objects.link(obj)
        bpy.context.view_layer.update()
        bpy.ops.motus.dynamics_remove(object="Parcel")
        self.assertEqual(bpy.data.objects["Mine"].data, mesh)
        self.assertNotIn(mesh, hub_meshes())
        self.assertEqual([key for key in mesh.keys() if key.startswith("motus_")], [])
        self.assertFalse(mesh.use_fake_user)

    def test_undo(self):
        self.open()
        bpy.ops.ed.undo_push(message="before")
        self.delete("Arm")
        bpy.ops.ed.undo_push(message="deleted")
        self.assertNotIn("Arm", bpy.data.objects)
        bpy.ops.ed.undo()
        self.assertIn("Arm", bpy.context.view_layer.objects)
        self.assert_moves()
