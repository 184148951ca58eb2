"""Copied settings and keys on library overrides: they arrive, and are there when the file is opened again; linked owners are refused."""

import bpy

import support


class OnOverrides(support.SceneTestCase):
    def new_library(self):
        """A library file with two balls, whose dynamics differ, of which One has keys of a setting; returns its path."""
        for name, frequency in (("One", 3.25), ("Two", 1.5)):
            support.link(name)
            bpy.ops.motus.dynamics_add(object=name)
            bpy.data.objects[name].motus.dynamics.entries[0].frequency = frequency
        for frame, weight in ((1, 0.25), (11, 0.75)):
            entry = bpy.data.objects["One"].motus.dynamics.entries[0]
            entry.weight = weight
            entry.keyframe_insert("weight", frame=frame)
        return self.save("library.blend")

    def copied(self):
        """The text of One's settings."""
        bpy.ops.motus.settings_copy(object="One", system="dynamics")
        return support.addon("core.interface.any_system.copying")._WITHOUT_CLIPBOARD.find("")

    def opened_again(self):
        bpy.ops.wm.open_mainfile(filepath=self.save("shot.blend"))
        bpy.context.view_layer.update()

    def check(self):
        two = bpy.data.objects["Two"]
        self.assertIsNotNone(two.override_library)
        self.assertEqual(two.motus.dynamics.entries[0].frequency, 3.25)
        curve = support.addon("core.blender.actions").find(two, "motus.dynamics.entries[0].weight")
        self.assertEqual([tuple(point.co) for point in curve.keyframe_points], [(1.0, 0.25), (11.0, 0.75)])
        support.go_to(6)
        self.assertAlmostEqual(two.motus.dynamics.entries[0].weight, curve.evaluate(6.0), places=6)

    def test_pasted_settings_and_keys_stay(self):
        path = self.new_library()
        text = self.copied()
        linked = self.load(path, True, "Two")
        self.assertRefused("linked", bpy.ops.motus.settings_paste, object="Two", system="dynamics", text=text)
        linked.override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        bpy.ops.motus.settings_paste(object="Two", system="dynamics", text=text, with_keys=True, with_shot=True)
        self.check()
        self.opened_again()
        self.check()

    def test_keys_of_the_library_are_replaced_on_the_override_alone(self):
        path = self.new_library()
        bpy.data.objects["Two"].motus.dynamics.entries[0].keyframe_insert("weight", frame=5)
        path = self.save("library.blend")
        text = self.copied()
        self.load(path, True, "Two").override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        linked = next(action for action in bpy.data.actions if action.library)
        bpy.ops.motus.settings_paste(object="Two", system="dynamics", text=text, with_keys=True, with_shot=True)
        self.check()
        self.assertIsNotNone(linked.library)
        self.assertIsNone(bpy.data.objects["Two"].animation_data.action.library)
        self.opened_again()
        self.check()

    def test_to_all_selected(self):
        path = self.new_library()
        linked = [self.load(path, True, "One", "Two"), bpy.data.objects["Two"]]
        for obj in linked:
            obj.override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        one, two = (next(obj for obj in bpy.data.objects if obj.name == name and obj.override_library) for name in ("One", "Two"))
        for obj in (one, two):
            obj.select_set(True)
        bpy.context.view_layer.objects.active = one
        bpy.ops.motus.to_selected(system="dynamics", with_keys=True, with_shot=True)
        self.check()
        self.opened_again()
        self.check()

    def test_settings_without_a_list(self):
        curve = support.link("Curve", bpy.data.curves.new("Curve", 'CURVE'))
        curve.data.splines.new('POLY').points.add(1)
        curve.data.splines[0].points[1].co = (10.0, 0.0, 0.0, 1.0)
        for name in ("One", "Two"):
            support.link(name)
            bpy.ops.motus.path_follow_add(object=name, curve="Curve")
        bpy.data.objects["One"].motus.path.speed = 7.5
        bpy.ops.motus.settings_copy(object="One", system="path")
        text = support.addon("core.interface.any_system.copying")._WITHOUT_CLIPBOARD.find("")
        self.load(self.save("library.blend"), True, "Two").override_create(remap_local_usages=True)
        bpy.context.view_layer.update()
        bpy.ops.motus.settings_paste(object="Two", system="path", text=text)
        self.assertEqual(bpy.data.objects["Two"].motus.path.speed, 7.5)
        self.opened_again()
        self.assertEqual(bpy.data.objects["Two"].motus.path.speed, 7.5)
