"""The add-on's modules import each other downward only, as docs/architecture.md lists the floors, and in no circle when Python executes them."""

import ast
import graphlib
import re
import unittest

import sources
from sources import ADDON, ROOT

MOST_FILES = 12
"""Python files in a room."""
FLAGS = {"is_relative", "lays_pose", "moves_points", "same_bits"}
"""Fields of System that say how its results reach the scene."""
READ_FLAGS = ("core.declare", "core.wiring.hubs.traits")
"""The only modules, or rooms of modules, that read FLAGS."""


def modules():
    """{name of a module of the add-on: its file}; "" is the package itself."""
    found = {}
    for path in ADDON.rglob("*.py"):
        parts = path.relative_to(ADDON).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def floors():
    """The rooms of core from top to bottom, each a list of names such as core.wiring.sinks: the first code block below the heading *Floors*."""
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    block = re.search(r"^## Floors\n.*?```text\n(.*?)```", text, re.DOTALL | re.MULTILINE)[1]
    return [
        ["core." + room.replace("/", ".") for room in re.split(r"\s{4,}", line)[0].split()] for line in block.splitlines() if line.strip()
    ]


def imports(name, path, known):
    """Names of the add-on's modules that a module imports, within functions too."""
    package = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    package = [part for part in package if part]
    found = set()
    for node in sources.nodes(path):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        stem = package[: len(package) - node.level + 1] + (node.module.split(".") if node.module else [])
        for alias in node.names:
            full, parent = ".".join((*stem, alias.name)), ".".join(stem)
            found.add(full if full in known else parent)
    return {other for other in found if other in known and other != name and other}


def packages_of(name):
    """The packages that a module lies in, the outermost first; a package does not lie in itself."""
    parts = name.split(".")
    return [".".join(parts[:count]) for count in range(1, len(parts))]


def executed(name, graph):
    """What Python executes before the body of a module goes on: what it imports, and the packages of that which are not its own too."""
    own = {name, *packages_of(name)}
    return {one for other in graph[name] for one in (*packages_of(other), other)} - own


def uses_other_systems(path):
    """Names of the systems that a module looks up among the registered ones."""
    found = set()
    for node in sources.nodes(path):
        if (
            isinstance(node, ast.Subscript)
            and ast.unparse(node.value).split(".")[-1] == "registered"
            and isinstance(node.slice, ast.Constant)
        ):
            found.add(node.slice.value)
    return found


def flags_read(path):
    """Names of the FLAGS that a module reads from a system. Members and layouts have fields of the same names, which do not count."""
    return {
        node.attr
        for node in sources.nodes(path)
        if isinstance(node, ast.Attribute) and node.attr in FLAGS and ast.unparse(node.value).lower().endswith("system")
    }


class Imports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.known = modules()
        cls.graph = {name: imports(name, path, cls.known) for name, path in cls.known.items()}
        cls.floors = floors()
        cls.level = {room: number for number, rooms in enumerate(cls.floors) for room in rooms}
        cls.systems = {name for name, path in cls.known.items() if path.name == "__init__.py" and name and "." not in name} - {
            "core",
            "demo",
            "translations",
        }

    def room(self, module):
        """The innermost room that a module of core lies in, which may be the module itself."""
        return next((one for one in (module, *reversed(packages_of(module))) if one in self.level), None)

    def test_all_are_seen(self):
        self.assertGreater(len(self.graph), 100)
        self.assertIn("core.wiring", self.graph["core.settings.system_settings"])
        self.assertIn("core.lazy", self.graph["path.curves"])
        self.assertIn("core.wiring.attaching.attach", executed("core.settings.system_settings", self.graph) | self.graph["core.wiring"])
        self.assertIn("path", self.systems)

    def test_no_circle_in_the_order_of_execution(self):
        order = {name: executed(name, self.graph) for name in self.graph}
        try:
            tuple(graphlib.TopologicalSorter(order).static_order())
        except graphlib.CycleError as error:
            self.fail("modules are executed before they are whole: " + " <- ".join(error.args[1]))

    def test_no_module_reads_a_package_that_it_lies_in(self):
        """Such a package is half made while its modules are executed."""
        for name, found in self.graph.items():
            self.assertEqual(found & set(packages_of(name)), set(), name)

    def test_every_module_of_core_stands_on_a_floor(self):
        inside = [name for name in self.graph if name.startswith("core.")]
        self.assertEqual([name for name in inside if self.room(name) is None], [])
        self.assertEqual([room for room in self.level if room not in self.known], [])

    def test_floors_import_downward_only(self):
        for name, found in self.graph.items():
            if not name.startswith("core."):
                continue
            room = self.room(name)
            for other in filter(lambda one: one.startswith("core."), found):
                below = self.room(other)
                self.assertTrue(room == below or self.level[room] < self.level[below], f"{name} ({room}) imports {other} ({below})")

    def test_rooms_are_small(self):
        for folder in {path.parent for path in self.known.values()}:
            files = len(list(folder.glob("*.py")))
            if folder.relative_to(ADDON).parts[:1] == ("core",):
                self.assertLessEqual(files, MOST_FILES, folder)

    def test_core_imports_no_system(self):
        for name, found in self.graph.items():
            if name.split(".")[0] == "core":
                outside = {other for other in found if other.split(".")[0] != "core"}
                self.assertEqual(outside, set(), name)
                if name != "core.lazy":  # which imports what stands outside of the add-on
                    self.assertNotIn("import_module", sources.text(self.known[name]), f"{name} hides what it imports")

    def test_systems_import_neither_each_other_nor_the_wirings_insides(self):
        for name, found in self.graph.items():
            own = name.split(".")[0]
            if own not in self.systems:
                continue
            for other in found:
                self.assertNotIn(other.split(".")[0], self.systems - {own}, f"{name} imports {other}")
                self.assertFalse(other.startswith("core.wiring."), f"{name} imports {other}")

    def test_systems_do_not_look_each_other_up(self):
        for name, path in self.known.items():
            own = name.split(".")[0]
            if own in self.systems:
                others = {one for one in uses_other_systems(path) if one != own and not one.startswith(f"{own}_")}
                self.assertEqual(others, set(), f"{name} reaches into another system: let that offer a function (Feature.offers)")

    def test_flags_of_a_system_are_read_in_one_place(self):
        found = {name: flags_read(path) for name, path in self.known.items()}
        inside = {name for name in found if name.startswith(READ_FLAGS)}
        self.assertGreaterEqual(set().union(*(found[name] for name in inside)), FLAGS - {"lays_pose", "moves_points"})
        self.assertEqual({name: flags for name, flags in found.items() if flags and name not in inside}, {})


if __name__ == "__main__":
    unittest.main()
