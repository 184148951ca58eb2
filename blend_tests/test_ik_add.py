"""What is made along with a chain: controls that leave the pose as it is, wherever the rig stands."""

import bpy
import support
from ik_cases import IkTestCase


class OfAnOverride(IkTestCase):
    """Blender lets nobody put an object into a collection that is linked or overridden."""

    def overridden(self):
        """An override of a whole collection "Linked" with a rig, whose bones are those of an arm."""
        rig = self.arm()
        collection = bpy.data.collections.new("Linked")
        self.scene.collection.children.link(collection)
        collection.objects.link(rig)
        self.scene.collection.objects.unlink(rig)
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        support.empty_scene()
        self.scene = bpy.context.scene
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.collections = ["Linked"]
        self.scene.collection.children.link(wanted.collections[0])
        made = wanted.collections[0].override_hierarchy_create(self.scene, bpy.context.view_layer)
        bpy.context.view_layer.update()
        return made.objects["Rig"]

    def test_controls_go_into_the_scene(self):
        rig = self.overridden()
        before = self.poses(rig)
        entry = self.reach(target="", make_pole=True)
        for control in (entry.target, entry.pole):
            self.assertEqual(control.users_collection, (self.scene.collection,))
        self.assertSamePose(rig, before)

    def test_controls_go_into_a_collection_of_the_file(self):
        rig = self.overridden()
        own = bpy.data.collections.new("Own")
        self.scene.collection.children.link(own)
        own.objects.link(rig)
        self.assertEqual(self.reach(target="").target.users_collection, (own,))

    def test_target_of_a_head(self):
        rig = self.overridden()
        bpy.ops.motus.look_at_add(object="Rig", bone="Hand")
        target = rig.motus.look_at.entries[0].target
        self.assertEqual(target.users_collection, (self.scene.collection,))
