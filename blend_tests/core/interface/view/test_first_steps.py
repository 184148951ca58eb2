"""The hint where to begin is shown to a user until it is hidden or an operator of Motus was used, and never again."""

import unittest
from unittest import mock

import bpy

import support

HIDE = """
import bpy, support
from unittest import mock
first_steps = support.addon("core.interface.view.first_steps")
with mock.patch.object(first_steps, "has_window", lambda: True):
    print("FIRST", first_steps.is_shown(bpy.context))
    bpy.ops.motus.hide_first_steps()
bpy.ops.wm.save_userpref()
"""
LATER = """
import bpy, support
first_steps = support.addon("core.interface.view.first_steps")
first_steps.has_window = lambda: True
print("LATER", first_steps.is_shown(bpy.context))
"""


class FirstStepsTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        if support.module_name() not in bpy.context.preferences.addons:  # `blender --addons` enables it without
            support.disable()
            support.enable()
        self.first_steps = support.addon("core.interface.view.first_steps")
        self.own = bpy.context.preferences.addons[support.module_name()].preferences
        self.addCleanup(setattr, self.own, "show_first_steps", False)
        self.own.show_first_steps = True

    def is_shown(self):
        return self.first_steps.is_shown(bpy.context)

    def in_a_window(self):
        """From now on this Blender counts as one with a window."""
        patch = mock.patch.object(self.first_steps, "has_window", lambda: True)
        patch.start()
        self.addCleanup(patch.stop)

    def test_scripts_without_a_window_neither_see_nor_hide_it(self):
        self.assertFalse(self.is_shown())
        bpy.ops.motus.hide_first_steps()
        self.assertTrue(self.own.show_first_steps)

    def test_hiding_it_is_kept_for_saving(self):
        self.in_a_window()
        self.assertTrue(self.is_shown())
        bpy.context.preferences.is_dirty = False
        bpy.ops.motus.hide_first_steps()
        self.assertFalse(self.is_shown())
        self.assertTrue(bpy.context.preferences.is_dirty)

    def test_whoever_has_used_motus_does_not_see_it(self):
        self.in_a_window()
        with self.assertRaises(RuntimeError):
            bpy.ops.motus.pendulum_add(object="nobody")
        self.assertTrue(self.is_shown())
        bpy.ops.motus.pendulum_add()
        self.assertFalse(self.is_shown())

    def test_without_preferences_of_the_add_on_it_is_not_shown(self):
        """Nothing could remember that it was hidden."""
        self.in_a_window()
        nothing = mock.Mock()
        nothing.preferences.addons = {}
        self.assertFalse(self.first_steps.is_shown(nothing))
        self.first_steps.hide(nothing)


@unittest.skipUnless(bpy.app.binary_path, "an official Blender that is a module of Python reads no preferences")
class LaterTest(support.SceneTestCase):
    def test_the_next_blender_does_not_show_it(self):
        profile = support.copy_profile(self.folder)
        for code, expected in ((HIDE, "FIRST True"), (LATER, "LATER False")):
            status, output = support.run_blender(code, profile, arguments=(), enabled=False)
            self.assertEqual(status, 0, output)
            self.assertIn(expected, output)
