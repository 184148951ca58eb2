"""./motus does what its help says, from any folder and with files anywhere."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

CLONE = Path(__file__).resolve().parents[2]
MOTUS = str(CLONE / "motus")
VERSIONS = ("3.4", "4.3", "5.2")
WHERE = """
import bpy, os, sys
print('RAN', os.getcwd(), hasattr(bpy.types.Object, 'motus'), sys.argv[-1], flush=True)
print('SHADERS', os.environ.get('MESA_SHADER_CACHE_DIR', ''), flush=True)
sys.exit(7)
"""
FAKE = """#!/bin/sh
case "$*" in
    --version) echo "Blender 4.9.0" ;;
    *ik_bench.py*) echo "| a row"; echo "what went wrong"; exit 1 ;;
    *layers_bench.py*) echo "no row" ;;
    *walker_bench.py*)
        echo "| another row"; echo "what an operator reports"
        echo '{"table": "T", "row": "R", "measures": []}' >>"$MOTUS_BENCH_ROWS" ;;
esac
"""
"""A Blender in which one benchmark breaks, one states no row, and one runs."""
PLACES = """
import addon_utils
for module in addon_utils.modules():
    if module.__name__.split('.')[-1] == 'motus':
        print('MODULE', module.__file__, flush=True)
"""


def motus(*arguments, cwd="/", env=None):
    return subprocess.run(
        [MOTUS, *arguments], cwd=cwd, env=env, text=True, check=False, timeout=900, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )


def mounts():
    return sorted(Path("/proc/mounts").read_text(encoding="utf-8").splitlines())


class Command(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def script(self, text, folder=None):
        path = Path(folder or self.folder, "a script.py")
        path.write_text(text, encoding="utf-8")
        self.addCleanup(path.unlink, missing_ok=True)
        return path

    def available(self, version):
        if motus("has_blender", version).returncode == 77:
            self.skipTest(f"no Blender {version} here")

    def test_blender_passes_arguments_and_the_exit_status_on(self):
        """And leaves nothing mounted, and no two releases of Mesa share a cache of shaders.

        Where root may write below a system folder, the script lies there, and is found twice: the second time over the mount point that the first
        has left.
        """
        folder, turns = self.folder, [("--factory-startup",)]
        if os.access("/var/lib", os.W_OK):
            temporary = tempfile.TemporaryDirectory(dir="/var/lib", prefix="motus test ")
            self.addCleanup(temporary.cleanup)
            folder, turns = Path(temporary.name), [("--factory-startup",), ()]
        before, script, caches = mounts(), str(self.script(WHERE, folder)), []
        for version in VERSIONS:
            with self.subTest(version=version):
                self.available(version)
                for options in turns:
                    done = motus("blender", "--version", version, "-b", *options, "--python", script, "--", "an argument", cwd=folder)
                    self.assertEqual(done.returncode, 7, done.stdout)
                    self.assertIn(f"RAN {folder} True an argument", done.stdout)
                (shaders,) = [line for line in done.stdout.splitlines() if line.startswith("SHADERS")]
                self.assertNotIn(shaders, caches)
                caches.append(shaders)
        self.assertEqual(mounts(), before)

    def test_the_second_start_makes_nothing_again(self):
        """It builds, packages and installs nothing: no file of the build, of the packages and of the profile is another one than before."""
        environment = {name: value for name, value in os.environ.items() if name != "MOTUS_PREPARED"}
        environment["MOTUS_PROFILE"] = str(self.folder / "profile")
        states = []
        for _ in range(2):
            done = motus("blender", "-b", "--factory-startup", "--python-expr", PLACES, env=environment)
            self.assertEqual(done.returncode, 0, done.stdout)
            build, dist = Path(os.environ.get("MOTUS_BUILD", CLONE / "build")), Path(os.environ.get("MOTUS_DIST", CLONE / "dist"))
            (module,) = [line.removeprefix("MODULE ") for line in done.stdout.splitlines() if line.startswith("MODULE ")]
            files = [
                *(build / "release").rglob("*.o"),
                *(build / "release" / "python").iterdir(),
                *dist.iterdir(),
                *Path(module).parent.rglob("*"),
            ]
            states.append(
                {
                    str(path): (path.stat().st_ino, path.stat().st_mtime_ns)
                    for path in files
                    if path.is_file() and "__pycache__" not in path.parts
                }
            )
        self.assertGreater(len(states[0]), 100)
        self.assertEqual(states[0], states[1])

    def test_python_finds_the_native_module(self):
        path = self.script("import sys, motus_native\nprint(motus_native.__version__, *sys.argv[1:])\nsys.exit(3)")
        done = motus("python", str(path), "one", "two words", cwd=self.folder)
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertRegex(done.stdout, r"^\d+\.\d+\.\d+ one two words")

    def test_a_blender_that_is_not_there_is_said(self):
        done = motus("blender", "--version", "2.7", "-b")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no Blender 2.7", done.stdout)

    def test_arguments_that_mean_nothing_are_refused(self):
        """Before anything is made, installed or removed."""
        environment = dict(os.environ, MOTUS_BUILD=str(self.folder / "build"), MOTUS_DIST=str(self.folder / "dist"))
        for arguments in (
            ("install", "there"),
            ("install", "--blender"),
            ("package", "x"),
            ("release", "x"),
            ("clean", "all"),
            ("docs", "y"),
            ("docs", "steps", "y"),
            ("docs", "moving", "y"),
            ("bench", "--blenders"),
        ):
            with self.subTest(arguments=arguments):
                done = motus(*arguments, env=environment)
                self.assertIn(done.returncode, (1, 2), done.stdout)
                self.assertRegex(done.stdout, rf"^motus: .*{arguments[-1]}.*\n$")
                self.assertEqual(list(self.folder.iterdir()), [])

    def test_words_that_a_command_cannot_do_without_are_named(self):
        """Each command whose first look at its arguments is at one that may be missing."""
        environment = dict(os.environ, MOTUS_BUILD=str(self.folder / "build"), MOTUS_DIST=str(self.folder / "dist"))
        texts = [path.read_text(encoding="utf-8") for path in (Path(MOTUS), *(CLONE / ".ci").glob("*.sh"))]
        bodies = dict(
            pair for text in texts for pair in re.findall(r"^command_(\w+)\(\) \{([^\n]*\}$|.*?^\})", text, re.MULTILINE | re.DOTALL)
        )
        looks = {name: re.search(r"\$\{?[1-9](?!:-)|\$\{[1-9]:-|\(\(\$#\)\)", body) for name, body in bodies.items()}
        wanting = {name for name, look in looks.items() if look and re.fullmatch(r"\$\{?[1-9]", look.group())}
        self.assertLess({"build", "test_library", "has_blender", "test_inside", "validate", "farm_hand_over"}, wanting)
        for name in sorted({*wanting, "python", "test_outside"}):
            with self.subTest(name=name):
                done = motus(name, env=environment)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertRegex(done.stdout, rf"^motus: {name} wants [A-Z]+.* behind it\n$")
        self.assertIn("SHOT RESULT FIRST LAST", motus("farm_hand_over", "", env=environment).stdout)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_benchmark_that_breaks_is_told_and_the_others_run(self):
        blender = self.folder / "blender"
        blender.write_text(FAKE, encoding="utf-8")
        blender.chmod(0o755)
        environment = dict(os.environ, BLENDER=str(blender), MOTUS_PREPARED="1")
        for name in ("PROFILE", "BUILD", "CACHE"):
            environment[f"MOTUS_{name}"] = str(self.folder / name)
        done = motus("bench", "--blenders", "4.9", "ik_bench in", "layers_bench in", "walker_bench in", env=environment)
        self.assertEqual(done.returncode, 1, done.stdout)
        for line in (
            "== ik_bench in Blender 4.9",
            "| a row",
            "what went wrong",
            "== layers_bench in Blender 4.9",
            "no row",
            "| another row",
        ):
            self.assertIn(f"{line}\n", done.stdout)
        self.assertNotIn("what an operator reports", done.stdout)
        self.assertTrue(done.stdout.endswith("broke, see above: ik_bench in Blender 4.9; layers_bench in Blender 4.9;\n"), done.stdout)

        done = motus("bench", "--blenders", "4.9", "no such benchmark", env=environment)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("no benchmark was run", done.stdout)

    def test_help_names_every_command(self):
        shown = motus("help").stdout
        for name in ("demo", "test", "lint", "bench", "package", "release", "install", "docs", "python", "blender", "clean"):
            self.assertIn(f"\n  {name}", shown)
        self.assertEqual(motus("no-such-command").returncode, 2)
