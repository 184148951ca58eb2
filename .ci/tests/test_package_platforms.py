"""Wheels of the native module are installed by pip into a plain Python; extensions and legacy zips contain what Blender looks for."""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import unittest
import zipfile
from pathlib import Path

import package
import package_platforms
import pinned
import platforms

CLONE = Path(__file__).resolve().parents[2]
RELEASE = Path(os.environ.get("MOTUS_BUILD", CLONE / "build")) / "release" / "python"
CACHE = Path(os.environ.get("MOTUS_CACHE") or Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "motus")
TYPED = """
import motus_native
reveal_type(motus_native.cache_budget())
motus_native.no_such_name
"""
FAKE_BLENDER = """
import sys
print("what is wrong")
sys.exit(3)
"""


def output_of(*command, **options):
    """What a command prints, and its errors."""
    return subprocess.run(
        list(map(str, command)), check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options
    ).stdout


class Temporary(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)


class Wheels(Temporary):
    python = ".".join(map(str, sys.version_info[:2]))

    def setUp(self):
        super().setUp()
        self.programs, why_not = pinned.installed("package", CACHE / "programs")
        if not self.programs:
            self.skipTest(f"what makes wheels cannot be had: {why_not}")
        self.module = RELEASE / f"motus_native.{sysconfig.get_config_var('SOABI')}.so"

    def make(self, name):
        script = (
            "import sys, wheels; from pathlib import Path; from platforms import PLATFORMS\n"
            "print(wheels.make(Path(sys.argv[1]), PLATFORMS['linux-x64'], sys.argv[2], Path(sys.argv[3])))"
        )
        said = output_of(self.programs / "python", "-c", script, self.module, self.python, self.folder / name, cwd=CLONE / ".ci")
        return Path(said.strip())

    def test_the_same_content_gives_the_same_wheel(self):
        first, second = self.make("one"), self.make("two")
        tag = f"cp{self.python.replace('.', '')}"
        self.assertEqual(first.name, f"motus_native-{package.version()}-{tag}-{tag}-manylinux_2_28_x86_64.whl")
        self.assertEqual(first.read_bytes(), second.read_bytes())

    def test_pip_installs_it_into_a_plain_python(self):
        """The mathematics without Blender; NumPy is this machine's."""
        wheel, place = self.make("one"), self.folder / "python"
        output_of("/usr/bin/python3", "-m", "venv", "--system-site-packages", place)
        said = output_of(place / "bin" / "pip", "install", "--no-index", wheel)
        self.assertIn("Successfully installed motus_native", said.replace("motus-native", "motus_native"), said)
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        script = "import motus_native; print(motus_native.__version__, motus_native.__file__)"
        said = output_of(place / "bin" / "python", "-c", script, env=environment, cwd=self.folder)
        self.assertIn(f"{package.version()} {place}", said)
        listed = output_of(place / "bin" / "pip", "show", "--files", "motus_native")
        for part in ("Requires: numpy", "motus_native-stubs/__init__.pyi", "licenses/LICENSE"):
            self.assertIn(part, listed)

    def test_type_checkers_find_the_signatures(self):
        programs, why_not = pinned.installed("lint", CACHE / "programs")
        if not programs:
            self.skipTest(f"no mypy: {why_not}")
        place = self.folder / "python"
        output_of("/usr/bin/python3", "-m", "venv", place)
        output_of(place / "bin" / "pip", "install", "--no-index", "--no-deps", self.make("one"))
        (self.folder / "typed.py").write_text(TYPED, encoding="utf-8")
        said = output_of(
            programs / "mypy",
            "--python-executable",
            place / "bin" / "python",
            "--cache-dir",
            self.folder / "cache",
            "typed.py",
            cwd=self.folder,
        )
        self.assertIn('Revealed type is "int"', said.replace("builtins.", ""))
        self.assertIn('Module has no attribute "no_such_name"', said)


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
        self.assertEqual(
            natives, ["motus/motus_native.cp311-win_amd64.pyd", "motus/motus_native.cp313-win_amd64.pyd", "motus/motus_native.pyi"]
        )

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
