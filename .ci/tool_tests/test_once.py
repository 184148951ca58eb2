"""What is fetched once into a folder that clones share, such as an official Blender or a compiler: whole, or not at all and with the reason."""

import contextlib
import io
import os
import subprocess
import sys
from pathlib import Path
from unittest import mock

import blenders
import official
import once
import platforms
from temporary import Temporary

CLONE = Path(__file__).resolve().parents[2]


class Installed(Temporary):
    blender = blenders.named("4.5-lts")

    def install(self, fill):
        with contextlib.redirect_stderr(io.StringIO()):
            return official.installed(self.blender, self.folder / "official", fill)

    @staticmethod
    def whole(_, place):
        (place / "bpy").mkdir(parents=True)
        return ""

    def test_once(self):
        place, why_not = self.install(self.whole)
        self.assertEqual((why_not, (place / "bpy").is_dir()), ("", True))
        self.assertEqual(self.install(self.fail), (place, ""))

    def test_what_is_there_waits_for_nobody(self):
        """Another clone may be installing something else into the folder, for minutes."""
        place, _ = self.install(self.whole)
        with mock.patch.object(once.fcntl, "flock", side_effect=AssertionError("it waits")):
            self.assertEqual(self.install(self.fail), (place, ""))

    def test_what_was_broken_off_is_made_anew(self):
        def broken(_, place):
            (place / "half").mkdir(parents=True)
            return "no connection"

        self.assertEqual(self.install(broken), (None, "no connection"))
        place, _ = self.install(self.whole)
        (place / "complete").unlink()
        (place / "half").mkdir()
        self.assertEqual(self.install(self.whole), (place, ""))
        self.assertFalse((place / "half").exists())

    def test_pip_installs_nothing_without_its_checksum(self):
        """A file of another content is refused by pip itself, with one line that says so."""
        requirements = self.folder / "requirements.txt"
        requirements.write_text(f"pip @ {(self.folder / 'x.whl').as_uri()} --hash=sha256:{'0' * 64}\n", encoding="utf-8")
        (self.folder / "x.whl").write_bytes(b"another content")
        one = type("Blender", (), {"requirements": requirements, "python": self.blender.python, "kind": self.blender.kind})
        why_not = official._fill(one, self.folder / "place")
        self.assertRegex(why_not, "^ERROR")
        self.assertEqual(list(self.folder.glob("place/*")), [])


class Fetched(Temporary):
    def pythons(self, copied):
        with contextlib.redirect_stderr(io.StringIO()):
            return platforms.pythons("windows", self.folder, copied)

    @staticmethod
    def whole(artifact, place):
        (place / "include").mkdir(parents=True)
        (place / "include" / "patchlevel.h").write_text(artifact.python, encoding="utf-8")
        return ""

    def test_once(self):
        folders, why_not = self.pythons(self.whole)
        self.assertEqual(why_not, "")
        self.assertEqual([(folder / "include" / "patchlevel.h").read_text(encoding="utf-8") for folder in folders], list(platforms.PYTHONS))
        self.assertEqual(self.pythons(self.fail), (folders, ""))

    def test_the_program_of_a_python_for_windows(self):
        """Of the one Python that is asked for, which is all that is fetched."""
        fetched = []
        with contextlib.redirect_stderr(io.StringIO()):
            found, why_not = platforms.program(
                "3.13", self.folder, lambda artifact, place: fetched.append(artifact) or self.whole(artifact, place)
            )
        self.assertEqual(
            ((found.parent / "include" / "patchlevel.h").read_text(encoding="utf-8"), found.name, why_not), ("3.13", "python.exe", "")
        )
        self.assertEqual([(one.system, one.python) for one in fetched], [("windows", "3.13")])

    def test_what_cannot_be_had_leaves_nothing(self):
        def broken(_, place):
            (place / "half").mkdir(parents=True)
            return "no connection"

        self.assertEqual(self.pythons(broken), (None, "no connection"))
        self.assertEqual(list(self.folder.rglob("half")), [])

    def test_without_a_network_the_reason_is_said(self):
        """By the exit status ./motus knows that a platform is to be skipped."""
        environment = os.environ | {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(self.folder)}
        command = [sys.executable, CLONE / ".ci" / "platforms.py", self.folder / "cache", "linux-x64"]
        done = subprocess.run(command, check=False, text=True, capture_output=True, env=environment)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, "^ERROR: No matching distribution found for ziglang")

    def test_motus_counts_what_is_skipped(self):
        """And ends as a skipped group of tests does."""
        environment = os.environ | {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(self.folder), "MOTUS_CACHE": str(self.folder / "cache")}
        environment["MOTUS_BUILD"], environment["MOTUS_DIST"] = str(self.folder / "build"), str(self.folder / "dist")
        command = [CLONE / "motus", "package", "--platforms", "linux-x64,windows-x64"]
        done = subprocess.run(command, check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment)
        self.assertEqual(done.returncode, 77, done.stdout)
        self.assertIn("SKIPPED: no platform could be packaged", done.stdout)
        self.assertFalse((self.folder / "dist").exists())

    def test_a_program_that_there_is_not(self):
        self.assertIn("no-such-program", once.run("no-such-program", "--quiet"))
