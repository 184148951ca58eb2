"""Without a usable native module the add-on still registers, and says in one sentence what to do."""

import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import support

REPORT = """
import addon_utils, importlib, sys
import support
for name in list(sys.modules):
    if f"{name}.".startswith(f"{support.module_name()}."):
        del sys.modules[name]
importlib.invalidate_caches()
if hasattr(addon_utils, "extensions_refresh"):
    addon_utils.extensions_refresh()
support.enable()
native = support.addon("core.native")
print("status:", native.status.code, "|", native.status.sentence, "|", native.module is None)
support.disable()
assert not support.is_enabled()
print("took it all back")
"""
FILES = {"windows-x64": "motus_native.cp311-win_amd64.pyd", "linux-x64": "motus_native.cpython-311-x86_64-linux-gnu.so"}
"""What the native module of two platforms is called."""


class NativeStatus(unittest.TestCase):
    profile: Path
    """A profile for all tests, in which each has the add-on's folder as leave_own_module() leaves it."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="motus-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.profile = support.copy_profile(Path(folder.name))
        cls.package = support.addon_folder(cls.profile)
        cls.manifest = (cls.package / "blender_manifest.toml").read_text(encoding="utf-8")
        cls.beside = support.BlenderBeside(cls.profile, enabled=False)
        cls.addClassCleanup(cls.beside.close)

    def setUp(self):
        self.native = support.addon("core.native")
        self.own = Path(self.native.module.__file__).name
        self.leave_own_module()

    def leave_own_module(self):
        """Leaves of all modules that which this Blender's Python takes, in the add-on's folder; the zips of a release bring it in wheels."""
        for folder in (self.package, self.profile / "extensions" / ".local"):
            for module in folder.rglob("motus_native.*"):
                module.unlink()
        shutil.rmtree(self.package / "wheels", ignore_errors=True)
        shutil.copyfile(self.native.module.__file__, self.package / self.own)
        manifest = self.package / "blender_manifest.toml"
        text = self.manifest.partition("\n# BEGIN GENERATED CONTENT.")[0]
        manifest.write_text(re.sub(r"^(platforms|wheels) = .*\n", "", text, flags=re.MULTILINE), encoding="utf-8")

    def assert_status(self, code, *parts):
        """Another Blender enables and disables the add-on; its status is `code`, and the sentence contains `parts`.

        It is a fresh one where it may load the native module, which Python does once in a process.
        """
        if code in {'OK', 'VERSION_MISMATCH'}:
            exit_status, output = support.run_blender(REPORT, profile=self.profile, enabled=False)
        else:
            exit_status, output = self.beside.run(REPORT)
        self.assertEqual(exit_status, 0, output)
        self.assertIn("took it all back", output)
        line = next(line for line in output.splitlines() if line.startswith("status: "))
        found, sentence, is_none = line.removeprefix("status: ").split(" | ")
        self.assertEqual(found, code, output)
        for part in parts:
            self.assertIn(part, sentence)
        self.assertEqual(is_none, str(code != 'OK'))

    def test_own_module_is_ok(self):
        self.assert_status('OK')

    def test_missing(self):
        (self.package / self.own).unlink()
        self.assert_status('MISSING', "missing", "install")

    def test_wrong_abi(self):
        (self.package / self.own).rename(self.package / "motus_native.cpython-39-x86_64-linux-gnu.so")
        self.assert_status('WRONG_ABI', "Python 3.9", "install")

    def test_every_module_of_a_wrong_python_is_named(self):
        """As other systems name the files, too."""
        (self.package / self.own).rename(self.package / "motus_native.cpython-39-darwin.so")
        (self.package / "motus_native.cp310-win_amd64.pyd").write_bytes(b"")
        self.assert_status('WRONG_ABI', "Python 3.9, 3.10,", "install")

    def test_wheels_of_a_wrong_python(self):
        (self.package / self.own).unlink()
        (self.package / "wheels").mkdir()
        for python in ("cp39", "cp310"):
            (self.package / "wheels" / f"motus_native-0.1.0-{python}-{python}-win_amd64.whl").write_bytes(b"")
        self.assert_status('WRONG_ABI', "Python 3.9, 3.10,", "install")

    def test_wheel_that_was_not_installed(self):
        (self.package / self.own).unlink()
        (self.package / "wheels").mkdir()
        tag = "cp{}{}".format(*sys.version_info)
        (self.package / "wheels" / f"motus_native-0.1.0-{tag}-{tag}-manylinux_2_28_x86_64.whl").write_bytes(b"")
        self.assert_status('LOAD_ERROR', "motus_native", "reinstall")

    def for_platforms(self, *names):
        """Has the manifest say what Blender writes into the zip of one platform."""
        with (self.package / "blender_manifest.toml").open("a", encoding="utf-8") as manifest:
            manifest.write(
                "\n\n# BEGIN GENERATED CONTENT.\n[build.generated]\nplatforms = [{}]\n".format(", ".join(f'"{name}"' for name in names))
            )

    def test_wrong_platform(self):
        """The file of another system, one of another processor, which has the same name, and none: the zip to take is named."""
        here, ending = self.native.this_platform(), ".zip" if support.module_name().startswith("bl_ext.") else "-legacy.zip"
        other = next(name for name in FILES if name != here)
        sentence = (other, here, f"{here.replace('-', '_')}{ending}")
        self.for_platforms(other)
        (self.package / self.own).write_bytes(b"of another processor")
        self.assert_status('WRONG_PLATFORM', *sentence)
        (self.package / self.own).rename(self.package / FILES[other])
        self.assert_status('WRONG_PLATFORM', *sentence)
        (self.package / FILES[other]).unlink()
        self.assert_status('WRONG_PLATFORM', *sentence)

    def test_broken_file(self):
        (self.package / self.own).write_bytes(b"not a shared library")
        self.assert_status('LOAD_ERROR', "could not be loaded", "reinstall")

    def test_other_version(self):
        manifest = self.package / "blender_manifest.toml"
        version = support.addon("core.native").addon_version()
        manifest.write_text(manifest.read_text().replace(f'version = "{version}"', 'version = "99.0.1"'))
        self.assert_status('VERSION_MISMATCH', version, "99.0.1", "restart")
