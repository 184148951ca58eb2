"""Value of one number property under NLA strips: their times, extrapolation, influence and blending, as Blender evaluates them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from ..blender import actions
from ..evaluated import read_keys
from ..lazy import numpy as np
from . import keys
from .reason import Reason

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

SAME = 2.0**-23
"""Blender takes two numbers for equal if they differ by less (frames, influences)."""
SCALES = {"scale", "delta_scale"}
"""Names of properties that the blend mode Combine multiplies."""
REPEATS = 1000
"""Most repetitions of a strip for which Stack.bounds() gives the frames of keys."""


def acting(curves: Any, data_path: str, index: int) -> Any:
    """The F-curve in `curves` (from actions.curves_of) that animates a number property; None if there is none, or if it has no effect."""
    curve = curves.find(data_path, index=index) if curves else None
    if curve is None or curve.is_empty or curve.mute or (curve.group and curve.group.mute) or not curve.is_valid:
        return None
    return curve


def animates(strip: Any, data_path: str, index: int) -> bool:
    """Whether an unmuted NLA strip, or a strip inside a meta strip, has an F-curve with an effect on an element of a property."""
    if strip.mute:
        return False
    if strip.type == 'META':
        return any(animates(inner, data_path, index) for inner in strip.strips)
    return _curve(strip, data_path, index) is not None


def _curve(strip: Any, data_path: str, index: int) -> Any:
    return acting(read(strip), data_path, index)


def read(player: Any) -> Any:
    """F-curves of an AnimData, an NLA strip or None, as actions.curves_of() returns them; records that the solver at work has read them."""
    if read_keys.is_noting() and player and player.action:
        read_keys.number_of(player.action)
    return actions.curves_of(player)


class Stack:
    """Value over time of one number property that several NLA strips and the active action animate.

    layers: the NLA tracks and the active action, the lowest first. number: the property, as a channel.Number.
    """

    def __init__(self, layers: list[Any], number: Any) -> None:
        self._layers, self._number = layers, number

    @classmethod
    def of(cls, animation: Any, data_path: str, number: Any, top: Any) -> Stack | Reason:
        """Stack of the NLA strips and the active action that animate a property; a Reason if Blender's result depends on earlier frames.

        animation: AnimData. number: the property, as a channel.Number. top: the property's F-curve in the active action, or None.
        A Reason is also returned for tweak mode, solo tracks, and blend modes or strip settings that are not reproduced here.
        """
        unknown = Reason(Reason.STRIPS, thing=animation.id_data.name)
        if animation.use_tweak_mode or any(track.is_solo for track in animation.nla_tracks):
            return unknown
        index = max(number.index, 0)
        layers: list[_Track | _Acting] = [
            _Track([(strip, _curve(strip, data_path, index)) for strip in track.strips])
            for track in animation.nla_tracks
            if not track.mute and len(track.strips)
        ]
        if animation.action:
            layers.append(_Acting(animation, top))
        layers = [layer for layer in layers if layer.animates]
        # At times at which no layer sets the property, it keeps the value of the frame before.
        if not any(layer.is_always for layer in layers):
            return unknown
        if not all(layer.is_known(number, data_path) for layer in layers):
            return unknown
        return cls(layers, number)

    def values(self, times: Array) -> Array:
        """Blended values (n,) at times, (n,) frames of the scene, without the rounding for the property's type."""
        times = np.asarray(times, np.float32).astype(float)
        lower = np.full(len(times), self._number.default)
        for layer in self._layers:
            for upper, influence, kind, at in layer.parts(times):
                lower[at] = _blended(kind, lower[at], upper, influence, self._number)
        return lower

    def bounds(self, first: float, last: float) -> list[float]:
        """Rising frames from first to last; the blended value is smooth between neighbours."""
        inner = {frame for layer in self._layers for frame in layer.bounds(first, last)}
        return keys.union([[first, *inner, last]])

    @property
    def stamp(self) -> Any:
        """Hashable value that changes whenever the blended values may change; None if an edit of a layer cannot be detected."""
        return together(layer.stamp for layer in self._layers)


def together(stamps: Iterable[Any]) -> tuple[Any, ...] | None:
    """Combine several stamps (hashable values that change with their input) into one; None if one of them is None."""
    found = tuple(stamps)
    return None if None in found else found


def stamp_of_action(player: Any) -> tuple[int, int] | None:
    """Hashable value that changes with the action and slot that an evaluated AnimData or NLA strip plays, and with the action's keys.

    None for an original datablock, or without an action.
    """
    action = player.action
    number = action and read_keys.number_of(action)
    # action_slot_handle exists since actions have slots (Blender 4.4).
    return None if number is None else (number, getattr(player, "action_slot_handle", 0))


def stamp_of(animation: Any) -> tuple[Any, ...] | None:
    """Hashable value that changes whenever the action or the NLA strips of evaluated animation data change; drivers are not covered.

    () if there is no animation data; None if edits cannot be detected.
    """
    if animation is None:
        return ()
    acting = (
        together((stamp_of_action(animation), animation.action_influence, animation.action_blend_type, animation.action_extrapolation))
        if animation.action
        else ()
    )
    if not animation.nla_tracks:
        return acting
    return together(
        (
            acting,
            animation.use_nla,
            animation.use_tweak_mode,
            *(together((track.mute, track.is_solo, *map(_strip_stamp, track.strips))) for track in animation.nla_tracks),
        )
    )


