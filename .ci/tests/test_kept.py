"""What the add-on keeps is declared in core/keeping.py, and stands in docs/kept.md: nothing is kept in another way."""

import ast
import re
import unittest

import sources
from sources import ADDON, ROOT

KEEPING = "core/keeping.py"
LIFETIMES = {"OfEvaluation", "OfThread", "OfFile", "OfProcess", "OfLibrary", "WhileAnswering"}
CONTAINERS = {"dict", "list", "set", "OrderedDict", "defaultdict", "Counter", "deque"}
CHANGES = {"add", "append", "clear", "discard", "extend", "insert", "move_to_end", "pop", "popitem", "remove", "setdefault", "update"}
WAYS = {"cache", "lru_cache", "popitem", "local", "WeakKeyDictionary", "WeakValueDictionary", "WeakSet"}
"""Names from functools, collections, threading and weakref by which something may be kept; cached_property goes with its object."""

NO_CACHE = {
    "core/declare/registry.py": ("registered", "the systems"),
    "core/evaluated/copies.py": ("_latest", "the number that was given last"),
    "core/evaluated/read_keys.py": ("readings _most _at_work", "who is to be called again when keys are edited"),
    "core/blender/frames.py": ("_reading", "how many evaluations go on whose results are read"),
    "core/evaluated/shares.py": ("_edits _waits", "the number of edits, and whether all work is waited for"),
    "core/file/deleted.py": ("_stood _deleted _is_new _changes", "which objects have been deleted since the file was opened"),
    "core/interface/assets/shelf.py": ("_undo", "how to take back what was registered"),
    "core/interface/menus.py": ("_entries", "entries of menus"),
    "core/interface/overlay.py": ("_handler _failed", "the handler that draws, and what it has warned of"),
    "core/interface/panels.py": ("menus_of_scenes", "entries of menus"),
    "core/interface/view/graph.py": ("_graphs", "Blender's previews, which are to be freed"),
    "core/interface/view/offering.py": ("pressed", "the buttons that were pressed"),
    "core/interface/view/toolbar.py": ("_registered", "tools in the toolbar"),
    "core/interface/view/viewports.py": ("_all", "what viewports were like before, of all who have changed it"),
    "core/registration.py": ("_undo", "how to take back what was registered"),
    "core/tracks/solved.py": ("_asked", "questions that are being answered, by which a loop is noticed"),
    "core/wiring/attaching/overrides.py": ("_known", "healing: marks of overrides, to be compared"),
    "core/wiring/healing/relations.py": ("_known", "healing: what objects hang on, to be compared"),
    "drivers/functions.py": ("_said", "which warnings were written"),
    "pull/window/cursor.py": ("_handle _failed", "the handler that draws, and what it has warned of"),
    "pull/window/hover.py": ("_kept _wanted", "the mesh under the tool in hand, until anything changes it"),
    "pull/window/inset.py": (
        "_handle _buffers _failed",
        "the handler that draws, its pictures, which are to be freed, and what it has warned of",
    ),
    "pull/window/stage.py": ("_on", "the stroke that is drawn"),
}
"""File -> (names of the containers that its module has and changes, what they are instead of a cache)."""


class Source:
    """A module's syntax tree: the statements of its body, and all its nodes."""

    def __init__(self, body, nodes):
        self.body, self.nodes = body, nodes

    @classmethod
    def of_file(cls, path):
        return cls(sources.tree(path).body, sources.nodes(path))

    @classmethod
    def of_text(cls, text):
        tree = ast.parse(text)
        return cls(tree.body, tuple(ast.walk(tree)))


def is_container(value):
    """Whether an expression makes something that can be changed."""
    if isinstance(value, ast.Call):
        return ast.unparse(value.func).rpartition(".")[2] in CONTAINERS
    return isinstance(value, (ast.Dict, ast.List, ast.Set, ast.DictComp, ast.ListComp, ast.SetComp))


def containers(body):
    """Names that a module or class binds to containers."""
    found = set()
    for node in body:
        if isinstance(node, (ast.Assign, ast.AnnAssign)) and node.value is not None and is_container(node.value):
            found |= {
                one.id
                for target in getattr(node, "targets", [getattr(node, "target", None)])
                for one in ast.walk(target)
                if isinstance(one, ast.Name)
            }
    return found


