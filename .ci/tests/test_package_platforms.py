"""Extensions and legacy zips contain what Blender looks for."""

import shutil
import sys
import tempfile
import tomllib
import unittest
import zipfile
from pathlib import Path

import package
import package_platforms
import platforms

FAKE_BLENDER = """
import sys
print("what is wrong")
sys.exit(3)
"""


class Temporary(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)


class Zips(Temporary):
    def setUp(self):
        super().setUp()
        self.modules = self.folder / "modules"
        self.modules.mkdir()
        for platform in platforms.PLATFORMS.values():
            for python in platforms.PYTHONS:
                (self.modules / platform.module(python)).write_bytes(b"a module")

    def test_legacy_zip_of_a_platform(self):
        platform = platforms.PLATFORMS["windows-x64"]
        modules = package_platforms.modules_of(platform, self.modules)
        package.stage_legacy(self.folder / "stage", modules.values(), [platform.name])
        package.write_zip(self.folder / "legacy.zip", self.folder / "stage", "motus/")
        with zipfile.ZipFile(self.folder / "legacy.zip") as archive:
            names = archive.namelist()
            manifest = tomllib.loads(archive.read("motus/blender_manifest.toml").decode())
            self.assertIn("bl_info = {", archive.read("motus/__init__.py").decode())
        self.assertEqual(manifest["platforms"], ["windows-x64"])
        self.assertLessEqual({"motus/manual/en/path.html", "motus/manual/en/operators.html", "motus/manual/style.css"}, set(names))
        natives = sorted(name for name in names if name.startswith("motus/motus_native"))
        self.assertEqual(natives, ["motus/motus_native.cp311-win_amd64.pyd", "motus/motus_native.cp313-win_amd64.pyd"])

    def test_an_extension_brings_wheels_alone(self):
        wheel = self.folder / "motus_native-0-cp311-cp311-win_amd64.whl"
        wheel.write_bytes(b"a wheel")
        package.stage(self.folder / "stage", (), ["windows-x64"], [wheel])
        manifest = tomllib.loads((self.folder / "stage" / "blender_manifest.toml").read_text(encoding="utf-8"))
        self.assertEqual(manifest["wheels"], [f"./wheels/{wheel.name}"])
        self.assertTrue((self.folder / "stage" / "wheels" / wheel.name).is_file())
        self.assertEqual(list((self.folder / "stage").glob("motus_native*")), [])

    def test_a_module_that_is_not_built_is_named(self):
        shutil.rmtree(self.modules)
        with self.assertRaisesRegex(SystemExit, r"not built: .*motus_native\.cpython-311-darwin\.so"):
            package_platforms.modules_of(platforms.PLATFORMS["macos-x64"], self.modules)

    def test_what_blender_says_is_shown(self):
        (self.folder / "blender.py").write_text(FAKE_BLENDER, encoding="utf-8")
        with self.assertRaisesRegex(SystemExit, "(?s)what is wrong.*extension build"):
            package.extension_build([sys.executable, str(self.folder / "blender.py")])
