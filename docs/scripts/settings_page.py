"""All settings that the interface shows, for the manual's site: read from the registered classes and the add-on's Spanish texts."""

import json
import math

import support

_UNITS = {
    'LENGTH': "m",
    'ROTATION': "°",
    'TIME': "s",
    'TIME_ABSOLUTE': "s",
    'VELOCITY': "m/s",
    'ACCELERATION': "m/s²",
    'MASS': "kg",
}
_KINDS = {'FLOAT': "number", 'INT': "whole number", 'BOOLEAN': "switch", 'STRING': "text"}
_UNBOUNDED = {'FLOAT': 1e30, 'INT': 2**31 - 1}
"""Limits of this size are Blender's own."""


def text():
    """The settings as JSON: {"systems": {name of a page: [the settings of a struct, ...]}}, each with its texts in English and Spanish."""
    pages = {}
    for table in support.addon("core.interface.manual").tables():
        titles = _both("title", table.title, table.translation_context)
        pages.setdefault(table.page, []).append({"struct": table.struct, **titles, "settings": [_setting(prop) for prop in table.settings]})
    return json.dumps({"systems": pages}, ensure_ascii=False, indent=1) + "\n"


def _setting(prop):
    found = {
        "id": prop.identifier,
        **_both("name", prop.name, prop.translation_context),
        **_both("text", prop.description),
        "kind": _kind(prop),
        "unit": _UNITS.get(getattr(prop, "unit", 'NONE'), ""),
        "range": _range(prop),
        "default": _default(prop),
    }
    if prop.type == 'ENUM':
        context = prop.translation_context
        items = prop.enum_items
        found["choices"] = [{"id": one.identifier, **_both("name", one.name, context), **_both("text", one.description)} for one in items]
    return found


def _both(key, english, context="*"):
    """{key: English, key_es: Spanish}; what Spanish says with the same word has no entry in the add-on's catalogue."""
    contexts = support.addon("translations.es").CONTEXTS
    return {key: english, f"{key}_es": contexts.get(context, {}).get(english) or contexts["*"].get(english, english)}


def _kind(prop):
    """What the setting holds: "number", "whole number", "switch", "text", "choice", "choices", "color", "vector", or a type of datablocks."""
    if prop.type == 'POINTER':
        return prop.fixed_type.identifier.lower()
    if prop.type == 'ENUM':
        return "choices" if prop.is_enum_flag else "choice"
    if getattr(prop, "is_array", False):
        return "color" if prop.unit == 'NONE' and prop.subtype == 'COLOR' else "vector"
    return _KINDS[prop.type]


def _range(prop):
    """The limits of a number, in the unit that the interface shows."""
    if prop.type not in _UNBOUNDED:
        return ""
    low, high = (value if abs(value) < _UNBOUNDED[prop.type] else None for value in (prop.hard_min, prop.hard_max))
    if low is not None and high is not None:
        return f"{_number(prop, low)} … {_number(prop, high)}"
    return f"≥ {_number(prop, low)}" if low is not None else f"≤ {_number(prop, high)}" if high is not None else ""


def _default(prop):
    """The default: of a choice its identifier, or several with commas between; of a switch "on" or "off".

    "" of a pointer, and of a setting that Blender does not store, which follows from others.
    """
    if prop.type == 'POINTER' or prop.is_skip_save:
        return ""
    if prop.type == 'ENUM':
        return (
            ", ".join(item.identifier for item in prop.enum_items if item.identifier in prop.default_flag)
            if prop.is_enum_flag
            else prop.default
        )
    values = prop.default_array if getattr(prop, "is_array", False) else [prop.default]
    if prop.type == 'BOOLEAN':
        return ", ".join("on" if value else "off" for value in values)
    return prop.default if prop.type == 'STRING' else ", ".join(_number(prop, value) for value in values)


def _number(prop, value):
    """A number in the unit that the interface shows, with as many digits as single precision has."""
    return f"{math.degrees(value) if prop.unit == 'ROTATION' else value:.6g}"
