"""Without a usable native module the add-on still registers, and says in one sentence what to do."""

import tempfile
import unittest
from pathlib import Path

import support

REPORT = """
import support
support.enable()
native = support.addon("core.native")
print("status:", native.status.code, "|", native.status.sentence, "|", native.module is None)
support.disable()
assert not support.is_enabled()
print("took it all back")
"""


class NativeStatus(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="motus-test-")
        self.addCleanup(folder.cleanup)
        self.profile = support.copy_profile(folder.name)
        self.package = support.addon_folder(self.profile)
        self.modules = sorted(self.package.glob("motus_native.*.so"))
        # Only the module that this Blender's Python takes matters here, so the other ABIs go.
        self.own = Path(support.addon("core.native").module.__file__).name
        for module in self.modules:
            if module.name != self.own:
                module.unlink()

    def assert_status(self, code, *parts):
        """A fresh Blender enables and disables the add-on; its status is `code`, and the sentence contains `parts`."""
        exit_status, output = support.run_blender(REPORT, profile=self.profile, enabled=False)
        self.assertEqual(exit_status, 0, output)
        self.assertIn("took it all back", output)
        line = next(line for line in output.splitlines() if line.startswith("status: "))
        found, sentence, is_none = line.removeprefix("status: ").split(" | ")
        self.assertEqual(found, code, output)
        for part in parts:
            self.assertIn(part, sentence)
        self.assertEqual(is_none, str(code != 'OK'))

    def test_untouched_copy_is_ok(self):
        self.assert_status('OK')

    def test_missing(self):
        (self.package / self.own).unlink()
        self.assert_status('MISSING', "missing", "install")

    def test_wrong_abi(self):
        (self.package / self.own).rename(self.package / "motus_native.cpython-39-x86_64-linux-gnu.so")
        self.assert_status('WRONG_ABI', "Python 3.9", "install")

    def test_broken_file(self):
        (self.package / self.own).write_bytes(b"not a shared library")
        self.assert_status('LOAD_ERROR', "could not be loaded", "reinstall")

    def test_other_version(self):
        manifest = self.package / "blender_manifest.toml"
        version = support.addon("core.native").addon_version()
        manifest.write_text(manifest.read_text().replace(f'version = "{version}"', 'version = "99.0.1"'))
        self.assert_status('VERSION_MISMATCH', version, "99.0.1", "restart")
