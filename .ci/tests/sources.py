"""The add-on's sources, read and parsed once for all tests that look through them."""

import ast
import functools
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "addon" / "motus"


@functools.cache
def text(path):
    """What stands in a file."""
    return path.read_text(encoding="utf-8")


@functools.cache
def tree(path):
    """A file's syntax tree."""
    return ast.parse(text(path))


@functools.cache
def nodes(path):
    """All that a file's syntax tree has, in the order of ast.walk."""
    return tuple(ast.walk(tree(path)))
