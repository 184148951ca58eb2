"""Tests for finite numbers.

An infinite result must not reach a constraint, driver or modifier: Blender passes an infinite number on to everything that depends on it,
and keeps the number.
"""

from __future__ import annotations

from typing import Any

import bpy

from .. import native
from ..lazy import numpy as np
from ..refusals import INFINITE

_LOOKED_AT = frozenset(('FLOAT', 'INT', 'COLLECTION', 'POINTER'))


def share(value: float) -> float:
    """Clamp an influence to the range from 0 to 1. NaN, as a damaged file may have it, becomes 0."""
    return min(max(0.0, value), 1.0)


def is_finite(*numbers: np.ndarray[Any, Any]) -> bool:
    """Whether all numbers of contiguous arrays of floats are finite, and stay finite in single precision, which Blender uses.

    Needs the native module.
    """
    return bool(native.module.are_below(INFINITE, *numbers))


def has_bad_settings(settings: Any) -> bool:
    """Whether a number in a property group, lists and groups in it included, is not finite or outside its limits.

    Only a damaged file can have such a number.
    """
    return any(
        _is_bad(declared, getattr(settings, declared.identifier))
        for declared in settings.bl_rna.properties
        if declared.identifier != "rna_type" and declared.type in _LOOKED_AT and settings.is_property_set(declared.identifier)
    )


def _is_bad(declared: Any, value: Any) -> bool:
    if declared.type in {'COLLECTION', 'POINTER'}:
        entries = value if declared.type == 'COLLECTION' else (value,)
        return any(isinstance(entry, bpy.types.PropertyGroup) and has_bad_settings(entry) for entry in entries)
    numbers = value if declared.is_array else (value,)
    return not all(abs(number) < INFINITE and declared.hard_min <= number <= declared.hard_max for number in numbers)
