"""docs/contracts.md has a row for every public function of the library, by the names that its header gives the arguments."""

import re
import sys
import unittest
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "docs" / "scripts"))

from clang.cindex import AccessSpecifier, Cursor, CursorKind  # noqa: E402  (the program's own)

import cpp_reference  # noqa: E402  (found by the line above)

CALLED = {
    CursorKind.FUNCTION_DECL, CursorKind.FUNCTION_TEMPLATE, CursorKind.CXX_METHOD, CursorKind.CONSTRUCTOR,
}  # fmt: skip
NO_ROW = {
    "LeavesZero::LeavesZero(value)": "keeps any number",
}
"""Function -> why it has no row."""
COSTS = re.compile(r"^// Costs: ", re.MULTILINE)


def functions(cursor: Cursor, scope: tuple[str, ...] = ()) -> Iterator[tuple[str, Cursor]]:
    """(signature as in the table, declaration) of what can be called of a declaration in a namespace."""
    if cursor.kind in CALLED:
        names = [one.spelling for one in cursor.get_children() if one.kind == CursorKind.PARM_DECL]
        yield "::".join((*scope, re.sub(r"<.*", "", cursor.spelling))) + f"({', '.join(names)})", cursor
    elif cursor.kind in cpp_reference.TYPES:
        name = re.sub(r"<.*", "", cursor.spelling)
        for member in cursor.get_children():
            if member.access_specifier == AccessSpecifier.PUBLIC and not member.spelling.startswith("operator"):
                yield from functions(member, (*scope, name))


def namespace_of(cursor: Cursor) -> tuple[str, ...]:
    """The namespaces that a declaration stands in, without motus."""
    names: list[str] = []
    parent = cursor.semantic_parent
    while parent is not None and parent.kind == CursorKind.NAMESPACE:
        names.insert(0, parent.spelling)
        parent = parent.semantic_parent
    return tuple(names[1:])


def needs_no_row(cursor: Cursor) -> bool:
    """Whether it is deleted or defaulted, copies or moves, or tells what its object has: without arguments, and const."""
    if cursor.is_deleted_method() or cursor.is_default_method() or cursor.is_copy_constructor() or cursor.is_move_constructor():
        return True
    has_arguments = any(True for _ in cursor.get_arguments())
    return not has_arguments and (cursor.is_const_method() or cursor.kind == CursorKind.CONSTRUCTOR)


class Contracts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.declarations = cpp_reference.declarations()
        cls.declared = Counter(
            signature
            for cursors in cls.declarations.values()
            for cursor in cursors
            for signature, function in functions(cursor, namespace_of(cursor))
            if not needs_no_row(function)
        )
        cls.rows, topic = set(), ""
        for line in (ROOT / "docs" / "contracts.md").read_text(encoding="utf-8").splitlines():
            if line.startswith("## "):
                topic = line[3:]
            elif line.startswith("| `") and topic != "Moved from":
                cls.rows.add(("" if topic == "core" else topic + "::") + line.split("`")[1])

    def test_every_public_function_has_a_row(self):
        self.assertGreater(len(self.declared), 200)
        self.assertEqual(sorted(self.declared.keys() - self.rows - NO_ROW.keys()), [], "add a row in native/tests/contracts")

    def test_every_row_is_of_a_function(self):
        self.assertEqual(sorted(self.rows - self.declared.keys()), [], "a header has no such function, or other names")

    def test_every_header_with_functions_says_what_they_cost(self):
        for header, cursors in self.declarations.items():
            text = header.read_text(encoding="utf-8")
            if any(function for cursor in cursors for function in functions(cursor)):
                self.assertRegex(text.split("#pragma once")[0], COSTS, cpp_reference.name_of(header))


if __name__ == "__main__":
    unittest.main()
