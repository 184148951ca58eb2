"""Wheels of the native module are installed by pip into a plain Python."""

import os
import subprocess
import sys
import sysconfig
import tempfile
import unittest
from pathlib import Path

import package
import pinned

CLONE = Path(__file__).resolve().parents[2]
RELEASE = Path(os.environ.get("MOTUS_BUILD", CLONE / "build")) / "release" / "python"
CACHE = Path(os.environ.get("MOTUS_CACHE") or Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "motus")
TYPED = """
import motus_native
reveal_type(motus_native.cache_budget())
motus_native.no_such_name
"""


def output_of(*command, **options):
    """What a command prints, and its errors."""
    return subprocess.run(
        list(map(str, command)), check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options
    ).stdout


class Wheels(unittest.TestCase):
    python = ".".join(map(str, sys.version_info[:2]))

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
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
