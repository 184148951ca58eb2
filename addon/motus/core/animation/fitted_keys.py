"""Fit F-curves with few keys to samples: pieces of cubic polynomials, each as long as the error allows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy

from ..lazy import numpy as np

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

TOLERANCE = 1e-6
"""Largest error of a curve at a sample, in metres, radians or units of the property: a tenth of what is promised, since bones of a chain add up."""
EITHER, BELOW, ABOVE = 0, -1, 1
"""On which side of the samples a fitted curve stays."""
_PRECISION = 2.0**-23
_FIRST_REACH = 8


def write(curve: bpy.types.FCurve, times: Array, samples: Array, tolerance: float = TOLERANCE, side: int = EITHER) -> None:
    """Give an F-curve the few keys whose curve goes through samples; it has no keys from the first time to the last. Arguments as keys()."""
    places, inner = keys(times, samples, tolerance, side)
    frames, values = times[places], np.asarray(samples, float)[places]
    points = curve.keyframe_points
    before = len(points)
    points.add(len(places))
    third = np.diff(frames) / 3.0
    left, right = np.stack((frames, values), axis=1), np.stack((frames, values), axis=1)
    # Handles at thirds of a piece: its time is then linear in the parameter, and its value the fitted cubic in time.
    right[:-1] += np.stack((third, inner[:, 0] - values[:-1]), axis=1)
    left[1:] += np.stack((-third, inner[:, 1] - values[1:]), axis=1)
    if len(places) > 1:
        left[0], right[-1] = 2.0 * left[0] - right[0], 2.0 * right[-1] - left[-1]
    else:
        left[0, 0], right[0, 0] = left[0, 0] - 1.0, right[0, 0] + 1.0
    for point in points[before:]:  # foreach_set() does not reach types of handles (3.4)
        point.interpolation, point.handle_left_type, point.handle_right_type = 'BEZIER', 'FREE', 'FREE'
    for name, rows in (("co", np.stack((frames, values), axis=1)), ("handle_left", left), ("handle_right", right)):
        every = np.empty(2 * len(points), np.float32)
        points.foreach_get(name, every)
        every[2 * before :] = rows.ravel()
        points.foreach_set(name, every)
    curve.update()


def write_steps(curve: bpy.types.FCurve, times: Array, samples: Array) -> None:
    """Give an F-curve without keys a key at each sample that differs from the one before, held until the next key."""
    changes = [0, *(index for index in range(1, len(samples)) if samples[index] != samples[index - 1])]
    points = curve.keyframe_points
    points.add(len(changes))
    points.foreach_set("co", np.array([(times[index], samples[index]) for index in changes], np.float32).ravel())
    for point in points:
        point.interpolation = 'CONSTANT'
    curve.update()


def keys(times: Array, values: Array, tolerance: float = TOLERANCE, side: int = EITHER) -> tuple[Array, Array]:
    """Find the keys of a curve through samples.

    times: (n,), rising. values: (n,). tolerance: largest error at a sample, beside the rounding of single precision. side: EITHER,
    BELOW or ABOVE: where the curve is at every sample. Returns (keys, inner): keys (m,) are indices of samples through which the curve
    goes; inner (m - 1, 2) are the two inner Bernstein coefficients of the cubic between two keys, whose outer ones are the samples. A
    constant curve has one key.
    """
    times, values = np.asarray(times, float), np.asarray(values, float)
    rounding = 2.0 * _PRECISION * float(np.abs(values).max())
    error = max(tolerance, rounding)
    if np.abs(values - values[0]).max() <= (error if side == EITHER else rounding):
        return np.zeros(1, int), np.empty((0, 2))
    found, inner, reach = [0], [], _FIRST_REACH
    while found[-1] < len(values) - 1:
        end, coefficients = _longest(times, values, found[-1], reach, error, side)
        reach = end - found[-1]
        found.append(end)
        inner.append(coefficients)
    return np.array(found), np.array(inner)


def _longest(times: Array, values: Array, start: int, reach: int, error: float, side: int) -> tuple[int, Array]:
    """Find the last sample to which one cubic from sample `start` fits: (its index, inner coefficients). reach: samples tried first."""
    end = len(values)
    good, coefficients = start + 1, _straight(values[start], values[start + 1])
    tried = min(start + reach, end - 1)
    while good < tried < end:
        found = _fitted(times[start : tried + 1], values[start : tried + 1], error, side)
        if found is None:
            end = tried
        else:
            good, coefficients = tried, found
        # The length is doubled until a piece is too long; then it lies between one that fits and one that does not.
        tried = min(start + 2 * (good - start), len(values) - 1) if end == len(values) else (good + end) // 2
    return good, coefficients


def _fitted(times: Array, values: Array, error: float, side: int) -> Array | None:
    """Inner coefficients of the cubic through the first and last value that is nearest to all; None if it is too far from one of them.

    side: the cubic is moved to this side of all values, by a parabola that is 0 at its ends.
    """
    if len(values) == 2:
        return _straight(*values)
    u = (times - times[0]) / (times[-1] - times[0])
    straight = _straight(values[0], values[-1])
    rest = values - values[0] - (values[-1] - values[0]) * u
    first, second = 3.0 * u * (1.0 - u) ** 2, 3.0 * u * u * (1.0 - u)
    if len(values) == 3:  # one sample alone leaves a choice: the cubic that bends least
        bend = np.array((first[1], second[1])) * rest[1] / (first[1] ** 2 + second[1] ** 2)
    else:
        a, b, c, x, y = first @ first, first @ second, second @ second, first @ rest, second @ rest
        bend = np.array((c * x - b * y, a * y - b * x)) / (a * c - b * b)
    missed = rest - first * bend[0] - second * bend[1]
    if side != EITHER:
        parabola = 3.0 * u * (1.0 - u)
        by = max(float((side * missed[1:-1] / parabola[1:-1]).max()), 0.0)
        bend, missed = bend + side * by, missed - side * by * parabola
    return None if np.abs(missed).max() > error else straight + bend


def _straight(first: float, last: float) -> Array:
    return np.array((first + (last - first) / 3.0, first + (last - first) * 2.0 / 3.0))
