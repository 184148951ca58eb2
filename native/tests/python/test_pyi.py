"""The committed stub and the built module say the same: names, parameters and defaults."""

import ast
import unittest
from pathlib import Path

import motus_native

STUB = Path(__file__).resolve().parents[2] / "bindings" / "motus_native.pyi"


def signature(node):
    """(name, default) of each parameter, "**" for keyword options; self and annotations left out."""
    arguments = node.args
    names = [argument.arg for argument in arguments.posonlyargs + arguments.args]
    defaults = [None] * (len(names) - len(arguments.defaults)) + [ast.literal_eval(d) for d in arguments.defaults]
    has_default = [False] * (len(names) - len(arguments.defaults)) + [True] * len(arguments.defaults)
    rows = [row for row in zip(names, has_default, defaults) if row[0] != "self"]
    rows += [(a.arg, d is not None, d and ast.literal_eval(d)) for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return rows + ([("**", False, None)] if arguments.kwarg else [])


def documented_signature(function):
    """The signature that pybind11 writes as the first line of a docstring."""
    line = function.__doc__.splitlines()[0]
    return signature(ast.parse(f"def {line}: ...").body[0])


def stub_members(body):
    """Public names in a stub's module or class -> the nodes that define them (several where overloaded)."""
    members = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            name = node.name
        elif isinstance(node, ast.AnnAssign):
            name = node.target.id
        elif isinstance(node, ast.Assign):
            name = node.targets[0].id
        else:
            continue
        if not name.startswith("_") or name in ("__init__", "__version__"):
            members.setdefault(name, []).append(node)
    return members


def own_names(owner):
    return {name for name in vars(owner) if not name.startswith("_")}


class StubTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stub = stub_members(ast.parse(STUB.read_text(encoding="utf-8")).body)

    def compare(self, path, nodes, real):
        for node in nodes:
            if isinstance(node, ast.Assign):
                self.assertEqual(ast.literal_eval(node.value), real, path)
            elif isinstance(node, ast.AnnAssign):
                self.assertFalse(callable(real), path)
            elif any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list):
                self.assertIsInstance(real, property, path)
            else:
                self.assertEqual(signature(node), documented_signature(real), path)

    def test_the_module_has_the_stub_s_names(self):
        self.assertEqual(own_names(motus_native), set(self.stub) - {"__version__"})
        self.assertIsInstance(motus_native.__version__, str)

    def test_functions(self):
        functions = {name: nodes for name, nodes in self.stub.items() if isinstance(nodes[0], ast.FunctionDef)}
        self.assertIn("follow", functions)
        for name, nodes in functions.items():
            self.compare(name, nodes, getattr(motus_native, name))

    def test_classes(self):
        classes = {name: nodes[0] for name, nodes in self.stub.items() if isinstance(nodes[0], ast.ClassDef)}
        self.assertIn("Curve", classes)
        for name, node in classes.items():
            real = getattr(motus_native, name)
            members = stub_members(node.body)
            self.assertEqual([base.id for base in node.bases] or ["pybind11_object"], [b.__name__ for b in real.__bases__])
            self.assertEqual(own_names(real), set(members) - {"__init__"}, name)
            for member, nodes in members.items():
                self.compare(f"{name}.{member}", nodes, getattr(real, member))

    def test_every_public_name_has_a_manual(self):
        for name in own_names(motus_native):
            self.assertTrue(getattr(motus_native, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