def keys_stamp(id_data: Any) -> tuple[int, int] | None:
    """Stamp that changes with any key of an evaluated datablock's action; None without an action, or if the datablock has NLA strips."""
    animation = id_data.animation_data
    if animation is None or (animation.use_nla and animation.nla_tracks):
        return None
    return stamp_of_action(animation)


def _blended(kind: str, lower: Array, upper: Array, influence: Any, number: Any) -> Array:
    if kind == 'ADD':
        return lower + upper * influence
    if kind == 'SUBTRACT':
        return lower - upper * influence
    if kind == 'MULTIPLY':
        return influence * (lower * upper) + (1.0 - influence) * lower
    if kind == 'COMBINE':
        if number.name in SCALES:
            return lower * _powers(upper / (number.default or 1.0), influence)
        return lower + (upper - number.default) * influence
    return lower * (1.0 - influence) + upper * influence


def _powers(bases: Array, exponents: Any) -> Array:
    # math.pow, since NumPy's results may differ in their last bit from call to call.
    pairs = zip(bases.tolist(), np.broadcast_to(exponents, bases.shape).tolist())
    return np.array([math.pow(base, exponent) if base >= 0.0 or exponent.is_integer() else math.nan for base, exponent in pairs])


def _is_blend_known(kind: str, number: Any) -> bool:
    if kind == 'COMBINE':
        return number.subtype != 'QUATERNION' and (number.name in SCALES or "scale" not in number.name)
    return kind in {'ADD', 'SUBTRACT', 'MULTIPLY', 'REPLACE'}


class _Acting:
    """The active action as the topmost layer of a Stack, above the NLA tracks. curve: the property's F-curve in the action, or None."""

    def __init__(self, animation: Any, curve: Any) -> None:
        self._animation, self._curve = animation, curve
        self.animates = curve is not None and animation.action_influence > 0.0
        start, end = animation.action.frame_range
        is_endless = animation.action_extrapolation != 'NOTHING'
        self._start: float
        self._end: float
        self._start, self._end = (-np.inf, np.inf) if is_endless else (start, max(end, start + 1.0))
        self.is_always = self.animates and is_endless

    def is_known(self, number: Any, _data_path: str) -> bool:
        # With extrapolation Hold Forward the action has no effect before its first key in Blender 5.2, but has one in 3.4 and 4.3.
        return self._animation.action_extrapolation != 'HOLD_FORWARD' and _is_blend_known(self._animation.action_blend_type, number)

    def parts(self, times: Array) -> Iterator[tuple[Any, Any, str, Any]]:
        at = np.flatnonzero((self._start <= times) & (times <= self._end))
        animation = self._animation
        yield keys.values(self._curve, times[at]), animation.action_influence, animation.action_blend_type, at

    def bounds(self, first: float, last: float) -> Iterable[float]:
        ends = [end for end in (self._start, self._end) if first <= end <= last]
        return [*keys.bounds(self._curve, first, last), *ends]

    @property
    def stamp(self) -> Any:
        animation = self._animation
        return (stamp_of_action(animation), animation.action_influence, animation.action_blend_type, animation.action_extrapolation)


