"""The plane that shows the result of a chroma key in front of the camera."""

import bpy
import numpy as np

import support
from chroma import chroma_cases as cases
from chroma.chroma_setup_cases import SetUpTestCase, footage

compositor = support.addon("chroma.compositor")


class Plane(SetUpTestCase):
    def test_plane_fills_the_view(self):
        scene = bpy.context.scene
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(camera)
        camera.location, camera.rotation_euler = (1.0, 2.0, 3.0), (0.5, 0.2, 1.0)
        for kind in ('PERSP', 'ORTHO'):
            camera.data.type = kind
            self.set_up(clip=footage(self.folder), use_plane=True, camera="Camera", plane_distance=7.0)
            plane = scene.motus.chroma.plane
            bpy.context.view_layer.update()
            from bpy_extras.object_utils import world_to_camera_view

            seen = [world_to_camera_view(scene, camera, plane.matrix_world @ vertex.co) for vertex in plane.data.vertices]
            np.testing.assert_allclose(sorted((round(p.x), round(p.y)) for p in seen), [(0, 0), (0, 1), (1, 0), (1, 1)])
            np.testing.assert_allclose([p.z for p in seen], 7.0, rtol=1e-5)
            np.testing.assert_allclose([(p.x - round(p.x), p.y - round(p.y)) for p in seen], 0.0, atol=1e-5)
            self.assertTrue(plane.hide_render)
            self.assertGreater(plane.data.polygons[0].normal.z, 0.99)
            bpy.ops.motus.chroma_key_remove()

    def test_plane_ignores_a_keyed_scale(self):
        """As a render does, which takes the camera's axes at length 1: the plane stands where that of a camera without a scale does."""
        scene = bpy.context.scene
        parent, camera = bpy.data.objects.new("Crane", None), bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        for obj in (parent, camera):
            scene.collection.objects.link(obj)
        camera.parent, parent.rotation_euler.z = parent, 0.7
        camera.location, camera.rotation_euler = (1.0, 2.0, 3.0), (0.5, 0.2, 1.0)
        self.set_up(clip=footage(self.folder), use_plane=True, camera="Camera", plane_distance=7.0)
        plane = scene.motus.chroma.plane
        for obj, scales in (
            (camera, {1: (1.0, 1.0, 1.0), 9: (3.0, 0.5, 2.0), 17: (-1.0, 1.0, 4.0)}),
            (parent, {1: (2.0,) * 3, 17: (0.25,) * 3}),
        ):
            for frame, scale in scales.items():
                obj.scale = scale
                obj.keyframe_insert("scale", frame=frame)
        corners = np.array([vertex.co for vertex in plane.data.vertices])
        np.testing.assert_allclose(corners[:, 2], -7.0, rtol=1e-6)
        for frame in (17, 5, 9, 1):
            scene.frame_set(frame)
            seen = np.array(plane.matrix_world)
            axes = np.array(camera.matrix_world)[:3, :3]
            wanted = np.column_stack((axes / np.linalg.norm(axes, axis=0), camera.matrix_world.translation))
            np.testing.assert_allclose(seen[:3], wanted, atol=2e-6)

    def test_plane_has_the_key(self):
        """Its material shows the footage, and follows the colour and the levels when the screen is measured."""
        scene = bpy.context.scene
        scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(scene.camera)
        key = self.set_up(clip=footage(self.folder), use_plane=True, color=(0.1, 0.3, 0.2), black=0.5)
        plane = scene.motus.chroma.plane
        shown = plane.data.materials[0].node_tree.nodes
        self.assertEqual(plane.parent, scene.camera)
        (texture,) = [node for node in shown if node.type == 'TEX_IMAGE']
        self.assertEqual(texture.image, compositor.node_of(scene, "Footage").image)
        np.testing.assert_allclose(shown["Screen Color"].outputs[0].default_value[:3], (0.1, 0.3, 0.2), atol=1e-6)
        self.assertAlmostEqual(shown["Levels"].inputs["From Min"].default_value, 0.5)
        self.assertEqual(bpy.ops.motus.chroma_key_measure(), {'FINISHED'})
        np.testing.assert_allclose(shown["Screen Color"].outputs[0].default_value[:3], cases.GREEN, atol=0.01)
        for name, keyword in (("From Min", "black"), ("From Max", "white")):
            self.assertAlmostEqual(shown["Levels"].inputs[name].default_value, self.value(key, keyword), 5)

    def test_plane_that_was_deleted(self):
        bpy.context.scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        self.set_up(clip=footage(self.folder), use_plane=True)
        bpy.data.objects.remove(bpy.context.scene.motus.chroma.plane)
        self.assertEqual(bpy.ops.motus.chroma_key_measure(), {'FINISHED'})
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