def changed(source):
    """The last part of the names of all that a module changes: by a key, by a method, or within `global`."""
    found = set()
    for node in source.nodes:
        where = None
        if isinstance(node, ast.Subscript) and isinstance(node.ctx, (ast.Store, ast.Del)):
            where = node.value
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in CHANGES:
            where = node.func.value
        elif isinstance(node, ast.AugAssign):
            where = node.target
        elif isinstance(node, ast.Global):
            found.update(node.names)
        if where is not None:
            found.add(ast.unparse(where).rpartition(".")[2])
    return found


def kept_without_declaration(source):
    """Names of containers of a module, or of its classes, that are changed or named as a variable is; and of what is changed by `global`."""
    every = containers(source.body)
    of_classes = set().union(*(containers(node.body) for node in source.nodes if isinstance(node, ast.ClassDef)))
    touched = changed(source)
    by_global = {name for node in source.nodes if isinstance(node, ast.Global) for name in node.names}
    # A module's container may be changed by another module, if it is not named as a constant is.
    return {name for name in every if name.upper() != name or name in touched} - {"classes"} | of_classes & touched | by_global


def ways(source):
    """Which of WAYS a module uses."""
    names = {node.attr for node in source.nodes if isinstance(node, ast.Attribute)}
    names |= {alias.name for node in source.nodes if isinstance(node, ast.ImportFrom) and node.level == 0 for alias in node.names}
    return names & WAYS


def declarations(nodes):
    """Calls that declare something kept, of these nodes of a syntax tree."""
    return [node for node in nodes if isinstance(node, ast.Call) and ast.unparse(node.func) in {f"keeping.{kind}" for kind in LIFETIMES}]


class Kept(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sources = {path.relative_to(ADDON).as_posix(): Source.of_file(path) for path in sorted(ADDON.rglob("*.py"))}

    def test_what_counts_as_kept(self):
        for text, wanted in (
            ("_known = {}\ndef f(x):\n    _known[x] = 1", {"_known"}),
            ("KNOWN = {}\ndef f(x):\n    KNOWN.setdefault(x, 1)", {"KNOWN"}),
            ("_known = dict()", {"_known"}),
            ("_last = [None]", {"_last"}),
            ("class A:\n    known = {}\n    def f(self):\n        self.known[1] = 2", {"known"}),
            ("_last = None\ndef f():\n    global _last\n    _last = 1", {"_last"}),
            ("NAMES = {'a': 1}", set()),
            ("_NAMES = ['a']", set()),
            ("def f():\n    found = {}\n    found[1] = 2", set()),
            ("class A:\n    bl_options = {'UNDO'}", set()),
        ):
            with self.subTest(text):
                self.assertEqual(kept_without_declaration(Source.of_text(text)), wanted)
        for text in ("@functools.lru_cache(maxsize=4)\ndef f(): pass", "from functools import cache", "x.popitem(last=False)"):
            self.assertTrue(ways(Source.of_text(text)), text)

    def test_nothing_is_kept_without_a_declaration(self):
        for name, source in self.sources.items():
            names, _ = NO_CACHE.get(name, ("", ""))
            found = kept_without_declaration(source) if name != KEEPING else set()
            with self.subTest(name):
                self.assertEqual(
                    found, set(names.split()), "declare it by core/keeping.py, or say in NO_CACHE what it is instead of a cache"
                )
                if name != KEEPING:
                    self.assertEqual(ways(source), set(), "keep it by core/keeping.py")
        self.assertEqual(NO_CACHE.keys() - self.sources.keys(), set())

    def test_what_is_kept_with_a_copy_is_declared_too(self):
        for name in self.sources:
            text = sources.text(ADDON / name) if name != KEEPING else ""
            self.assertEqual(re.findall(r"(?:copy|copies\.\w+\([^()]*\))\.found\b", text), [], f"{name}: use OfEvaluation.on()")

    def test_declarations_are_made_once_by_a_module(self):
        for name, source in self.sources.items():
            of_module = [
                call for node in source.body if isinstance(node, (ast.Assign, ast.AnnAssign)) for call in declarations(ast.walk(node))
            ]
            self.assertEqual(len(declarations(source.nodes)), len(of_module), f"{name} declares in a function")

    def test_all_stand_on_the_page(self):
        page = (ROOT / "docs" / "kept.md").read_text(encoding="utf-8")
        count = 0
        for name, source in self.sources.items():
            for call in declarations(source.nodes):
                count += 1
                what, module = ast.literal_eval(call.args[0]), name.removesuffix(".py").replace("/", ".")
                is_there = any(what in line and f"`{module}`" in line for line in page.splitlines())
                self.assertTrue(is_there, f"run ./motus docs kept: {what} of {module} is missing")
        self.assertGreater(count, 25)


if __name__ == "__main__":
    unittest.main()
