"""Solvers run in threads of Blender's, while the main thread may edit the file's collections."""

from unittest import mock

import bpy

import support
from snow.cover_cases import FALLING, CoverTestCase
from support import go_to


class Collections(CoverTestCase):
    def scenery(self):
        """A collection with a mesh, and an empty that instances a collection with another one."""
        scenery, part = (bpy.data.collections.new(name) for name in ("Scenery", "Part"))
        bpy.context.scene.collection.children.link(scenery)
        scenery.objects.link(self.square())
        part.objects.link(self.square("Roof", (0.0, 0.0, 1.0)))
        empty = bpy.data.objects.new("Instance", None)
        empty.instance_type, empty.instance_collection = 'COLLECTION', part
        scenery.objects.link(empty)
        return scenery

    def test_solvers_go_through_evaluated_ones(self):
        scenery = self.scenery()
        emitter = self.add(**FALLING | {"colliders": scenery.name})
        cover = self.cover("", collection=scenery.name)
        go_to(60)
        gathered, asked = support.addon("core.scenery.gathered"), []
        meshes = gathered.meshes

        def noted(collection, *arguments):
            asked.append((collection.name, collection.is_evaluated))
            return meshes(collection, *arguments)

        with mock.patch.object(gathered, "meshes", noted):
            go_to(61)
        self.assertEqual(set(asked), {("Scenery", True), ("Part", True)})
        self.assertEqual(self.sentence(emitter), "")
        self.assertEqual(self.cover_sentence(cover), "")
        self.assertGreater(self.output(cover, "volume"), 0.0)
