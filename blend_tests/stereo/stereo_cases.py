"""Shared by the tests of stereo rigs: cameras, rigs, and squares at known places."""

import math

import bpy
import numpy as np

import support

LENS, SENSOR = 35.0, 36.0


def native():
    return support.addon("core.native").module


def camera(name="Camera", place=(0.0, 0.0, 0.0)):
    """A camera of 35 mm that looks along Y."""
    data = bpy.data.cameras.new(name)
    data.lens, data.sensor_width = LENS, SENSOR
    obj = bpy.data.objects.new(name, data)
    obj.location, obj.rotation_euler = place, (math.pi / 2.0, 0.0, 0.0)
    scene = bpy.context.scene
    scene.collection.objects.link(obj)
    scene.camera = scene.camera or obj
    bpy.context.view_layer.objects.active = obj
    bpy.context.view_layer.update()
    return obj


def square(name, place, size=0.1, color=None):
    """A square that faces the camera, and shines in a colour if one is given."""
    half = 0.5 * size
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-half, 0.0, -half), (half, 0.0, -half), (half, 0.0, half), (-half, 0.0, half)], [], [(0, 1, 2, 3)])
    obj = bpy.data.objects.new(name, mesh)
    obj.location = place
    bpy.context.scene.collection.objects.link(obj)
    if color:
        mesh.materials.append(_shining(name, color))
    return obj


def _shining(name, color):
    material = bpy.data.materials.new(name)
    if not material.use_nodes:
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    emission, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    emission.inputs["Color"].default_value = (*color, 1.0)
    links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def eyes(obj):
    """(interocular, convergence) of the camera as evaluated: what Blender renders with."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    stereo = obj.evaluated_get(depsgraph).data.stereo
    return stereo.interocular_distance, stereo.convergence_distance


class StereoTestCase(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        bpy.context.scene.frame_set(1)

    def add(self, **keywords):
        """The camera of a new rig."""
        obj = bpy.data.objects.get(keywords.get("object", "Camera")) or camera()
        self.assertEqual(bpy.ops.motus.stereo_rig_add(**{"object": obj.name, **keywords}), {'FINISHED'})
        bpy.context.view_layer.update()
        return obj

    def assert_eyes(self, obj, interocular, convergence):
        np.testing.assert_allclose(eyes(obj), (interocular, convergence), rtol=2e-6)
