"""Official Blenders, started by the command line of a Blender."""

import functools
import json
import os
import subprocess
import unittest
from pathlib import Path

import blenders
import module_program
from temporary import Temporary

MOTUS = Path(__file__).resolve().parents[2] / "motus"
MODULES = tuple(one.name for one in blenders.BLENDERS if one.kind == "module")
STARTED = """
import bpy, json, os, sys
with open({path!r}, "a") as file:
    print(json.dumps([os.getcwd(), bpy.app.version_string, bpy.data.filepath, hasattr(bpy.types.Object, "motus"), __name__, sys.argv[-1]]), file=file)
"""
CHILD = """
import os, shlex, subprocess, sys
sys.exit(subprocess.run([*shlex.split(os.environ["MOTUS_BLENDER_PROGRAM"]), "-b", "--python-expr", "import sys; sys.exit(5)"]).returncode)
"""


@functools.cache
def has_blender(name):
    """Whether this machine has an official Blender, or can get it."""
    return subprocess.run([MOTUS, "has_blender", name], check=False, capture_output=True).returncode == 0


class CommandLine(unittest.TestCase):
    def test_order_is_kept_and_what_follows_two_dashes_is_the_scripts(self):
        found = module_program.parsed(["-b", "a file.blend", "--python", "x.py", "-f", "1", "--", "--unknown"])
        self.assertEqual(found, [("-b", None), ("", "a file.blend"), ("--python", "x.py"), ("-f", "1")])

    def test_what_cannot_be_followed_is_refused(self):
        for arguments, part in (
            (["file.blend"], "has no window"),
            (["-b", "--window-geometry", "0"], "--window-geometry"),
            (["-b", "--python"], "--python wants a value"),
        ):
            with self.assertRaisesRegex(module_program.Refused, part):
                module_program.parsed(arguments)

    def test_frames(self):
        scene = type("Scene", (), {"frame_start": 10, "frame_end": 20})
        for text, wanted in (("3", [3]), ("1,4..6", [1, 4, 5, 6]), ("+1", [11]), ("-1", [19])):
            self.assertEqual(list(module_program.frames_of(text, scene)), wanted)


class Started(Temporary):
    """In each official Blender that can be had here."""

    def each(self, names=MODULES):
        for name in names:
            with self.subTest(name):
                if not has_blender(name):
                    self.skipTest(f"no official Blender {name} here")
                yield name

    def start(self, name, *arguments):
        return subprocess.run(
            [MOTUS, "blender", "--version", name, *arguments],
            cwd=self.folder,
            check=False,
            text=True,
            timeout=600,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )

    def test_scripts_files_and_frames_in_their_order(self):
        """In one start: an exception ends neither what follows, nor the process with another status than 0."""
        small = "r = bpy.context.scene.render; r.resolution_x = r.resolution_y = 16; bpy.context.scene.cycles.samples = 1"
        for name in self.each():
            blend, told, out = self.folder / f"{name} file.blend", self.folder / f"{name}.json", str(self.folder / f"{name}-##")
            script = self.folder / "a script.py"
            script.write_text(STARTED.format(path=str(told)), encoding="utf-8")
            save = f"import bpy; bpy.ops.wm.save_as_mainfile(filepath={str(blend)!r})"
            scripts = ("--python", str(script), "--python-expr", save, str(blend), "--python", script.name, "--python-expr", "1 / 0")
            frames = ("-s", "3", "-e", "4", "-o", f"{out}a", "-F", "PNG", "-f", "7", "-o", f"{out}b", "-a")
            done = self.start(name, "-b", *scripts, "-E", "CYCLES", "--python-expr", small, *frames, "--", "an argument")
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("ZeroDivisionError", done.stdout)
            rows = [json.loads(line) for line in told.read_text(encoding="utf-8").splitlines()]
            exact = f"{blenders.named(name).version} LTS"
            wanted = [[str(self.folder), exact, path, True, "__main__", "an argument"] for path in ("", str(blend))]
            self.assertEqual(rows, wanted)
            found = sorted(path.name for path in self.folder.glob(f"{name}-*"))
            self.assertEqual(found, [f"{name}-{rest}.png" for rest in ("03b", "04b", "07a")])

    def test_exit_status(self):
        for name in self.each(MODULES[-1:]):
            for arguments, wanted, part in (
                (("--python-exit-code", "3", "--python-expr", "1 / 0"), 3, "ZeroDivisionError"),
                (("no such file.blend",), 1, "no such file.blend"),
                (("--python", "no such script.py"), 1, "no such script.py"),
                (("--python-expr", CHILD), 5, ""),
            ):
                done = self.start(name, "-b", "--factory-startup", *arguments)
                self.assertEqual(done.returncode, wanted, done.stdout)
                self.assertIn(part, done.stdout)

    def test_memory_and_threads(self):
        """Freed memory is filled, and a module uses the processors that it may."""
        tell = "import os, sys; print('TOLD', os.environ.get('MALLOC_PERTURB_'), len(os.sched_getaffinity(0))); sys.exit(7)"
        for name in self.each(MODULES[-1:]):
            done = self.start(name, "-b", "--debug-memory", "-t", "1", "--python-expr", tell)
            self.assertEqual(done.returncode, 7, done.stdout)
            self.assertIn(f"TOLD {module_program.FREED} 1\n", done.stdout)


class Offline(Temporary):
    def test_it_is_said_once(self):
        """A command that has seen that a Blender cannot be had passes it over at once."""
        environment = dict(os.environ, MOTUS_WITHOUT="4.5-lts", MOTUS_CACHE=str(self.folder))
        done = subprocess.run([MOTUS, "has_blender", "4.5-lts"], env=environment, check=False, text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (77, "motus: SKIPPED: Blender 4.5-lts, as was said above\n"))
        self.assertEqual(list(self.folder.iterdir()), [])
