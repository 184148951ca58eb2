"""Driven properties in other files and other Blenders: reopened, appended, linked, overridden, damaged, without the add-on."""

import json

import bpy

import support
import toy_dial_system
import toy_system
from core.wiring.property_cases import FRAMES, SYSTEM, PropertyTestCase, build, places, property_sink, shown, values
from core.wiring.wiring_cases import frame_set

wiring = support.addon("core.wiring")
MARK = "RESULT "


def rows():
    """The properties at all FRAMES."""
    found = []
    for frame in FRAMES:
        frame_set(frame)
        found.append(values(bpy.data.objects["Owner"]))
    return found


class OtherObjectTest(PropertyTestCase):
    """An owner that drives a property of another object, and nothing else of it."""

    def setUp(self):
        super().setUp()
        self.owner, self.other = toy_system.new_object("Owner"), toy_system.new_object("Other")
        self.other["custom"] = 0.25
        self.target = toy_system.new_target()
        toy_dial_system.dial(self.owner, self.target, (self.other, '["custom"]', -1))
        frame_set(2)

    def select(self, *objects):
        for obj in bpy.context.view_layer.objects:
            obj.select_set(obj in objects)
        bpy.context.view_layer.objects.active = objects[0]

    def duplicate(self, *objects):
        self.select(*objects)
        bpy.ops.object.duplicate()
        bpy.context.view_layer.update()

    def delete_owner_and_reopen(self):
        self.select(self.owner)
        bpy.ops.object.delete()
        bpy.context.view_layer.update()
        path = str(self.folder / "deleted.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        frame_set(3)
        self.assertNotIn("Owner", bpy.data.objects)
        return bpy.data.objects["Other"]

    def shown(self, obj):
        return support.evaluated(obj)["custom"]

    def test_copied_along_with_it(self):
        self.duplicate(self.owner, self.other)
        owner, other = bpy.data.objects["Owner.001"], bpy.data.objects["Other.001"]
        self.assertEqual(owner.motus.dial.entries[0].thing, other)
        self.assertIsNone(self.problem(owner))
        owner.motus.dial.target = target = toy_system.new_object("Far", location=(5.0, 0.0, 0.0))
        frame_set(3)
        self.assertAlmostEqual(self.shown(other), toy_dial_system.shown(target.matrix_world, 0), places=6)
        self.assertAlmostEqual(self.shown(self.other), toy_dial_system.shown(support.evaluated(self.target).matrix_world, 0), places=6)
        wiring.detach(SYSTEM, owner)
        self.assertEqual(other["custom"], 0.25)

    def test_deleted_owner_gives_it_back(self):
        other = self.delete_owner_and_reopen()
        self.assertFalse(other.animation_data and other.animation_data.drivers)
        self.assertEqual(self.shown(other), 0.25)
        self.assertEqual([one.name for one in bpy.data.meshes], [])

    def test_removed_owner_gives_it_back(self):
        """Removed from the file by a script."""
        bpy.data.objects.remove(self.owner)
        path = str(self.folder / "removed.blend")
        for _ in range(2):  # Blender writes a mesh that only an unused object uses; its users are counted again when it is read
            bpy.ops.wm.save_as_mainfile(filepath=path)
            bpy.ops.wm.open_mainfile(filepath=path)
        other = bpy.data.objects["Other"]
        self.assertFalse(other.animation_data and other.animation_data.drivers)
        self.assertEqual(self.shown(other), 0.25)
        self.assertEqual([one.name for one in bpy.data.meshes], [])

    def test_a_copy_of_a_deleted_owner_takes_over(self):
        self.duplicate(self.owner)
        self.assertIsNotNone(self.problem(bpy.data.objects["Owner.001"]))
        other = self.delete_owner_and_reopen()
        owner = bpy.data.objects["Owner.001"]
        self.assertIsNone(self.problem(owner))
        owner.motus.dial.target.location.x = 7.0
        frame_set(4)
        self.assertAlmostEqual(
            self.shown(other), toy_dial_system.shown(support.evaluated(owner.motus.dial.target).matrix_world, 0), places=6
        )


class FileTest(PropertyTestCase):
    def save(self, name="dial"):
        path = str(self.folder / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        return path

    def bring(self, path, link):
        support.empty_scene()
        with bpy.data.libraries.load(path, link=link) as (_, wanted):
            wanted.objects = ["Owner"]
        bpy.context.scene.collection.objects.link(wanted.objects[0])
        frame_set(2)
        return wanted.objects[0]

    def test_saved_and_reopened(self):
        build()
        live = rows()
        path = self.save()
        self.assertEqual(rows(), live)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assertEqual(rows(), live)
        self.assertIsNone(self.problem(bpy.data.objects["Owner"]))
        wiring.detach(SYSTEM, bpy.data.objects["Owner"])
        self.assertFalse([one for one in places(bpy.data.objects["Owner"]) if one.driver])

    def test_without_the_add_on_the_own_values_show(self):
        owner = build()
        own = self.own_values(owner)
        path = self.save()
        read = [
            f"{'owner' if entry.path.startswith('[') else 'owner.'}{entry.path}" + (f"[{entry.index}]" if entry.index >= 0 else "")
            for entry in list(owner.motus.dial.entries)[:-1]
        ]
        code = "\n".join(
            (
                "import json, bpy",
                f"bpy.ops.wm.open_mainfile(filepath={path!r})",
                f"for frame in {FRAMES!r}:",
                "    bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))",
                "    graph = bpy.context.evaluated_depsgraph_get()",
                "    owner, camera = (bpy.data.objects[name].evaluated_get(graph) for name in ('Owner', 'Camera'))",
                f"    print({MARK!r} + json.dumps([{', '.join(read)}, camera.data.shift_x]))",
            )
        )
        status, output = support.run_beside(code, enabled=False)
        self.assertEqual(status, 0, output)
        found = [json.loads(part.splitlines()[0]) for part in output.split(MARK)[1:]]
        self.assertEqual(len(found), len(FRAMES))
        for frame, values_there in zip(FRAMES, found):
            self.assert_close(values_there, own[frame], 1e-6)

    def test_appended(self):
        build()
        live = rows()
        self.bring(self.save(), link=False)
        self.assertEqual(rows(), live)

    def test_linked(self):
        build()
        live = rows()
        owner = self.bring(self.save(), link=True)
        self.assertTrue(owner.library)
        self.assertEqual(rows(), live)
        self.save("linking")
        bpy.ops.wm.open_mainfile(filepath=str(self.folder / "linking.blend"))
        self.assertEqual(rows(), live)
        bpy.data.libraries[0].reload()
        frame_set(1)
        self.assertEqual(rows(), live)

    def test_overridden(self):
        build()
        live = rows()
        linked = self.bring(self.save(), link=True)
        owner = linked.override_create(remap_local_usages=True)
        frame_set(2)
        frame_set(3)
        self.assert_close(values(owner)[:3], shown(owner)[:3], 1e-6)
        self.save("override")
        bpy.ops.wm.open_mainfile(filepath=str(self.folder / "override.blend"))
        owner = next(obj for obj in bpy.data.objects if obj.override_library)
        frame_set(3)
        frame_set(10)
        self.assert_close(values(owner)[:3], live[0][:3], 1e-6)

    def test_damaged(self):
        for value in ("", "[", "[[1,2]]", 3, [1.0], '[[99,"location",0,1.0]]', '[[2,"nothing",-1,1.0]]', "[" * 4000):
            with self.subTest(value):
                support.empty_scene()
                owner = build()
                owner.motus.dial.hub.data[property_sink.KEY] = value
                owner.motus.dial.hub.data.update_tag()
                for frame in (1, 7):
                    frame_set(frame)
                self.assertIsNotNone(self.problem(owner))
                self.save()
                wiring.refresh(SYSTEM, owner)
                self.assert_shown(owner)

    def test_undo(self):
        owner = build()
        bpy.ops.ed.undo_push(message="built")
        frame_set(3)
        wiring.detach(SYSTEM, owner)
        bpy.ops.ed.undo_push(message="removed")
        bpy.ops.ed.undo()
        self.assert_shown(bpy.data.objects["Owner"])
        bpy.ops.ed.redo()
        frame_set(5)
        self.assertFalse([one for one in places(bpy.data.objects["Owner"]) if one.driver])
