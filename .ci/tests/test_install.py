"""`./motus install --blender PATH` installs the right zip into the user's profile, by Blender's own command or the legacy way, or says why not."""

import os
import shlex
import subprocess
import tempfile
import unittest
from pathlib import Path

import blenders
import official

CI = Path(__file__).resolve().parents[1]
MOTUS = CI.parent / "motus"
CACHE = Path(os.environ.get("MOTUS_CACHE") or Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "motus")
OLD = """#!/bin/sh
case "$*" in
    --version) echo "Blender 3.6.1" ;;
    *EXTENSION_SUFFIXES*) echo "SUFFIX .cpython-310-x86_64-linux-gnu.so" ;;
    *) echo "asked for more: $*"; exit 3 ;;
esac
"""
"""A Blender whose Python has no native module."""


def run(*command, **options):
    """(exit status, what is printed)."""
    done = subprocess.run(
        list(map(str, command)), text=True, check=False, timeout=900, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options
    )
    return done.returncode, done.stdout


class Install(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.profile = self.folder / "a profile"
        self.profile.mkdir()
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith(("BLENDER", "MOTUS_PREPARED"))}
        self.environment["BLENDER_USER_RESOURCES"] = str(self.profile)

    def install(self, path):
        return run(MOTUS, "install", "--blender", path, env=self.environment, cwd=self.folder)

    def program(self, text, name="blender"):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)
        return path

    def needs(self, version):
        if run(MOTUS, "has_blender", version)[0] == 77:
            self.skipTest(f"no Blender {version} here")

    def test_the_legacy_way_before_4_2(self):
        self.needs("3.4")
        status, said = self.install("/usr/bin/blender")
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"installed into Blender 3\.4 \(/usr/bin/blender\) and enabled: Native module \d")
        self.assertTrue((self.profile / "scripts" / "addons" / "motus" / "__init__.py").is_file())

    def test_the_folder_of_an_unpacked_official_blender(self):
        """Of which here the module stands in for the program; its Python chooses the native module."""
        self.needs("4.5-lts")
        blender = blenders.named("4.5-lts")
        place, _ = official.installed(blender, CACHE / "official")
        launcher = shlex.join(["/usr/bin/python3", "-s", "-P", str(CI / "module_program.py"), str(place)])
        self.program(f'#!/bin/sh\nexec {launcher} "$@"\n', "blender-4.5-linux-x64/blender")
        status, said = self.install("blender-4.5-linux-x64/")
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"installed into Blender 4\.5 \(.*blender-4\.5-linux-x64/blender\) and enabled: Native module \d")
        natives = [path.name for path in (self.profile / "extensions" / "user_default" / "motus").glob("motus_native.*.so")]
        self.assertEqual(natives, ["motus_native.cpython-311-x86_64-linux-gnu.so"])

    def test_a_python_without_a_module_is_said(self):
        status, said = self.install(self.program(OLD))
        self.assertEqual(status, 1)
        self.assertRegex(
            said, r"^motus: Blender 3\.6 runs Python 3\.10, for which no native module can be built here: there can be one for Python 3\."
        )
        self.assertEqual(list(self.profile.iterdir()), [])

    def test_what_is_no_blender_is_said(self):
        (self.folder / "blender.tar.xz").write_bytes(b"an archive")
        (self.folder / "empty").mkdir()
        for name, sentence in (
            ("blender.tar.xz", "is no program: unpack the archive of Blender"),
            ("empty", "the folder empty has no program blender"),
            ("nothing", "there is no Blender nothing"),
        ):
            status, said = self.install(name)
            self.assertEqual(status, 1)
            self.assertIn(sentence, said)
            self.assertEqual(said.count("\n"), 1, said)
