"""Checks of data stored in a file, which may have been made or damaged by anybody, before anything relies on them.

A custom property may have any type and length, and a text any content. Data of a different form than Motus stores raise Damaged;
the function of the solver's driver turns Damaged into a sentence for the panel.
"""

from __future__ import annotations

import json
import re
from typing import Any

import idprop

from ..refusals import INFINITE

LARGEST_TEXT = 1 << 22
"""Most characters of a JSON text. A rig with a hundred IK chains needs 40,000."""
DEEPEST = 16
"""Most lists and objects within each other in a JSON text.

Python's parser calls itself for each level, and Blender's evaluation threads have a small stack.
"""
LARGEST_NUMBER = 1 << 32

_BRACKET = re.compile(r"[\[{\]}]")


class Damaged(Exception):
    """Raised if stored data are not of the form that Motus stores."""


class Newer(Damaged):
    """Raised if stored data were made by a newer version of Motus."""


def doubles(value: Any, count: int | None = None) -> memoryview[float]:
    """Writable memoryview of a custom property that holds an array of float64 numbers.

    count: required length of the array; None allows any length. Raises Damaged if the property is anything else.
    """
    try:
        memory: memoryview[Any] = memoryview(value)
    except TypeError:
        raise Damaged("no array of numbers") from None
    if memory.format != 'd' or memory.readonly or count not in (None, len(memory)):
        raise Damaged("another array of numbers")
    return memory


def finite_doubles(value: Any, count: int) -> memoryview[float]:
    """As doubles(), of numbers that are finite in single precision, which Blender uses. Raises Damaged if the property is anything else."""
    memory = doubles(value, count)
    if not all(abs(number) < INFINITE for number in memory):
        raise Damaged("no finite numbers")
    return memory


def number(value: Any) -> float:
    """A custom property that holds a number, finite in single precision. Raises Damaged if the property is anything else."""
    if not fits(value, float):
        raise Damaged("no number")
    return float(value)


def text(value: Any) -> str:
    """A custom property that holds a text. Raises Damaged if the property is anything else."""
    if not isinstance(value, str):
        raise Damaged("no text")
    return value


def group(value: Any) -> Any:
    """A custom property that holds a group of properties. Raises Damaged if the property is anything else, such as a datablock."""
    if not isinstance(value, idprop.types.IDPropertyGroup):
        raise Damaged("no group")
    return value


def whole_numbers(value: Any, count: int) -> memoryview[int]:
    """Memoryview of a custom property that holds an array of 32-bit integers. Raises Damaged if the property is anything else.

    count: required length of the array.
    """
    try:
        memory = memoryview(value)
    except TypeError:
        raise Damaged("no array of whole numbers") from None
    if memory.format != 'i' or len(memory) != count:
        raise Damaged("another array of whole numbers")
    return memory


def parse(text: Any, form: Any) -> Any:
    """Parse a JSON text, and check that the content has a form (see fits()). Raises Damaged otherwise.

    Texts that are too long or nested too deep raise Damaged too.
    """
    if not isinstance(text, str) or len(text) > LARGEST_TEXT or _is_deep(text):
        raise Damaged("no text that can be read")
    try:
        said = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise Damaged("no JSON") from error
    if not fits(said, form):
        raise Damaged("another form")
    return said


def fits(value: Any, form: Any) -> bool:
    """Whether a value parsed from JSON has a given form.

    str, bool: a value of this type. int: an integer from 0 to LARGEST_NUMBER. float: a number that is finite in single precision, which
    Blender uses.
    [form]: a list in which each item has this form. (form, form): a list with exactly one item for each of these forms.
    {name: form}: an object with exactly these fields; a field whose name ends in "?" may be missing.
    A function: the value fits if the function returns true for it.
    """
    if isinstance(form, list):
        return isinstance(value, list) and all(fits(one, form[0]) for one in value)
    if isinstance(form, tuple):
        return isinstance(value, list) and len(value) == len(form) and all(map(fits, value, form))
    if isinstance(form, dict):
        return isinstance(value, dict) and _has_fields(value, form)
    return _FITS.get(form, form)(value)


def _has_fields(value: dict[str, Any], form: dict[str, Any]) -> bool:
    names = {name.rstrip("?") for name in form}
    return value.keys() <= names and all(
        fits(value[name.rstrip("?")], one) if name.rstrip("?") in value else name.endswith("?") for name, one in form.items()
    )


def _is_number(value: Any) -> bool:
    # An integer in JSON may be too large for a float, so that its size is checked.
    return (type(value) is float and abs(value) < INFINITE) or (type(value) is int and abs(value) <= LARGEST_NUMBER)


_FITS = {
    str: lambda value: isinstance(value, str),
    bool: lambda value: isinstance(value, bool),
    int: lambda value: type(value) is int and 0 <= value <= LARGEST_NUMBER,
    float: _is_number,
}


def _is_deep(text: str) -> bool:
    """Whether a JSON text nests lists and objects deeper than DEEPEST levels, which Motus never writes."""
    outside_strings = "".join(text.replace("\\\\", "").replace('\\"', "").split('"')[::2])
    depth = 0
    for bracket in _BRACKET.finditer(outside_strings):
        depth += 1 if bracket[0] in "[{" else -1
        if depth > DEEPEST:
            return True
    return False