class _Track:
    """One NLA track as a layer of a Stack. strips: (strip, its F-curve for the property or None) in the order of time."""

    def __init__(self, strips: list[Any]) -> None:
        self._strips = strips
        usable = [strip for strip, curve in strips if curve is not None and not strip.mute]
        self.animates = any(not strip.mute and (curve is not None or strip.type == 'META') for strip, curve in strips)
        self.is_always = (
            len(usable) == len(strips)
            and usable[0].extrapolation == 'HOLD'
            and all(
                strip.extrapolation != 'NOTHING' and not strip.use_animated_influence and strip.blend_in == strip.blend_out == 0.0
                for strip in usable
            )
        )

    def is_known(self, number: Any, data_path: str) -> bool:
        return all(strip.mute or self._is_strip_known(strip, curve, number, data_path) for strip, curve in self._strips)

    @staticmethod
    def _is_strip_known(strip: Any, curve: Any, number: Any, data_path: str) -> bool:
        if strip.type != 'CLIP' or len(strip.modifiers):
            return False
        if curve is None:
            return True
        # Blender sets all four numbers of a quaternion, even if only some of them have keys.
        is_whole = number.subtype != 'QUATERNION' or all(_curve(strip, data_path, index) for index in range(4))
        return is_whole and _is_blend_known(strip.blend_type, number)

    def parts(self, times: Array) -> Iterator[tuple[Any, Any, str, Any]]:
        chosen, clamped = self._chosen(times)
        for place, (strip, curve) in enumerate(self._strips):
            at = np.flatnonzero(chosen == place)
            if strip.mute or curve is None or len(at) == 0:
                continue
            influence = _influences(strip, clamped[at])
            acts = influence > 0.0
            at = at[acts]
            yield keys.values(curve, _action_times(strip, clamped[at])), influence[acts], strip.blend_type, at

    def _chosen(self, times: Array) -> tuple[Array, Array]:
        """(index of the strip that acts at each time, -1 if none acts; the times, clamped to the strip's range), each (n,)."""
        chosen, clamped = np.full(len(times), -1), times.copy()
        left = np.ones(len(times), bool)
        for place, (strip, _) in enumerate(self._strips):
            inside = left & (strip.frame_start <= times) & (times <= strip.frame_end)
            chosen[inside] = place
            left &= ~inside
            before = left & (times < strip.frame_start)
            left &= ~before
            if place > 0:
                previous = self._strips[place - 1][0]
                chosen[before] = place - 1 if previous.extrapolation != 'NOTHING' else -1
                clamped[before] = previous.frame_end
            else:
                chosen[before] = 0 if strip.extrapolation == 'HOLD' else -1
                clamped[before] = strip.frame_start
        last = self._strips[-1][0]
        chosen[left] = len(self._strips) - 1 if last.extrapolation != 'NOTHING' else -1
        clamped[left] = last.frame_end
        return chosen, clamped

    def bounds(self, first: float, last: float) -> Iterable[float]:
        for strip, curve in self._strips:
            yield from (strip.frame_start, strip.frame_end, strip.frame_start + strip.blend_in, strip.frame_end - strip.blend_out)
            if curve is None:
                continue
            start, end = max(first, strip.frame_start), min(last, strip.frame_end)
            if start < end:
                yield from keys.whole(start, end)
                yield from self._keys(strip, curve)

    @staticmethod
    def _keys(strip: Any, curve: Any) -> Iterator[float]:
        """Frames of the scene at which a strip reaches keys of its action, in all repetitions of the strip."""
        length = (strip.action_frame_end - strip.action_frame_start) or 1.0
        scale = abs(strip.scale) or 1.0
        inner = keys.bounds(curve, strip.action_frame_start, strip.action_frame_start + length)
        if strip.use_reverse:
            inner = [2.0 * strip.action_frame_start + length - frame for frame in inner]
        for lap in range(min(int(np.ceil(strip.repeat)), REPEATS, max(1, keys.MOST // len(inner)))):
            for frame in inner:
                yield strip.frame_start + scale * (lap * length + frame - strip.action_frame_start)

    @property
    def stamp(self) -> Any:
        return together(_strip_stamp(strip) for strip, _ in self._strips)


def _strip_stamp(strip: Any) -> tuple[Any, ...] | None:
    """Hashable value that changes whenever a strip's settings or action change.

    None if F-curves animate the strip's influence or time, since edits of these F-curves cannot be detected.
    """
    if strip.use_animated_influence or strip.use_animated_time:
        return None
    return together(
        (
            stamp_of_action(strip) if strip.action else (),
            strip.mute,
            strip.frame_start,
            strip.frame_end,
            strip.action_frame_start,
            strip.action_frame_end,
            strip.scale,
            strip.repeat,
            strip.use_reverse,
            strip.blend_type,
            strip.extrapolation,
            strip.blend_in,
            strip.blend_out,
        )
    )


def _influences(strip: Any, times: Array) -> Array:
    if strip.use_animated_influence:
        return _controlled(strip, "influence", times)
    found = np.ones(len(times))
    if strip.blend_out > SAME:
        to_end = times >= strip.frame_end - strip.blend_out
        found[to_end] = np.abs(strip.frame_end - times[to_end]) / strip.blend_out
    if strip.blend_in > SAME:
        from_start = times <= strip.frame_start + strip.blend_in
        found[from_start] = np.abs(times[from_start] - strip.frame_start) / strip.blend_in
    return found


def _controlled(strip: Any, name: str, times: Array) -> Array:
    """Values (n,) at times (n,) of a setting of a strip that F-curves of the strip may animate."""
    curve = strip.fcurves.find(name)
    if curve is None or curve.is_empty or curve.mute:
        return np.full(len(times), getattr(strip, name))
    return keys.values(curve, times)


def _action_times(strip: Any, times: Array) -> Array:
    """Frames within a strip's action, (n,), for frames of the scene within the strip, (n,)."""
    start, end = strip.action_frame_start, strip.action_frame_end
    if strip.use_animated_time:
        found = _controlled(strip, "strip_time", times)
        # As Blender computes it: the start of the action is not added again.
        return np.fmod(found - start, (end - start) or 1.0) if strip.use_animated_time_cyclic else found
    scale = abs(strip.scale) or 1.0
    # In single precision as in Blender: near the end of a repetition, rounding decides to which repetition a time belongs.
    period = np.float32((end - start or 1.0) * scale)
    passed = np.fmod((times - strip.frame_start).astype(np.float32), period).astype(float) / scale
    if strip.repeat == np.floor(strip.repeat):
        passed[np.abs(times - strip.frame_end) < SAME] = end - start
    return end - passed if strip.use_reverse else start + passed
