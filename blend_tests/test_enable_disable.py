"""Disabling the add-on leaves nothing of it behind, however often it is enabled."""

import unittest
from unittest import mock

import bpy
import support

OWNERS = ("Object", "Scene", "Camera", "Curve", "Mesh", "Material", "PoseBone", "Bone", "Collection", "WindowManager")


def handlers():
    lists = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {name: len(found) for name, found in lists.items() if isinstance(found, list)}


def keymap_items():
    keyconfigs = bpy.context.window_manager.keyconfigs
    return {
        (config.name, keymap.name): len(keymap.keymap_items)
        for config in keyconfigs for keymap in config.keymaps if len(keymap.keymap_items)}


def properties():
    return {owner: sorted(getattr(bpy.types, owner).bl_rna.properties.keys()) for owner in OWNERS}


def classes():
    bases = (bpy.types.Operator, bpy.types.Panel, bpy.types.Menu, bpy.types.PropertyGroup, bpy.types.UIList,
             bpy.types.AddonPreferences, bpy.types.Gizmo, bpy.types.GizmoGroup)
    return sorted(
        f"{cls.__module__}.{cls.__name__}" for base in bases for cls in base.__subclasses__()
        if getattr(cls, "is_registered", False) and support.module_name() in cls.__module__)


def operators():
    return sorted(dir(bpy.ops.motus))


def menu_draw_functions():
    """How many functions the add-ons have appended to each menu, panel and header."""
    types = [getattr(bpy.types, name, None) for name in dir(bpy.types)]
    return {cls.__name__: len(cls.draw._draw_funcs)
            for cls in types if hasattr(getattr(cls, "draw", None), "_draw_funcs") and len(cls.draw._draw_funcs) > 1}


def driver_functions():
    return sorted(name for name in bpy.app.driver_namespace if name.startswith("motus"))


def everything():
    return {
        "handlers": handlers(), "keymap items": keymap_items(), "properties": properties(), "classes": classes(),
        "operators": operators(), "menus": menu_draw_functions(), "driver functions": driver_functions(),
    }


class EnableDisable(unittest.TestCase):
    def tearDown(self):
        support.enable()

    def test_nothing_is_left_after_three_times(self):
        support.disable()
        before = everything()
        for _ in range(3):
            support.enable()
            support.disable()
            after = everything()
            for what, found in before.items():
                self.assertEqual(after[what], found, what)

    def test_enabling_twice_is_the_same_as_once(self):
        once = everything()
        for _ in range(2):
            support.disable()
            support.enable()
        for what, found in once.items():
            self.assertEqual(everything()[what], found, what)

    def test_enabled_shows_what_disabled_does_not(self):
        """The counts above would also agree if they saw nothing."""
        enabled = everything()
        support.disable()
        disabled = everything()
        for what in ("handlers", "properties", "classes", "operators", "menus"):
            self.assertNotEqual(enabled[what], disabled[what], what)
        self.assertEqual(disabled["classes"], [])

    def test_every_draw_handler_is_removed(self):
        """Blender has no list of its draw handlers, so the calls are recorded on their way to it."""
        space = bpy.types.SpaceView3D
        add, remove = space.draw_handler_add, space.draw_handler_remove
        added, removed = [], []

        def record_add(*arguments):
            added.append(add(*arguments))
            return added[-1]

        def record_remove(handle, region):
            removed.append(handle)
            remove(handle, region)

        support.disable()
        with mock.patch.object(space, "draw_handler_add", record_add), \
                mock.patch.object(space, "draw_handler_remove", record_remove):
            for _ in range(3):
                support.enable()
                support.disable()
        self.assertEqual(len(added), 3)
        self.assertEqual(removed, added)

    def test_translations_can_be_registered_again(self):
        """Registering a second catalogue under the same name fails where the first was left behind."""
        translations = support.addon("core.translations")
        with self.assertRaises(ValueError):
            translations.register()
        support.disable()
        translations.register()
        translations.unregister()
