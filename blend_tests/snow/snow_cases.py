"""Shared by the tests of snow: adding it, its flakes as evaluated, and what the library says they are."""

import bpy
import numpy as np

import support

OFF_THE_FRAMES = (30, 1, 17, 60, 3.25, 24.5, 5, 100, 60, 30)
MANY = {"rate": 200.0, "lifetime": 1.5}
KINDS = {
    "position": ("vector", 3),
    "velocity": ("vector", 3),
    "tint": ("color", 4),
    "radius": ("value", 1),
    "age": ("value", 1),
    "id": ("value", 1),
}
"""Attribute -> (name of an item's property, how many numbers that has)."""


def native():
    return support.addon("core.native").module


def actions():
    return support.addon("core.blender.actions")


def wiring():
    return support.addon("core.wiring")


def system():
    return support.addon("snow").SYSTEM


def seconds(frame, start=1.0, fps=24.0):
    return (frame - start) / fps


def hub_mesh(emitter):
    """The evaluated mesh that holds the flakes, in world space."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return emitter.motus.snow.hub.evaluated_get(depsgraph).data


def flakes(emitter):
    """{attribute: array} of the flakes that there are: those attributes that they have."""
    mesh = hub_mesh(emitter)
    found = {}
    for name, (field, width) in KINDS.items():
        if name == "position":
            data, field = mesh.vertices, "co"
        elif len(mesh.vertices) and name not in mesh.attributes:
            continue
        else:
            data = mesh.attributes[name].data if len(mesh.vertices) else ()
        array = np.empty(width * len(data), np.int32 if name == "id" else np.float32)
        if len(data):
            data.foreach_get(field, array)
        found[name] = array.reshape(-1, width) if width > 1 else array
    return found


def state(emitter):
    """All flakes as bytes."""
    return b"".join(array.tobytes() for array in flakes(emitter).values())


def instances(emitter):
    """World matrices (n, 4, 4) of the instances that an emitter shows."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return np.array(
        [
            np.array(one.matrix_world)
            for one in depsgraph.object_instances
            if one.is_instance and one.object.type == 'MESH' and one.parent.original == emitter
        ]
    )


class SnowTestCase(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        bpy.context.scene.frame_set(1)

    def add(self, **keywords):
        """The emitter of new snow."""
        self.assertEqual(bpy.ops.motus.snow_add(**keywords), {'FINISHED'})
        return bpy.context.object

    def mesh(self, name, positions, faces, place=(0.0, 0.0, 0.0)):
        data = bpy.data.meshes.new(name)
        data.from_pydata(positions, [], faces)
        obj = bpy.data.objects.new(name, data)
        obj.location = place
        bpy.context.scene.collection.objects.link(obj)
        bpy.context.view_layer.update()
        return obj

    def sentence(self, emitter):
        bpy.context.view_layer.update()
        problem = wiring().problem(system(), emitter, bpy.context.evaluated_depsgraph_get())
        return problem.sentence if problem else ""
