"""Tests whether a scale or an object mirrors, that is, turns right-handed shapes into left-handed ones (Matrix.is_negative)."""

from __future__ import annotations

from typing import Any

import bpy


def scale_is_mirrored(scale: Any) -> bool:
    """Whether a scale (x, y, z) mirrors: whether the product of its factors is negative."""
    return scale[0] * scale[1] * scale[2] < 0.0


def is_constant(obj: bpy.types.Object) -> bool:
    """Whether only edits of an object change what is_mirrored() returns: it has no parent, and nothing can animate its scale."""
    animation = obj.animation_data
    if obj.parent is not None or (animation is not None and (animation.action or animation.nla_tracks)):
        return False
    return animation is None or not any(driver.data_path in {"scale", "delta_scale"} for driver in animation.drivers)


def is_mirrored(obj: bpy.types.Object | None) -> bool:
    """Whether the scale of an object together with that of its parent objects mirrors it; the scale of parent bones does not count.

    Reads the properties of the objects, without an evaluation.
    """
    found = False
    while obj is not None:
        found ^= scale_is_mirrored(obj.scale) ^ scale_is_mirrored(obj.delta_scale)
        if obj.parent is not None:
            found ^= obj.matrix_parent_inverse.is_negative
        obj = obj.parent
    return found
