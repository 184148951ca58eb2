"""What is kept of viewports that were given other settings, until these are given back."""

import bpy

import support

OVERLAYS = "overlay.show_overlays"


def spaces():
    """Those of all 3D viewports, with overlays."""
    found = [area.spaces.active for screen in bpy.data.screens for area in screen.areas if area.type == 'VIEW_3D']
    for space in found:
        space.overlay.show_overlays = True
    return found


class Kept(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.viewports = support.addon("core.interface.view.viewports")
        self.addCleanup(self.viewports.PerViewport.of_all, self.viewports.PerViewport.clear)

    def camera(self, name):
        found = bpy.data.objects.new(name, bpy.data.cameras.new(name))
        bpy.context.scene.collection.objects.link(found)
        return found

    def test_settings_are_given_back(self):
        space = spaces()[0]
        self.viewports.change(space, {OVERLAYS: False})
        self.assertFalse(space.overlay.show_overlays)
        self.viewports.restore(space, {OVERLAYS: False})
        self.assertTrue(space.overlay.show_overlays)
        self.viewports.restore(space, {OVERLAYS: False})
        self.assertFalse(space.overlay.show_overlays)

    def test_a_viewport_of_another_file_is_another_one(self):
        """Sooner or later Blender gives one the address that an earlier one had."""
        for _ in range(10):
            for space in spaces():
                self.viewports.change(space, {OVERLAYS: False})
            support.empty_scene()
            for space in spaces():
                self.viewports.restore(space, {OVERLAYS: False})
                self.assertFalse(space.overlay.show_overlays)

    def test_viewports_that_stay_when_a_file_is_opened_are_the_same(self):
        path, space = self.save(), spaces()[0]
        address = space.as_pointer()
        self.viewports.change(space, {OVERLAYS: False})
        bpy.ops.wm.open_mainfile(filepath=path, load_ui=False)
        there = {space.as_pointer(): space for space in spaces()}
        self.assertIn(address, there)
        self.viewports.restore(there[address], {OVERLAYS: False})
        self.assertTrue(there[address].overlay.show_overlays)

    def test_a_viewport_of_its_own_camera(self):
        one, other = self.camera("One"), self.camera("Other")
        space = spaces()[0]
        space.use_local_camera, space.camera = True, one
        self.viewports.change(space, {"camera": other})
        self.assertEqual({obj.name for obj in bpy.data.objects}, {"One", "Other"})
        self.viewports.restore(space, {"camera": None})
        self.assertEqual(space.camera, one)
        self.viewports.change(space, {"camera": other})
        bpy.data.objects.remove(one)
        self.viewports.restore(space, {"camera": other})
        self.assertIsNone(space.camera)
