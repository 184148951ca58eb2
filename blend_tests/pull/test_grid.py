"""motus.grid_add."""

import math

import bpy
import numpy as np

from pull.pull_cases import PullTestCase


class Grid(PullTestCase):
    def add(self, **keywords):
        self.assertEqual(bpy.ops.motus.grid_add(**keywords), {'FINISHED'})
        return bpy.context.object

    def test_vertices_are_centred_and_flat(self):
        obj = self.add(width=5, height=3, spacing=0.5)
        places = self.places(obj)
        self.assertEqual(len(places), 15)
        self.assertNear(sorted(set(places[:, 0].tolist())), (-1.0, -0.5, 0.0, 0.5, 1.0))
        self.assertNear(sorted(set(places[:, 1].tolist())), (-0.5, 0.0, 0.5))
        self.assertNear(places[:, 2], np.zeros(15), 0.0)
        self.assertNear(places.mean(axis=0), np.zeros(3))
        self.assertEqual(tuple(obj.location), (0.0, 0.0, 0.0))

    def test_faces_and_edges(self):
        mesh = self.add(width=5, height=3).data
        self.assertEqual((len(mesh.polygons), len(mesh.edges), len(mesh.loops)), (8, 22, 32))
        self.assertFalse(mesh.validate(verbose=False), "Blender had to mend it")
        for face in mesh.polygons:
            self.assertEqual(face.loop_total, 4)
            self.assertNear(face.normal, (0.0, 0.0, 1.0))
            self.assertTrue(face.use_smooth)
            for index in face.loop_indices:
                loop, following = mesh.loops[index], mesh.loops[face.loop_start + (index - face.loop_start + 1) % 4]
                self.assertEqual(set(mesh.edges[loop.edge_index].vertices), {loop.vertex_index, following.vertex_index})

    def test_size_and_flat_shading(self):
        obj = self.add(width=4, height=7, sizing='SIZE', size=(6.0, 2.0), use_smooth=False, use_uv=False)
        self.assertNear(obj.dimensions, (6.0, 2.0, 0.0))
        self.assertFalse(any(face.use_smooth for face in obj.data.polygons))
        self.assertEqual(len(obj.data.uv_layers), 0)

    def test_uv_follows_the_grid(self):
        mesh = self.add(width=5, height=3, spacing=0.5).data
        for loop, uv in zip(mesh.loops, mesh.uv_layers[0].data):
            place = mesh.vertices[loop.vertex_index].co
            self.assertNear(uv.uv, ((place.x + 1.0) / 2.0, (place.y + 0.5) / 1.0))

    def test_place_and_rotation(self):
        obj = self.add(location=(1.0, 2.0, 3.0), rotation=(0.0, 0.0, 1.0))
        self.assertNear(obj.location, (1.0, 2.0, 3.0))
        self.assertNear(obj.rotation_euler, (0.0, 0.0, 1.0))

    def test_into_the_mesh_that_is_edited(self):
        obj = self.plane(3)
        bpy.ops.object.mode_set(mode='EDIT')
        self.assertEqual(bpy.ops.motus.grid_add(width=4, height=4), {'FINISHED'})
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertEqual(len(obj.data.vertices), 9 + 16)

    def test_refusals(self):
        for keywords, part in (({"spacing": math.inf}, "spacing is not a finite"), ({"width": 100_000, "height": 100_000}, "do not fit")):
            with self.assertRaisesRegex(RuntimeError, part):
                bpy.ops.motus.grid_add(**keywords)
        self.assertEqual(len(bpy.data.objects), 0)

    def test_aligned_to_what_there_is(self):
        scene = bpy.context.scene
        scene.cursor.rotation_euler = 0.0, 0.0, 0.5
        for keywords in ({}, {"rotation": (0.1, 0.2, 0.3)}):
            with self.assertRaisesRegex(RuntimeError, "There is no 3D view to align to: choose another alignment"):
                bpy.ops.motus.grid_add(align='VIEW', **keywords)
            self.assertEqual(len(bpy.data.meshes), 0)
            self.assertNear(self.add(align='CURSOR', **keywords).rotation_euler, (0.0, 0.0, 0.5))
            bpy.data.meshes.remove(bpy.context.object.data)
        preferences = bpy.context.preferences.edit
        self.addCleanup(setattr, preferences, "object_align", preferences.object_align)
        preferences.object_align = 'VIEW'
        with self.assertRaisesRegex(RuntimeError, "no 3D view to align to"):
            bpy.ops.motus.grid_add()
        self.assertNear(self.add(rotation=(0.0, 0.0, 1.0), align='WORLD').rotation_euler, (0.0, 0.0, 1.0))
