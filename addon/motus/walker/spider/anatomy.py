"""Where the parts of a spider are, for any number of legs: lengths as parts of its span, the body's middle over the origin, ahead +Y."""

import math
from typing import NamedTuple

from mathutils import Vector

HEIGHT = 0.17
"""Of the body over the feet."""
UPPER, LOWER = 0.32, 0.42
"""Lengths of a leg's two bones."""
FIRST, LAST = math.radians(30.0), math.radians(148.0)
"""Directions of the foremost and of the hindmost pair of legs, from +Y."""
HIP_ACROSS, HIP_ALONG, HIP_AHEAD = 0.07, 0.085, 0.03
REACH, MORE_REACH = 0.455, 0.075
"""How far the feet are from the middle at the side; and how much more ahead and behind."""
USUAL_PAIRS = 4
"""A body with more pairs of legs is longer."""


class Leg(NamedTuple):
    """name: of its pair and side, as it ends the names of its bones. hip, knee, foot: places."""

    name: str
    hip: Vector
    knee: Vector
    foot: Vector


def stretch(count):
    """How much longer the body is than that of a spider with eight legs."""
    return max(1.0, count / (2.0 * USUAL_PAIRS))


def legs(count):
    """The Legs, pair by pair from the front; the last one of an odd number stands behind."""
    pairs = count // 2
    found = []
    for pair in range(pairs):
        share = pair / (pairs - 1) if pairs > 1 else 0.5
        angle = FIRST + (LAST - FIRST) * share
        found += [_leg(f" {pair + 1}.{side}", sign * angle, share, count) for side, sign in (("L", -1.0), ("R", 1.0))]
    if count % 2:
        found.append(_leg(f" {pairs + 1}", math.pi, 1.0, count))
    return found


def _leg(name, angle, share, count):
    ahead = Vector((math.sin(angle), math.cos(angle), 0.0))
    # What does not fit around a short body stands beside a longer one.
    along = (stretch(count) - 1.0) * (HIP_ALONG + REACH) * (1.0 - 2.0 * share)
    middle = Vector((0.0, HIP_AHEAD + along, 0.0))
    hip = middle + Vector((HIP_ACROSS * ahead.x, HIP_ALONG * ahead.y, HEIGHT - 0.01))
    foot = middle + (REACH + MORE_REACH * ahead.y**2) * ahead
    return Leg(name, hip, _knee(hip, foot), foot)


def _knee(hip, foot):
    """Place of a leg's knee, which bends upwards."""
    way = foot - hip
    angle = math.acos((UPPER**2 + way.length**2 - LOWER**2) / (2.0 * UPPER * way.length))
    across = way.cross(Vector((0.0, 0.0, 1.0))).normalized()
    upwards = across.cross(way).normalized()
    return hip + UPPER * (math.cos(angle) * way.normalized() + math.sin(angle) * upwards)
