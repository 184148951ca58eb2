"""Shots of a camera in whose view flakes are born. A shot is the time between two cuts, at which the view jumps."""

import math

from ..core import tracks
from ..core.lazy import numpy as np

SUDDEN = 1.0 / 64.0
"""Time in frames: a change of the view within this time is a jump, not a motion."""
SAME, OTHER = 0.9, 0.1
"""Shares of the view that were also seen before, below which a new shot begins.

SAME is compared with the view just before (SUDDEN frames), OTHER with the view one frame before.
"""
ACROSS = 5
"""Number of places, along each axis of the view, at which two views are compared."""


def alone(poses, moved, view, frame, clock):
    """Poses of a camera within the shot that `frame` is in, as if the camera filmed this shot at all times.

    Samples outside the shot are dropped; the first and last pose within the shot hold beyond it. A shot lies between two cuts, at
    which the view jumps. poses: births.Poses of the camera. moved: Track of the camera (world matrices at any frame).
    view: (half the angles of the view, closest, farthest), hashable. clock: Clock of the poses.
    """
    first, last = poses.frames
    cuts, before = tracks.kept(moved, ("snow shots", view, first, last), lambda: _cuts(moved, view, first, last))
    if len(cuts) == 0:
        return poses
    number = int(np.searchsorted(cuts, frame, side="right"))
    starts, just_before = clock.many(cuts), clock.many(cuts - SUDDEN)
    start = starts[number - 1] if number > 0 else -math.inf
    end = starts[number] if number < len(cuts) else math.inf
    inside = (poses.seconds >= start) & (poses.seconds < end)
    seconds, matrices = poses.seconds[inside], poses.matrices[inside]
    if number < len(cuts) and just_before[number] > seconds[-1]:
        seconds = np.append(seconds, just_before[number])
        matrices = np.append(matrices, before[number : number + 1], axis=0)
    return poses._replace(stamp=(poses.stamp, number), seconds=seconds, matrices=matrices)


def unscaled(matrices):
    """Return world matrices (k, 4, 4) with axes of length 1: Blender ignores the scale of a camera and of its parents."""
    axes = matrices[:, :3, :3]
    # Summed term by term, so that the result has the same bits whatever the memory layout of the matrices is.
    lengths = np.sqrt(axes[:, 0] * axes[:, 0] + axes[:, 1] * axes[:, 1] + axes[:, 2] * axes[:, 2])
    found = matrices.copy()
    found[:, :3, :3] = axes / np.where(lengths > 0.0, lengths, 1.0)[:, None]
    return found


def _cuts(moved, view, first, last):
    """Return (frames (n,) of the cuts after the first frame, rising; the camera's matrices (n, 4, 4) just before each cut)."""
    frames = np.array([at for at in moved.bounds(first, last) if at > first], float)
    if len(frames) == 0:
        return frames, np.empty((0, 4, 4))
    after, before, earlier = (unscaled(moved.values(frames - back)) for back in (0.0, SUDDEN, 1.0))
    is_cut = (_share_seen(before, after, view) < SAME) | (_share_seen(earlier, after, view) < OTHER)
    return frames[is_cut], before[is_cut]


def _share_seen(before, after, view):
    """For each of n moments, the share (0 to 1) of the camera's view just after it that was in view just before it.

    before, after: world matrices (n, 4, 4) of the camera.
    """
    places, slopes, closest, farthest = _places(*view)
    found = np.einsum("nij,kj->nki", np.linalg.inv(before) @ after, places)
    depths = -found[:, :, 2]
    is_seen = (depths >= closest) & (depths <= farthest)
    for axis, slope in enumerate(slopes):
        is_seen &= np.abs(found[:, :, axis]) <= slope * depths
    return is_seen.mean(axis=1)


def _places(angles, closest, farthest):
    """Return (places (k, 4) evenly spread in a camera's view, in camera space; tangents of the angles; closest; farthest).

    angles: half the angles of the view in X and Y. closest, farthest: distances from the camera.
    """
    shares = (np.arange(ACROSS) + 0.5) / ACROSS
    depths = np.cbrt(closest**3 + shares * (farthest**3 - closest**3))
    across, up, depth = (part.ravel() for part in np.meshgrid(2.0 * shares - 1.0, 2.0 * shares - 1.0, depths))
    slopes = [math.tan(angle) for angle in angles]
    places = np.stack([across * slopes[0] * depth, up * slopes[1] * depth, -depth, np.ones_like(depth)], axis=1)
    return places, slopes, closest, farthest
