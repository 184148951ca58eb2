"""Chains in files: opened again, linked, appended, copied and undone."""

import bpy
import numpy as np

import support
from chains import chain_cases as cases

FRAMES = (1, 15, 22.5, 40)


class ChainsFilesTest(support.SceneTestCase):
    def build(self):
        """A rig whose chain lies on a ball, and whose bones take on the lengths of their links."""
        rig = cases.rope(4)
        for bone in rig.data.bones:
            bone.inherit_scale = 'NONE'
        ball = support.link("Ball", location=cases.place(rig, 1, "Tail 0 0") + (0.05, 0.0, -0.5))
        ball.empty_display_type, ball.empty_display_size = 'SPHERE', 0.2
        collection = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(ball)
        cases.add(rig, frequency=0.5, stretch=0.05, squash=1.0, colliders=collection)
        return rig

    def seen(self, rig):
        return {frame: cases.matrix(rig, frame, "Tail 0 3") for frame in FRAMES}

    def assertSame(self, rig, wanted):
        for frame, found in self.seen(rig).items():
            np.testing.assert_array_equal(found, wanted[frame], f"{frame}")

    def test_opened_again(self):
        wanted = self.seen(self.build())
        bpy.ops.wm.open_mainfile(filepath=self.save())
        self.assertSame(bpy.data.objects["Rope"], wanted)

    def test_linked_and_appended(self):
        wanted = self.seen(self.build())
        path = self.save()
        for is_link in (True, False):
            rig = self.load(path, is_link, "Rope")
            bpy.context.view_layer.update()
            self.assertIsNone(cases.problem(rig))
            self.assertSame(rig, wanted)

    def test_a_copy_has_a_motion_of_its_own(self):
        rig = self.build()
        wanted = self.seen(rig)
        copy = rig.copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        copy.location.y += 5.0
        other = self.seen(copy)
        self.assertGreater(np.abs(other[22.5][:3, :3] - wanted[22.5][:3, :3]).max(), 0.01, "there is no ball")
        bpy.ops.motus.chains_remove(object=rig.name)
        for frame, found in self.seen(copy).items():
            np.testing.assert_array_equal(found, other[frame])

    def test_one_step_is_undone(self):
        rig = cases.rope(3)
        plain = self.seen_of("Tail 0 2")
        bpy.ops.ed.undo_push(message="before")
        cases.add(rig)
        bpy.ops.ed.undo_push(message="added")
        live = self.seen_of("Tail 0 2")
        bpy.ops.ed.undo()
        self.assertEqual(self.seen_of("Tail 0 2"), plain)
        bpy.ops.ed.redo()
        self.assertEqual(self.seen_of("Tail 0 2"), live)

    @staticmethod
    def seen_of(bone):
        return {frame: cases.matrix(bpy.data.objects["Rope"], frame, bone).tobytes() for frame in FRAMES}
