"""Disabling the add-on leaves nothing of it behind, however often it is enabled."""

import unittest
from unittest import mock

import bpy

import live_scenes
import support

OWNERS = ("Object", "Scene", "Camera", "Curve", "Mesh", "Material", "PoseBone", "Bone", "Collection", "WindowManager")


def handlers():
    lists = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {name: len(found) for name, found in lists.items() if isinstance(found, list)}


def keymap_items():
    keyconfigs = bpy.context.window_manager.keyconfigs
    return {
        (config.name, keymap.name): len(keymap.keymap_items)
        for config in keyconfigs
        for keymap in config.keymaps
        if len(keymap.keymap_items)
    }


def properties():
    return {owner: sorted(getattr(bpy.types, owner).bl_rna.properties.keys()) for owner in OWNERS}


def classes():
    bases = (
        bpy.types.Operator,
        bpy.types.Panel,
        bpy.types.Menu,
        bpy.types.PropertyGroup,
        bpy.types.UIList,
        bpy.types.AddonPreferences,
        bpy.types.Gizmo,
        bpy.types.GizmoGroup,
    )
    return sorted(
        f"{cls.__module__}.{cls.__name__}"
        for base in bases
        for cls in base.__subclasses__()
        if getattr(cls, "is_registered", False) and support.module_name() in cls.__module__
    )


def operators():
    return sorted(dir(bpy.ops.motus))


def menu_draw_functions():
    """How many functions the add-ons have appended to each menu, panel and header."""
    types = [getattr(bpy.types, name, None) for name in dir(bpy.types)]
    return {
        cls.__name__: len(cls.draw._draw_funcs)
        for cls in types
        if hasattr(getattr(cls, "draw", None), "_draw_funcs") and len(cls.draw._draw_funcs) > 1
    }


def driver_functions():
    return sorted(name for name in bpy.app.driver_namespace if name.startswith("motus"))


def everything():
    return {
        "handlers": handlers(),
        "keymap items": keymap_items(),
        "properties": properties(),
        "classes": classes(),
        "operators": operators(),
        "menus": menu_draw_functions(),
        "driver functions": driver_functions(),
        "manual maps": len(list(bpy.utils.manual_map())),
    }


class EnableDisable(unittest.TestCase):
    def tearDown(self):
        support.enable()

    def test_nothing_is_left_after_three_times(self):
        support.disable()
        before = everything()
        for _ in range(3):
            support.enable()
            with self.assertNoLogs(level="WARNING"):
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
        with mock.patch.object(space, "draw_handler_add", record_add), mock.patch.object(space, "draw_handler_remove", record_remove):
            for _ in range(3):
                support.enable()
                support.disable()
        self.assertEqual(len(added), 3 * 2)  # for lines, and for words
        self.assertCountEqual(removed, added)

    @support.needs_translations
    def test_translations_can_be_registered_again(self):
        """Registering a second catalogue under the same name fails where the first was left behind."""
        translations, languages = support.addon("core.translations"), support.addon("translations").LANGUAGES
        with self.assertRaises(ValueError):
            translations.register(languages)
        support.disable()
        translations.register(languages)
        translations.unregister()


