"""Driven properties in other files and other Blenders: reopened, appended, linked, overridden, damaged, without the add-on."""

import json

import bpy

import support
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

    @staticmethod
    def problem(owner):
        return wiring.problem(SYSTEM, owner, bpy.context.evaluated_depsgraph_get())
