"""The page of the Python module motus_native, made of its stub: each class, method and function with its signature and docstring."""

import ast
import inspect
import re
import textwrap

import markdown_text

SHORT = re.compile(r"\b(?:numpy\.typing|numpy|typing|builtins)\.")
"""Modules that the stub names before each type."""
BEGIN = "How it is imported, and first examples: [The Python module](../../docs/python_module.md)."
WIDTH = 100
"""Most characters of a line in a signature."""


def page(stub):
    """The page's Markdown, of the stub's text."""
    module = ast.parse(stub)
    functions = [node for node in module.body if isinstance(node, ast.FunctionDef)]
    classes = [node for node in module.body if isinstance(node, ast.ClassDef)]
    parts = ["# Python reference: `motus_native`", BEGIN, _doc(module)]
    parts += ["## Functions", *(_function(name, group, "") for name, group in _overloads(functions))]
    for node in classes:
        parts += [f"## `{node.name}`", _doc(node)]
        methods = [one for one in node.body if isinstance(one, ast.FunctionDef) and _is_shown(one)]
        parts += [_function(name, group, f"{node.name}.") for name, group in _overloads(methods)]
    return "\n\n".join(part for part in parts if part) + "\n"


def _is_shown(node):
    """Whether a method is part of what the module promises: it is public and has a docstring, or makes the object."""
    return node.name == "__init__" or (not node.name.startswith("_") and ast.get_docstring(node) is not None)


def _overloads(nodes):
    """[(name, functions of that name)]: a stub has one for each way to call it."""
    groups = {}
    for node in nodes:
        groups.setdefault(node.name, []).append(node)
    return groups.items()


def _function(name, group, prefix):
    """Heading, signatures and docstring of a function or method."""
    if name == "__init__" and not any(node.args.args[1:] or node.args.kwonlyargs or ast.get_docstring(node) for node in group):
        return ""  # made by other functions alone
    signatures = "\n".join(_signature(node, prefix) for node in group)
    docs = dict.fromkeys(_doc(node) for node in group)
    shown = prefix[:-1] if name == "__init__" else f"{prefix}{name}"
    heading = f"### `{shown}`" + (" (new)" if name == "__init__" else "")
    return "\n\n".join((heading, f"```python\n{signatures}\n```", *filter(None, docs)))


def _signature(node, prefix):
    """How a function is called, a line if it is short and a line an argument otherwise."""
    is_property = any(ast.unparse(one) == "property" for one in node.decorator_list)
    name = prefix[:-1] if node.name == "__init__" else f"{prefix}{node.name}"
    returned = "" if node.name == "__init__" or node.returns is None else ast.unparse(node.returns)
    if is_property:
        return SHORT.sub("", f"{name}: {returned}")
    every = ast.unparse(node.args)
    arguments = [part for part in _split(every) if part != "self"]
    end = f" -> {returned}" if returned and returned != "None" else ""
    line = SHORT.sub("", f"{name}({', '.join(arguments)}){end}")
    if len(line) <= WIDTH:
        return line
    inside = "".join(f"    {argument},\n" for argument in arguments)
    return SHORT.sub("", f"{name}(\n{inside}){end}")


def _split(arguments):
    """The arguments of a signature; commas within brackets divide nothing."""
    parts, depth = [""], 0
    for letter in arguments:
        depth += (letter in "[(") - (letter in "])")
        if letter == "," and not depth:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def _doc(node):
    """A docstring as Markdown: its paragraphs, in which two spaces begin a new line, and what is indented as it stands."""
    paragraphs = re.split(r"\n\s*\n", inspect.cleandoc(ast.get_docstring(node, clean=False) or ""))
    return "\n\n".join(textwrap.indent(one, "    ") if one.startswith("  ") else _lines(one) for one in paragraphs if one.strip())


def _lines(paragraph):
    lines = re.split(r"(?<=[.:;]) {2,}", re.sub(r"(?<=[^.])\n", " ", paragraph).replace(".\n", ".  "))
    return "<br>\n".join(map(markdown_text.escaped, lines))
