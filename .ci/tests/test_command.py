"""./motus does what its help says, from any folder and with files anywhere."""

import os
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

MOTUS = str(Path(__file__).resolve().parents[2] / "motus")
VERSIONS = ("3.4", "4.3", "5.2")
WHERE = """
import bpy, os, sys
print('RAN', os.getcwd(), hasattr(bpy.types.Object, 'motus'), sys.argv[-1], flush=True)
sys.exit(7)
"""


def motus(*arguments, cwd="/"):
    return subprocess.run([MOTUS, *arguments], cwd=cwd, text=True, check=False, timeout=300,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


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
        for version in VERSIONS:
            for options in ((), ("--factory-startup",)):
                with self.subTest(version=version, options=options):
                    self.available(version)
                    done = motus("blender", "--version", version, "-b", *options, "--python", str(self.script(WHERE)),
                                 "--", "an argument", cwd=self.folder)
                    self.assertEqual(done.returncode, 7, done.stdout)
                    self.assertIn(f"RAN {self.folder} True an argument", done.stdout)

    @unittest.skipUnless(os.access("/var/lib", os.W_OK), "only root writes below /var/lib")
    def test_a_file_below_a_system_folder_is_found(self):
        with tempfile.TemporaryDirectory(dir="/var/lib", prefix="motus-test-") as folder:
            for version in VERSIONS:
                with self.subTest(version=version):
                    self.available(version)
                    path = self.script(WHERE, folder)
                    for _ in range(2):  # the second time over the mount point that the first has left
                        done = motus("blender", "--version", version, "-b", "--python", str(path), cwd=folder)
                        self.assertIn(f"RAN {folder} True", done.stdout)

    def test_no_two_releases_of_mesa_share_a_cache(self):
        places = []
        for version in VERSIONS:
            with self.subTest(version=version):
                self.available(version)
                done = motus("blender", "--version", version, "-b", "--python-expr",
                             "import os; print('SHADERS', os.environ.get('MESA_SHADER_CACHE_DIR', ''))")
                found = [line for line in done.stdout.splitlines() if line.startswith("SHADERS")]
                self.assertEqual(len(found), 1, done.stdout)
                self.assertNotIn(found[0], places)
                places += found

    def test_nothing_stays_mounted(self):
        before = mounts()
        for version in VERSIONS:
            motus("blender", "--version", version, "-b", "--python-expr", "pass")
        self.assertEqual(mounts(), before)

    def test_the_second_start_costs_less_than_a_second(self):
        expression = ("-b", "--factory-startup", "--python-expr", "pass")
        motus("blender", *expression)
        started = time.monotonic()
        motus("blender", *expression)
        through_motus = time.monotonic() - started
        started = time.monotonic()
        subprocess.run([os.environ.get("BLENDER", "blender"), *expression], check=True, stdout=subprocess.DEVNULL)
        self.assertLess(through_motus - (time.monotonic() - started), 1.0)

    def test_python_finds_the_native_module(self):
        path = self.script("import sys, motus_native\nprint(motus_native.__version__, *sys.argv[1:])\nsys.exit(3)")
        done = motus("python", str(path), "one", "two words", cwd=self.folder)
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertRegex(done.stdout, r"^\d+\.\d+\.\d+ one two words")

    def test_a_blender_that_is_not_there_is_said(self):
        done = motus("blender", "--version", "2.7", "-b")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no Blender 2.7", done.stdout)

    def test_help_names_every_command(self):
        shown = motus("help").stdout
        for name in ("demo", "test", "bench", "package", "install", "docs", "python", "blender", "clean"):
            self.assertIn(f"\n  {name}", shown)
        self.assertEqual(motus("no-such-command").returncode, 2)
