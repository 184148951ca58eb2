"""The table of the platforms that modules are built for, what they are built with, and how a program for Windows is started."""

import ast
import contextlib
import hashlib
import io
import json
import os
import subprocess
import unittest
import zipfile
from pathlib import Path

import platforms
from temporary import Temporary

CLONE = Path(__file__).resolve().parents[2]


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
