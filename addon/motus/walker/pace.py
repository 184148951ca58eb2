"""How fast a body goes, and how fast it would go at ease, by the height of its hips and the steepness of its way."""

import math
from typing import NamedTuple

from ..core.lazy import numpy as np
from ..core.measures import axes, scene_time

GRAVITY = 9.81
AT_EASE = 0.25
"""Froude number at which people and animals walk at ease; they walk up to 0.5, and run above."""
STEEPNESS, BEST = 3.5, -0.05
"""Of Tobler's hiking function: how quickly the speed falls off with the slope, and the slope at which it is highest."""
APART = 0.5
"""Frames before and after the present one between which the speed is measured."""


class Pace(NamedTuple):
    """Motion of a body at a frame. speed: m/s. slope: rise of its way, as a share of the way over ground; infinite straight up."""

    speed: float
    slope: float


def at(track, frame, fps):
    """The Pace of a body at a frame. track: Track of its world matrices. fps: frames in a second."""
    before, after = track.values(np.array([frame - APART, frame + APART]))[:, :3, 3].tolist()
    x, y, rise = (one - other for one, other in zip(after, before))
    over_ground = math.hypot(x, y)
    slope = rise / over_ground if over_ground > 0.0 else math.copysign(math.inf, rise) if rise else 0.0
    return Pace(math.hypot(over_ground, rise) * fps / (2.0 * APART), slope)


def froude(speed, hip_height):
    """Froude number of a body with hips at a height, m, at a speed, m/s."""
    return speed * speed / (GRAVITY * hip_height)


def at_ease(hip_height, slope):
    """Speed, m/s, at which a body with hips at a height, m, walks at ease on a slope."""
    return math.sqrt(AT_EASE * GRAVITY * hip_height) * math.exp(-STEEPNESS * (abs(slope - BEST) - abs(BEST)))


def hip_height(settings):
    """Height of the hips above the ground, before the body's scale: the setting Hip Height, or if it is 0 the mean of the legs'.

    0 if the legs do not tell: their feet are objects.
    """
    if settings.hip_height:
        return settings.hip_height
    up = np.array(axes.vector(settings.up_axis))
    heights = [float(np.subtract(leg.hip, leg.rest) @ up) + settings.ankle for leg in settings.legs if leg.length > 0.0]
    return max(0.0, sum(heights) / len(heights)) if heights else 0.0


def of(owner, scene, track):
    """Return (Pace, hip height in the world) of an evaluated owner (the object that walks) on the scene's frame. track: see at()."""
    now = at(track, scene_time.present(scene), scene_time.fps(scene))
    return now, hip_height(owner.motus.walker) * abs(owner.matrix_world.median_scale)
