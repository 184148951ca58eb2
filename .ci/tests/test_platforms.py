"""What modules for other systems are built with: fetched once, with checksums, or not at all and with the reason."""

import ast
import contextlib
import hashlib
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import once
import platforms

CLONE = Path(__file__).resolve().parents[2]


class Temporary(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)


class Table(unittest.TestCase):
    def test_every_platform_has_its_pythons(self):
        for platform in platforms.PLATFORMS.values():
            found = platforms.artifacts(platform.system)
            self.assertEqual(tuple(one.python for one in found), platforms.PYTHONS)
            for one in found:
                self.assertRegex(one.checksum, "^sha256:[0-9a-f]{64}$")
                self.assertIn(f":{one.python}.", one.coordinates)

    def test_every_platform_can_be_configured_by_hand(self):
        presets = {one["name"]: one for one in json.loads((CLONE / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]}
        for name in platforms.PLATFORMS:
            toolchain = presets[f"module-{name}"]["toolchainFile"].replace("${sourceDir}", str(CLONE))
            self.assertTrue(Path(toolchain).is_file(), toolchain)

    def test_the_add_on_knows_the_same(self):
        """It names the zip to take."""
        source = (CLONE / "addon" / "motus" / "core" / "native.py").read_text(encoding="utf-8")
        names = ast.literal_eval(source.split("\nPLATFORMS = ")[1].splitlines()[0])
        self.assertEqual(names, tuple(platforms.PLATFORMS))

    def test_a_platform_that_there_is_not(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            self.assertEqual(platforms.main("/nowhere", "amiga-m68k"), 2)
        self.assertIn("linux-x64, windows-x64", said.getvalue())


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


class Unpacked(Temporary):
    def setUp(self):
        super().setUp()
        self.jar = self.folder / "cpython.jar"
        with zipfile.ZipFile(self.jar, "w") as archive:
            archive.writestr("META-INF/MANIFEST.MF", "no part of it")
            archive.writestr("org/bytedeco/cpython/windows-x86_64/include/patchlevel.h", "3.11")

    def test_the_python_alone(self):
        checksum = f"sha256:{hashlib.sha256(self.jar.read_bytes()).hexdigest()}"
        self.assertEqual(platforms.unpacked(self.jar, checksum, self.folder / "python"), "")
        files = [path.relative_to(self.folder / "python").as_posix() for path in (self.folder / "python").rglob("*") if path.is_file()]
        self.assertEqual(files, ["include/patchlevel.h"])

    def test_nothing_with_another_checksum(self):
        why_not = platforms.unpacked(self.jar, "sha256:" + "0" * 64, self.folder / "python")
        self.assertIn("cpython.jar has the checksum sha256:", why_not)
        self.assertFalse((self.folder / "python").exists())


class Wine(Temporary):
    def test_its_server_does_not_keep_the_lock_of_a_command(self):
        """The server goes on for seconds after the last program; whoever builds in the same clone waited for that."""
        wine = self.folder / "wine"
        wine.write_text(
            "#!/bin/bash\n[[ $1 != program ]] || { [[ -e /dev/fd/9 ]] && echo the lock is open; echo ran; }\n", encoding="utf-8"
        )
        wine.chmod(0o755)
        command = ["bash", "-c", 'exec 9>"$1/lock"; bash "$2" "$1" program', "_", self.folder, CLONE / ".ci" / "in_wine.sh"]
        said = subprocess.run(command, env=dict(os.environ, WINELOADER=str(wine)), stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertEqual(said, "ran\n")
