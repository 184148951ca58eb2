"""Files, footage and profiles in folders whose names are long, or have blanks and letters of all kinds; and paths as Windows has them."""

import os
import shutil
import sys
from pathlib import Path

import bpy

import support
from chroma import chroma_cases
from chroma.chroma_setup_cases import footage
from saved import make, saved_cases as cases

NAME = "Señora Ωmega, 木 & co"
LONG = 230 if sys.platform == "win32" else 900
"""Letters of a path: a little less than Windows takes, unless its registry allows more, and than Blender takes."""
FRAME = 37
IN_A_PROFILE = """
import bpy, support
bpy.ops.motus.pendulum_add(kind='SINGLE')
settings = bpy.context.object.motus.pendulum
settings.length1 = 3.5
assert bpy.ops.motus.pendulum_preset_add(name="Kept") == {'FINISHED'}
settings.length1 = 1.0
path = bpy.utils.preset_find("Kept", "motus/pendulum")
bpy.ops.script.execute_preset(filepath=path, menu_idname="MOTUS_PT_pendulum_presets")
print("TOLD", settings.length1, support.addon("core.native").status.code, ascii(path))
"""


def film(folder):
    """A film of two frames of nothing; its path."""
    folder.mkdir()
    scene = bpy.data.scenes.new("Film")
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = 'CYCLES', 1, False
    scene.render.resolution_x = scene.render.resolution_y = 32
    scene.frame_start, scene.frame_end = 1, 2
    path = chroma_cases.render_film(scene, folder)
    bpy.data.scenes.remove(scene)
    return path


class PlaceTestCase(support.SceneTestCase):
    """A folder `self.place` with such a name."""

    def setUp(self):
        super().setUp()
        self.place = self.folder / NAME
        self.place.mkdir()

    def scene(self):
        """A scene of followers; where all is on a frame."""
        make.path()
        return cases.numbers(FRAME)

    def saved(self, path):
        bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)

    def assert_opens(self, path, wanted):
        cases.open_file(path)
        self.assertEqual(cases.numbers(FRAME), wanted)


class Places(PlaceTestCase):
    def test_a_file_with_any_name(self):
        wanted = self.scene()
        path = self.place / f"{NAME}.blend"
        self.saved(path)
        self.assertTrue(path.is_file())
        self.assert_opens(path, wanted)

    def test_a_long_path(self):
        wanted, path = self.scene(), self.place
        while len(str(path)) < LONG - 60:
            path /= "a folder with a name of fifty letters, or so many"
            path.mkdir()
        path /= f"{'x' * (LONG - len(str(path)) - 7)}.blend"
        self.saved(path)
        self.assert_opens(path, wanted)

    def test_a_library_beside_the_file(self):
        """Named from the file, as Blender does with both on one drive."""
        self.scene()
        self.saved(self.place / "library.blend")
        support.empty_scene()
        bpy.ops.wm.save_as_mainfile(filepath=str(self.place / "shot.blend"))
        with bpy.data.libraries.load("//library.blend", link=True, relative=True) as (_, wanted):
            wanted.objects = ["Eased"]
        bpy.context.scene.collection.objects.link(wanted.objects[0])
        found = cases.numbers(FRAME)["Eased"]
        bpy.ops.wm.save_mainfile()
        cases.open_file(self.place / "shot.blend")
        self.assertEqual([library.filepath for library in bpy.data.libraries], ["//library.blend"])
        self.assertEqual(cases.numbers(FRAME)["Eased"], found)
        cases.open_file(self.place / "library.blend")
        self.assertEqual(cases.numbers(FRAME)["Eased"], found)

    def test_footage_can_be_deleted_once_its_key_is_gone(self):
        """Nothing holds its files: Windows deletes no file that is open."""
        pictures = [f"shot_{number:03d}.png" for number in range(3, 6)]
        for name in pictures:
            footage(self.place, name=name)
        for keywords in (
            {"clip": str(self.place / pictures[0])},
            {"directory": str(self.place), "files": [{"name": name} for name in pictures]},
            {"clip": film(self.place / "film"), "color": chroma_cases.GREEN},
        ):
            self.assertEqual(bpy.ops.motus.chroma_key_setup(**keywords), {'FINISHED'})
            self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
        shutil.rmtree(self.place)
        self.assertFalse(self.place.exists())

    def test_a_profile_with_any_name(self):
        """The native module is loaded from it, and presets are kept in it."""
        profile = support.copy_profile(self.place)
        status, output = support.run_blender(IN_A_PROFILE, profile=profile)
        told = next((line for line in output.splitlines() if line.startswith("TOLD")), output)
        self.assertEqual((status, told[:11]), (0, "TOLD 3.5 OK"), output)
        self.assertIn(ascii(NAME)[1:-1], told)


if sys.platform == "win32":

    class WindowsPaths(PlaceTestCase):
        """Drives, and slashes of two kinds."""

        def test_slashes_and_drives_of_both_kinds(self):
            wanted = self.scene()
            path = str(self.place / "scene.blend")
            self.assertRegex(path, r"^[A-Z]:\\")
            self.saved(path)
            for other in (path.replace("\\", "/"), path[0].lower() + path[1:]):
                self.assert_opens(other, wanted)
                self.saved(other)
                self.assertEqual(sorted(found.name for found in self.place.glob("*.blend")), ["scene.blend"])

        def test_footage_on_paths_of_both_kinds(self):
            pictures = [f"shot_{number:03d}.png" for number in range(3, 6)]
            for name in pictures:
                footage(self.place, name=name)
            for folder in (str(self.place), str(self.place).replace("\\", "/"), f"{self.place}\\"):
                bpy.ops.motus.chroma_key_setup(directory=folder, files=[{"name": name} for name in pictures])
                node = support.addon("chroma.compositor").node_of(bpy.context.scene, "Footage")
                self.assertEqual((node.image.source, node.frame_duration, node.frame_offset), ('SEQUENCE', 3, 2), folder)
                bpy.ops.motus.chroma_key_remove()

        def test_a_library_on_another_drive(self):
            """It has no path from the file on."""
            there = Path(os.environ["BLENDER_USER_RESOURCES"], "library.blend")
            self.assertNotEqual(there.drive, self.place.drive)
            self.addCleanup(there.unlink)
            self.scene()
            self.saved(there)
            found = cases.numbers(FRAME)["Eased"]
            self.load(str(there), True, "Eased")
            self.saved(self.place / "shot.blend")
            cases.open_file(self.place / "shot.blend")
            self.assertEqual([Path(library.filepath) for library in bpy.data.libraries], [there])
            self.assertEqual(cases.numbers(FRAME)["Eased"], found)
