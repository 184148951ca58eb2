"""The add-on's modules import each other in one direction, and systems keep to what core offers them."""

import ast
import graphlib
import unittest
from pathlib import Path

ADDON = Path(__file__).resolve().parents[2] / "addon" / "motus"


def modules():
    """{name of a module of the add-on: its file}; "" is the package itself."""
    found = {}
    for path in ADDON.rglob("*.py"):
        parts = path.relative_to(ADDON).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def imports(name, path, known):
    """Names of the add-on's modules that a module imports, within functions too."""
    package = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    package = [part for part in package if part]
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        stem = package[:len(package) - node.level + 1] + (node.module.split(".") if node.module else [])
        for alias in node.names:
            full, parent = ".".join((*stem, alias.name)), ".".join(stem)
            found.add(full if full in known else parent)
    # Not the packages that the module is in, which list their modules.
    return {other for other in found if other in known and other != name and not f"{name}.".startswith(f"{other}.") and other}


class Imports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        known = modules()
        cls.graph = {name: imports(name, path, known) for name, path in known.items()}

    def test_all_are_seen(self):
        self.assertGreater(len(self.graph), 100)
        self.assertIn("core.wiring", self.graph["core.settings"])
        self.assertIn("core.lazy", self.graph["path.curves"])

    def test_no_circle(self):
        try:
            tuple(graphlib.TopologicalSorter(self.graph).static_order())
        except graphlib.CycleError as error:
            self.fail("modules import each other: " + " <- ".join(error.args[1]))

    def test_core_imports_no_system(self):
        for name, found in self.graph.items():
            if name.split(".")[0] == "core":
                outside = {other for other in found if other.split(".")[0] != "core"}
                self.assertEqual(outside, set(), name)

    def test_systems_import_neither_each_other_nor_the_wirings_insides(self):
        systems = {name for name, path in modules().items()
                   if path.name == "__init__.py" and name and "." not in name} - {"core", "demo", "translations"}
        self.assertIn("path", systems)
        for name, found in self.graph.items():
            own = name.split(".")[0]
            if own not in systems:
                continue
            for other in found:
                self.assertNotIn(other.split(".")[0], systems - {own}, f"{name} imports {other}")
                self.assertFalse(other.startswith("core.wiring."), f"{name} imports {other}")
