"""What is installed is whole, and of one version."""

import ast
import importlib.machinery
import re
import tomllib
import unittest
from pathlib import Path

import addon_utils

import support


class Package(unittest.TestCase):
    def setUp(self):
        self.folder = Path(support.addon().__file__).parent

    def test_native_module_is_this_pythons_own(self):
        native = support.addon("core.native")
        self.assertEqual(native.status.code, native.OK, native.status.sentence)
        self.assertTrue(native.module.__file__.endswith(importlib.machinery.EXTENSION_SUFFIXES[0]))

    def test_one_version(self):
        native = support.addon("core.native")
        version = native.addon_version()
        self.assertEqual(native.module.__version__, version)
        module = next(module for module in addon_utils.modules(refresh=False) if module.__name__ == support.module_name())
        self.assertEqual(".".join(map(str, addon_utils.module_bl_info(module)["version"])), version)

    def test_licence_and_manifest_are_included(self):
        for name in ("LICENSE", "blender_manifest.toml"):
            self.assertTrue((self.folder / name).is_file(), name)

    def test_the_manifest_asks_for_what_is_used(self):
        manifest = tomllib.loads((self.folder / "blender_manifest.toml").read_text(encoding="utf-8"))
        signs = {
            "clipboard": r"\.clipboard\b",
            "files": r"\bAddPresetBase\b|\.(images|movieclips|sounds|libraries)\.load\(|\bopen\(.*[\"']w|write_(text|bytes)\(",
            "network": r"(?m)^\s*(import|from) (urllib|requests|socket|http|ftplib|ssl)\b",
            "camera": r"(?m)^\s*(import|from) cv2\b",
            "microphone": r"(?m)^\s*(import|from) sounddevice\b",
        }
        sources = [path.read_text(encoding="utf-8") for path in self.folder.rglob("*.py")]
        used = {name for name, sign in signs.items() if any(re.search(sign, source) for source in sources)}
        self.assertEqual(set(manifest.get("permissions", {})), used)

    def test_nothing_is_included_that_does_not_belong(self):
        files = [path.relative_to(self.folder) for path in self.folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts]
        manual = {path.suffix for path in files if path.parts[0] == "manual"}
        others = {path.suffix for path in files if path.parts[0] != "manual"}
        self.assertLessEqual(others, {".py", ".so", ".whl", ".toml", "", ".svg", ".blend", ".json", ".png", ".dat"})
        self.assertEqual(manual, {".html", ".css"})

    def test_bl_info_only_where_blender_reads_it(self):
        source = (self.folder / "__init__.py").read_text(encoding="utf-8")
        names = [
            target.id
            for statement in ast.parse(source).body
            if isinstance(statement, ast.Assign)
            for target in statement.targets
            if isinstance(target, ast.Name)
        ]
        is_extension = support.module_name().startswith("bl_ext.")
        self.assertEqual("bl_info" in names, not is_extension)
