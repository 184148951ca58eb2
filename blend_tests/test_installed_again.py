"""Scenes of all systems outlive the add-on: it is updated, and uninstalled and installed again, by Blender's own ways."""

import json
import os
import shutil
import subprocess
import tempfile
import zipfile
from pathlib import Path

import bpy

import installed_scene
import support

IS_EXTENSION = bpy.app.version >= (4, 2, 0)
NEWER = "newer.json"
"""A file that only the newer zip has."""
LEGACY = """
import addon_utils, bpy
with bpy.context.temp_override(area=bpy.context.window.screen.areas[0]):
    {call}
bpy.ops.wm.save_userpref()
"""
INSTALL = "bpy.ops.preferences.addon_install(filepath={path!r}, overwrite=True); bpy.ops.preferences.addon_enable(module='motus')"
REMOVE = "bpy.ops.preferences.addon_remove(module='motus')"
UPDATE_WHILE_OPEN = """
import bpy, installed_scene
installed_scene.open_again({folder!r})
if bpy.app.version >= (4, 2, 0):
    bpy.ops.extensions.package_install_files(filepath={path!r}, repo='user_default', enable_on_install=True)
else:
    bpy.ops.preferences.addon_install(filepath={path!r}, overwrite=True)
    bpy.ops.preferences.addon_enable(module='motus')
installed_scene.write({folder!r}, 'updated.json')
"""


def own_zip():
    """The zip that this Blender's add-on was installed from."""
    if named := os.environ.get("MOTUS_ZIP"):
        return Path(named)
    kind = "extension" if IS_EXTENSION else "legacy"
    (found,) = Path(os.environ.get("MOTUS_DIST", support.CLONE / "dist")).glob(f"motus-*-{kind}.zip")
    return found


class InstalledAgainTest(support.SceneTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        temporary = tempfile.TemporaryDirectory(prefix="motus-test-")
        cls.addClassCleanup(temporary.cleanup)
        cls.made = Path(temporary.name)
        support.empty_scene()
        installed_scene.build(temporary.name)
        installed_scene.write(temporary.name, "before.json")

    def setUp(self):
        super().setUp()
        self.profile = support.copy_profile(self.folder)
        for name in ("scene.blend", "before.json"):
            shutil.copy(self.made / name, self.folder)
        self.newer = self.folder / own_zip().name
        shutil.copy(own_zip(), self.newer)
        with zipfile.ZipFile(self.newer, "a") as archive:
            archive.writestr(NEWER if IS_EXTENSION else f"motus/{NEWER}", "{}")

    def run_in_blender(self, code, enabled=True):
        status, output = support.run_blender(code, self.profile, arguments=(), enabled=enabled)
        self.assertEqual(status, 0, output)

    def extension(self, *arguments):
        """Blender's own command."""
        environment = {name: value for name, value in os.environ.items() if not name.startswith("BLENDER_USER_")}
        done = subprocess.run(
            [*support.program(), "--command", "extension", *arguments],
            env=environment | {"BLENDER_USER_RESOURCES": str(self.profile)},
            text=True,
            check=False,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self.assertEqual(done.returncode, 0, done.stdout)

    def install(self, path):
        if IS_EXTENSION:
            self.extension("install-file", "--repo", "user_default", "--enable", str(path))
        else:
            self.run_in_blender(LEGACY.format(call=INSTALL.format(path=str(path))), enabled=False)

    def uninstall(self):
        if IS_EXTENSION:
            self.extension("remove", "user_default.motus")
        else:
            self.run_in_blender(LEGACY.format(call=REMOVE), enabled=False)
        with self.assertRaises(StopIteration):
            support.addon_folder(self.profile)

    def assert_scene_is_as_before(self, name):
        before, after = (json.loads((self.folder / one).read_text(encoding="utf-8")) for one in ("before.json", name))
        self.assertEqual(after["settings"], before["settings"])
        self.assertGreater(len(before["settings"]), 20)
        for frame, numbers in before["frames"].items():
            found = after["frames"][frame]
            for what, values in numbers.items():
                self.assertEqual(len(found[what]), len(values), f"{what} at frame {frame}")
                for value, wanted in zip(found[what], values):
                    self.assertAlmostEqual(value, wanted, delta=1e-5 + 1e-6 * abs(wanted), msg=f"{what} at frame {frame}")

    def assert_is_newer(self):
        self.assertTrue((support.addon_folder(self.profile) / NEWER).is_file())

    def test_uninstalled_and_installed_again(self):
        self.uninstall()
        self.run_in_blender(f"import installed_scene as it; it.use({str(self.folder)!r})", enabled=False)
        self.install(self.newer)
        self.assert_is_newer()
        self.run_in_blender(
            f"import installed_scene as it; it.open_again({str(self.folder)!r}); it.write({str(self.folder)!r}, 'after.json')"
        )
        self.assert_scene_is_as_before("after.json")

    def test_updated_while_the_scene_is_open(self):
        self.run_in_blender(UPDATE_WHILE_OPEN.format(folder=str(self.folder), path=str(self.newer)))
        self.assert_is_newer()
        self.assert_scene_is_as_before("updated.json")
        self.run_in_blender(
            f"import installed_scene as it; it.open_again({str(self.folder)!r}); it.write({str(self.folder)!r}, 'after.json')"
        )
        self.assert_scene_is_as_before("after.json")
