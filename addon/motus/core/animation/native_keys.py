"""F-curves that the native module evaluates, many values at once: their keys, their extrapolation and a Cycles modifier."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import bpy

from .. import keeping, native
from ..evaluated import copies
from ..lazy import numpy as np

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

FEW = 16
"""Blender evaluates up to this many values of an F-curve of which no native FCurve is kept, since reading its keys takes longer."""
_NEAR = 0.011  # in frames; Blender does not evaluate the curve between keys that are nearer to each other
_NAMED = 3
"""Least number that foreach_get() gives for interpolations with an easing, such as ELASTIC; below are CONSTANT, LINEAR and BEZIER."""
_MODES = {'NONE': 0, 'REPEAT': 1, 'REPEAT_OFFSET': 2, 'MIRROR': 3}
"""Numbers of a Cycles modifier's modes in the native FCurve."""
_EXACT_SINCE = 4, 2
"""Version of Blender since which a Cycles modifier counts laps in double precision."""
_PROBES = 0.381966, 0.763932
"""Parts of the way between two keys, or of a lap beyond them, at which the native FCurve is compared with Blender's F-curve."""
_CLOSE = 1e-5  # greatest difference of the two, as a part of the value

_PLAYERS = keeping.OfEvaluation(
    "native F-curves of an evaluated action, or None", "address of the F-curve", "one for each F-curve that is read over time"
)


def player(curve: Any, count: int = FEW + 1) -> Any:
    """The native FCurve of an F-curve; None if only Blender can evaluate the F-curve, or is as fast for `count` values.

    The native FCurve of an evaluated action is kept until the action's keys are edited.
    """
    if native.module is None:
        return None
    action = curve.id_data
    if not isinstance(action, bpy.types.Action) or not action.is_evaluated:
        return read(curve) if count > FEW else None
    kept, place = _PLAYERS.within(copies.found_of_action(action)), curve.as_pointer()
    if place not in kept:
        kept[place] = read(curve)
    return kept[place]


def read(curve: Any) -> Any:
    """Read the keys and modifiers of an F-curve into a native FCurve; None if only Blender can evaluate the F-curve."""
    points, count = curve.keyframe_points, len(curve.keyframe_points)
    acting = _acting(curve)
    if count == 0 or any(one.type != 'CYCLES' for one in acting):
        return None
    columns = np.empty((3, 2 * count), np.float32)
    for column, name in zip(columns, ("co", "handle_left", "handle_right")):
        points.foreach_get(name, column)
    keys = np.ascontiguousarray(np.concatenate([column.reshape(-1, 2) for column in columns], axis=1))
    kinds = _numbers(points, "interpolation", np.int32)
    if not np.isfinite(keys).all() or not (np.diff(keys[:, 0]) > _NEAR).all():
        return None
    easings = shapes = None
    if kinds.max() >= _NAMED:
        easings = _numbers(points, "easing", np.int32)
        shapes = np.column_stack([_numbers(points, name, np.float32) for name in ("back", "amplitude", "period")])
    try:
        found = native.module.FCurve(keys, kinds, curve.extrapolation == 'LINEAR', easings, shapes, _cycles(*acting))
    except ValueError:  # numbers of a kind, or of a modifier, that a later version of Blender may have
        return None
    return found if _agrees(found, curve, keys) else None


def _numbers(points: Any, name: str, kind: Any) -> Array:
    found = np.empty(len(points), kind)
    points.foreach_get(name, found)
    return found


def _acting(curve: Any) -> list[Any]:
    """The modifiers that have an effect. Blender leaves out a Cycles modifier that is not the first modifier, even if that one is muted."""
    return [one for index, one in enumerate(curve.modifiers) if not one.mute and one.is_valid and (one.type != 'CYCLES' or index == 0)]


def _cycles(modifier: Any = None) -> Array | None:
    """The numbers of a Cycles modifier as the native FCurve reads them; None without a modifier."""
    if modifier is None:
        return None
    limits = -math.inf, math.inf, 0.0, 0.0
    if modifier.use_restricted_range:
        limits = modifier.frame_start, modifier.frame_end, modifier.blend_in, modifier.blend_out
    modes, counts = (modifier.mode_before, modifier.mode_after), (modifier.cycles_before, modifier.cycles_after)
    influence = modifier.influence if modifier.use_influence else 1.0
    return np.array((*(_MODES[mode] for mode in modes), *counts, *limits, influence, bpy.app.version >= _EXACT_SINCE), float)


def _agrees(found: Any, curve: Any, keys: Array) -> bool:
    """Whether a native FCurve gives the values of Blender's F-curve at some frames.

    Blender does not show in Python whether an F-curve rounds to whole numbers, jumps from key to key, or has all its modifiers disabled.
    """
    first, last = keys[0, 0], keys[-1, 0]
    lap = float(last - first) or 1.0
    frames = [edge + part * lap for edge in (first - lap, last) for part in _PROBES]
    if len(keys) > 1:
        at = int(np.argmax(np.abs(np.diff(keys[:, 1]))))
        frames += [keys[at, 0] + part * (keys[at + 1, 0] - keys[at, 0]) for part in _PROBES]
    for frame, value in zip(map(float, frames), found.values(frames).tolist()):
        wanted = curve.evaluate(frame)
        if not abs(value - wanted) <= _CLOSE * max(1.0, abs(wanted)):
            return False
    return True