class LiveSceneTest(support.SceneTestCase):
    """Scenes that were evaluated while the add-on was not there move again when it is."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        live_scenes.opened()
        cls.wanted = live_scenes.states()

    def setUp(self):
        super().setUp()
        self.addCleanup(support.enable)
        live_scenes.opened()

    def test_what_is_compared_moves(self):
        first, *later = self.wanted.values()
        still = first.keys() - set().union(*(support.differ(state, first, 1e-3, 1e-5) for state in later))
        self.assertEqual({name for name, _ in still} & {"Car", "Keyed", "Driven", "Engine", "Wagon 1", "Wagon 2", "Gauge", "Shadow"}, set())
        self.assertNotIn(("Arm", "Bone 1"), still)
        self.assertNotIn(("Figure", "Head"), still)
        self.assertNotIn(("Grid", "mesh"), still)
        self.assertNotIn(("Ball", "mesh"), still)

    def save(self, name="scene"):
        path = str(self.folder / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        return path

    def scrub(self):
        for frame in (7, 22, 3):
            bpy.context.scene.frame_set(frame)

    def assert_moves_as_before(self):
        for frame, found in live_scenes.states().items():
            self.assertEqual(support.differ(found, self.wanted[frame], 1e-6, 1e-7), set(), f"on frame {frame}")

    def test_disabled_scrubbed_and_enabled(self):
        before = everything()
        for _ in range(2):
            support.disable()
            self.scrub()
            support.enable()
            self.assert_moves_as_before()
        for what, found in before.items():
            self.assertEqual(everything()[what], found, what)

    def test_enabled_after_the_file_was_opened(self):
        path = self.save()
        support.disable()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.scrub()
        support.enable()
        self.assert_moves_as_before()

    def test_enabled_before_anything_was_evaluated(self):
        path = self.save()
        support.disable()
        bpy.ops.wm.open_mainfile(filepath=path)
        support.enable()
        self.assert_moves_as_before()

    def test_linked(self):
        path = self.save()
        support.empty_scene()
        support.disable()
        with bpy.data.libraries.load(path, link=True) as (found, wanted):
            wanted.scenes = found.scenes
        bpy.context.window.scene = wanted.scenes[0]
        self.scrub()
        support.enable()
        self.assert_moves_as_before()

    def test_keys_that_an_editor_has_switched_off(self):
        """Editors that list an F-curve switch it off where they do not find what it animates."""
        keyed = bpy.data.objects["Keyed"]
        support.disable()
        for curve in support.addon("core.blender.actions").fcurves(keyed):
            curve.is_valid = False
            self.assertFalse(curve.is_valid)
        self.scrub()
        support.enable()
        self.assert_moves_as_before()

    def test_others_drivers_are_left_alone(self):
        wrong = bpy.data.objects["Target"].driver_add("scale", 0).driver
        wrong.expression = "no_such_function()"
        bpy.context.view_layer.update()
        self.assertFalse(wrong.is_valid)
        support.disable()
        support.enable()
        self.assertFalse(wrong.is_valid)

    def test_nothing_is_left_of_a_scene_at_work(self):
        support.disable()
        before = everything()
        for _ in range(2):
            support.enable()
            live_scenes.states((5, 9))
            support.disable()
            for what, found in everything().items():
                self.assertEqual(found, before[what], what)


class ClearedTest(unittest.TestCase):
    """What other scripts have taken away already does not keep the add-on from being disabled, and enabled again."""

    def setUp(self):
        support.empty_scene()
        self.addCleanup(support.empty_scene)
        self.addCleanup(support.enable)
        self.enabled = everything()
        support.disable()
        self.disabled = everything()
        support.enable()

    def assert_goes_and_comes(self):
        support.disable()
        self.assertFalse(support.is_enabled())
        for what, found in everything().items():
            self.assertEqual(found, self.disabled[what], what)
        support.enable()
        for what, found in everything().items():
            self.assertEqual(found, self.enabled[what], what)

    def test_handlers(self):
        # Only ours: Blender's own add-ons cannot do without theirs.
        for name in handlers():
            functions = getattr(bpy.app.handlers, name)
            functions[:] = [one for one in functions if support.module_name() not in one.__module__]
        self.assertEqual(handlers(), self.disabled["handlers"])
        self.assert_goes_and_comes()

    def test_driver_functions(self):
        bpy.app.driver_namespace.clear()
        self.assert_goes_and_comes()

    def test_menu_entries(self):
        for name in ("VIEW3D_MT_add", "VIEW3D_MT_object", "VIEW3D_MT_pose"):
            draw = getattr(bpy.types, name).draw
            draw._draw_funcs[:] = [one for one in draw._draw_funcs if support.module_name() not in one.__module__]
        self.assert_goes_and_comes()

    def test_properties(self):
        del bpy.types.Object.motus
        del bpy.types.Scene.motus
        self.assert_goes_and_comes()

    def test_classes(self):
        for name in ("MOTUS_OT_path_follow_add", "MOTUS_PT_path", "MOTUS_MT_add"):
            cls = getattr(bpy.types, name, None)
            self.assertIsNotNone(cls, name)
            bpy.utils.unregister_class(cls)
        self.assert_goes_and_comes()

    def test_draw_handlers(self):
        overlay, cursor = support.addon("core.interface.overlay"), support.addon("pull.window.cursor")
        bpy.types.SpaceView3D.draw_handler_remove(overlay._handler[0], 'WINDOW')
        bpy.types.WindowManager.draw_cursor_remove(cursor._handle[0])
        self.assert_goes_and_comes()

    def test_tools(self):
        tools = support.addon("pull.window.tool")
        for tool in tools.TOOLS:
            bpy.utils.unregister_tool(tool)
        self.assert_goes_and_comes()

    def test_translations(self):
        translations = support.addon("core.translations")
        translations.unregister()
        self.assert_goes_and_comes()
