"""Pins in files: saved, reopened, appended, linked, overridden, copied, and without the add-on."""

import json

import bpy
import numpy as np

import support
from pull.pins import pin_cases as cases
from pull.pins.pin_cases import add, basis, centre, evaluated, vertex_at
from support import go_to

BARE = """
import bpy, json
bpy.ops.wm.open_mainfile(filepath={path!r}, use_scripts={use_scripts})
bpy.context.scene.frame_set(6)
obj = bpy.data.objects["Grid"]
mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
print("RESULT " + json.dumps([max(vertex.co.z for vertex in mesh.vertices), len(mesh.vertices)]), flush=True)
"""


class FilesTest(cases.PinsTestCase):
    def pinned(self):
        grid = cases.new_grid()
        cases.key_strength(add(grid, centre(grid)), {1: 0.0, 11: 1.0})
        add(grid, vertex_at(grid, 0.5, 0.5), (0.2, 0.0, 0.4), radius=0.4, falloff='SPHERE')
        self.shapes = {}
        for frame in (6, 11, 2.5):
            go_to(frame)
            self.shapes[frame] = evaluated(grid).copy()
        return grid

    def assert_same(self, obj):
        for frame in (11, 6, 2.5, 6):
            go_to(frame)
            self.assert_bits(evaluated(obj), self.shapes[frame])

    def test_saved_and_opened(self):
        self.pinned()
        path = self.save()
        for use_scripts in (True, False):
            with self.subTest(use_scripts=use_scripts):
                bpy.ops.wm.open_mainfile(filepath=path, use_scripts=use_scripts)
                self.assert_same(bpy.data.objects["Grid"])

    def test_the_hub_is_empty_in_the_file(self):
        grid = self.pinned()
        self.assertEqual(len(grid.motus.pull.hub.data.vertices), 0)

    def test_without_the_addon_the_mesh_stands_as_it_is(self):
        self.pinned()
        path = self.save()
        for use_scripts in (True, False):
            with self.subTest(use_scripts=use_scripts):
                status, output = support.run_beside(BARE.format(path=path, use_scripts=use_scripts), enabled=False)
                self.assertEqual(status, 0, output)
                line = next(line for line in output.splitlines() if line.startswith("RESULT "))
                self.assertEqual(json.loads(line.removeprefix("RESULT ")), [0.0, 441])

    def test_a_fresh_blender_with_the_addon(self):
        self.pinned()
        path = self.save()
        status, output = support.run_beside(BARE.format(path=path, use_scripts=False))
        self.assertEqual(status, 0, output)
        line = next(line for line in output.splitlines() if line.startswith("RESULT "))
        height, count = json.loads(line.removeprefix("RESULT "))
        self.assertEqual(count, 441)
        self.assertAlmostEqual(height, float(self.shapes[6][:, 2].max()), places=6)

    def test_the_addon_disabled_and_enabled(self):
        grid = self.pinned()
        support.disable()
        self.addCleanup(support.enable)
        bpy.context.view_layer.update()
        support.enable()
        bpy.context.view_layer.update()
        bpy.ops.wm.open_mainfile(filepath=self.save())
        self.assert_same(bpy.data.objects["Grid"])
        del grid

    def test_appended(self):
        self.pinned()
        grid = self.load(self.save(), False, "Grid")
        self.assert_same(grid)
        bpy.ops.motus.pin_remove(object="Grid", all=True)
        self.assertEqual(len(grid.modifiers), 0)
        self.assertEqual((len(bpy.data.objects), len(bpy.data.meshes)), (1, 1))

    def test_linked(self):
        self.pinned()
        grid = self.load(self.save(), True, "Grid")
        self.assert_same(grid)
        self.assertEqual(len(grid.motus.pull.hub.data.vertices), 0)
        with self.assertRaisesRegex(RuntimeError, "linked from another file"):
            bpy.ops.motus.pin_add(object="Grid", vertex=0)

    def test_overridden(self):
        self.pinned()
        linked = self.load(self.save(), True, "Grid")
        grid = linked.override_create(remap_local_usages=True)
        self.assert_same(grid)
        self.assertIsNone(grid.motus.pull.hub.library)
        grid.motus.pull.pins[1].strength = 0.0
        root = centre(grid)
        go_to(11)
        wanted = cases.pulled(basis(grid), root, (0.0, 0.0, 1.0))
        self.assert_shape(grid, wanted)
        bpy.ops.wm.open_mainfile(filepath=self.save("over.blend"))
        grid = next(obj for obj in bpy.data.objects if obj.override_library)
        go_to(6)
        go_to(11)
        self.assert_shape(grid, wanted)

    def test_a_pin_on_a_linked_mesh(self):
        grid = cases.new_grid()
        path = self.save()
        del grid
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.meshes = ["Grid"]
        grid = bpy.data.objects.new("Own", wanted.meshes[0])
        bpy.context.scene.collection.objects.link(grid)
        bpy.context.view_layer.objects.active = grid
        root = centre(grid)
        add(grid, root)
        self.assertEqual(grid.motus.pull.pins[0].anchor, 0)
        self.assert_shape(grid, cases.pulled(basis(grid), root, (0.0, 0.0, 1.0)))

    def test_copied_with_and_without_its_mesh(self):
        grid = self.pinned()
        for name, copies_mesh in (("Linked", False), ("Full", True)):
            with self.subTest(name):
                copy = grid.copy()
                copy.name = name
                if copies_mesh:
                    copy.data = grid.data.copy()
                bpy.context.scene.collection.objects.link(copy)
                self.assert_same(copy)
                self.assertNotEqual(copy.motus.pull.hub, grid.motus.pull.hub)
                copy.motus.pull.pins[1].is_muted = True
                go_to(11)
                self.assertGreater(np.abs(evaluated(copy) - self.shapes[11]).max(), 0.3)
                self.assert_bits(evaluated(grid), self.shapes[11])

    def test_duplicated_by_the_operator(self):
        grid = self.pinned()
        bpy.ops.object.select_all(action='DESELECT')
        grid.select_set(True)
        bpy.context.view_layer.objects.active = grid
        bpy.ops.object.duplicate()
        copy = bpy.context.object
        self.assertNotEqual(copy, grid)
        self.assert_same(copy)
        bpy.ops.object.delete()
        self.assert_same(grid)
