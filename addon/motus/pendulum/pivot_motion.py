"""Accelerations of a moving pivot where its pendulum can swing, in a plane or to all sides, for pendulums with the setting Driven Pivot."""

import math

from ..core import native, tracks
from ..core.declare import Problem
from ..core.lazy import numpy as np
from ..core.measures import scene_time

MOST = 20_000  # greatest number of frames of the pivot's motion that act on the pendulum
BESIDE = 8  # number of further frames before and after, which the accelerations at the ends need

UNKNOWN = Problem("The pivot's motion is not known ahead, and is not felt: record it, or key it", False)
NOT_STEADY = Problem("The pivot's motion is felt only while the pendulum plays all the time at one speed above 0", False)


def track(owner, scene):
    """Return the Track of the pivot's world matrix, from which the matrix at any time can be read."""
    return tracks.world_track(owner, scene)


def felt(owner, scene, rate, is_spherical):
    """Return (keywords for the native pendulum functions, Problem or None) that describe the pivot's motion.

    The keywords are {} if the pivot rests or its motion cannot be used. owner: the evaluated pivot.
    rate: seconds of the pendulum's own time per second; None if the rate changes. is_spherical: whether the pendulum swings to all sides.
    """
    if rate is None or not rate > 0.0:
        return {}, NOT_STEADY
    moved = track(owner, scene)
    if not moved.is_known:
        return {}, UNKNOWN
    if moved.extent is None:
        return {}, None
    start = owner.motus.pendulum.start_frame
    count = min(max(math.ceil(scene_time.last(scene) - start) + 1, 2), MOST)
    step = scene_time.seconds(scene, rate)
    axes = (0, 1, 2) if is_spherical else (0, 2)
    found = tracks.kept(moved, ("pendulum", start, count, step, axes), lambda: _sampled(moved, start, count, step, axes))
    if found is None:
        return {}, UNKNOWN
    return {"pivot_step": step, "pivot_accelerations": found}, None


def _sampled(moved, start, count, step, axes):
    """Accelerations (count, len(axes)) along axes of the pivot; None if a place is not finite."""
    # The motion before the start and after the end is read as well, because accelerations at the ends of a table are not known.
    matrices = moved.values(start + np.arange(-BESIDE, count + BESIDE))
    if not np.isfinite(matrices).all():
        return None
    places = matrices[:, :3, 3]
    level = native.module.pivot_accelerations(step, np.ascontiguousarray(places[:, :2]))
    upward = native.module.pivot_accelerations(step, np.ascontiguousarray(places[:, 1:]))
    in_space = np.column_stack((level, upward[:, 1]))
    found = np.zeros((len(matrices), len(axes)))
    for column, axis in enumerate(matrices[:, :3, axis] for axis in axes):
        found[:, column] = (in_space * axis).sum(axis=1) / np.maximum(np.sqrt((axis * axis).sum(axis=1)), 1e-30)
    return np.ascontiguousarray(found[BESIDE:-BESIDE])
