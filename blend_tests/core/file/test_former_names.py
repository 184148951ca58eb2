"""Settings that were renamed: files, library overrides and scripts that have the former names give the same snow."""

import bpy

import support
from snow.snow_cases import SnowTestCase, state
from support import go_to

VALUES = {"emitter_radius": 2.5, "use_steering": True, "steering_frequency": 0.75, "steering_per_flake": True}


def former():
    """{present name: former name}."""
    names = support.addon("snow.properties").FORMER_NAMES
    return {name: old for old, name in names.items()}


def stored(obj):
    """What Blender has stored of an emitter's settings, by names."""
    read = getattr(obj, "bl_system_properties_get", None)
    return (read() if read else obj)["motus"]["snow"]


def age(obj):
    """Store the settings as an earlier version has stored them."""
    group = stored(obj)
    for name, old in former().items():
        group[old] = group.pop(name)


class FormerNames(SnowTestCase):
    def setUp(self):
        super().setUp()
        self.emitter = self.add(rate=50.0, seed=3, **VALUES)
        go_to(40)
        self.wanted = state(self.emitter)

    def assert_present(self, obj, wanted=VALUES):
        for name, value in wanted.items():
            self.assertAlmostEqual(getattr(obj.motus.snow, name), value, msg=name)
            self.assertAlmostEqual(getattr(obj.motus.snow, former()[name]), value, msg=former()[name])
        self.assertEqual(set(former().values()) & set(stored(obj).keys()), set())

    def test_a_file_that_is_opened(self):
        bpy.ops.wm.open_mainfile(filepath=self.save("new.blend"))
        is_dirty = bpy.data.is_dirty  # of any file that was just opened: in Blender 4.3 without a window it is true
        age(bpy.data.objects["Snow"])
        path = self.save("old.blend")
        bpy.ops.wm.open_mainfile(filepath=path)
        emitter = bpy.data.objects["Snow"]
        self.assert_present(emitter)
        go_to(40)
        self.assertEqual(state(emitter), self.wanted)
        self.assertEqual(bpy.data.is_dirty, is_dirty)

    def test_an_emitter_that_is_appended_or_linked(self):
        age(self.emitter)
        path = self.save("old.blend")
        for links in (False, True):
            with self.subTest(links=links):
                emitter = self.load(path, links, "Snow")
                bpy.context.view_layer.update()
                go_to(40)
                self.assert_present(emitter)
                self.assertEqual(state(emitter), self.wanted)

    def test_a_library_override(self):
        age(self.emitter)
        library = self.save("library.blend")
        emitter = self.load(library, True, "Snow").override_create()
        bpy.context.scene.collection.objects.link(emitter)
        group = stored(emitter)
        group["cone_radius"] = 0.5
        group.pop("emitter_radius", None)
        shot = str(self.folder / "shot.blend")
        bpy.ops.wm.save_as_mainfile(filepath=shot)
        self.assertIn("motus.snow.cone_radius", [one.rna_path for one in emitter.override_library.properties])
        for _ in range(2):
            bpy.ops.wm.open_mainfile(filepath=shot)
            emitter = next(obj for obj in bpy.data.objects if obj.override_library)
            self.assert_present(emitter, VALUES | {"emitter_radius": 0.5})
            bpy.ops.wm.save_as_mainfile(filepath=shot)

    def test_scripts_that_use_the_former_names(self):
        settings = self.emitter.motus.snow
        settings.cone_radius, settings.snow = -1.0, False
        self.assertEqual((settings.emitter_radius, settings.use_steering), (0.0, False))
        go_to(40)
        self.assertNotEqual(state(self.emitter), self.wanted)
        keywords = {former()[name]: value for name, value in VALUES.items()}
        made = self.add(rate=50.0, seed=3, **keywords)
        self.assert_present(made)
        go_to(40)
        self.assertEqual(state(made), self.wanted)
