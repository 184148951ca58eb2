"""Places of a spider's parts, for any number of legs.

Lengths are shares of the span of its legs. The middle of the body is above the origin, and the spider faces +Y.
"""

import math
from typing import NamedTuple

from mathutils import Vector

HEIGHT = 0.17
"""Height of the body above the feet."""
UPPER, LOWER = 0.32, 0.42
"""Lengths of a leg's upper and lower bone."""
FIRST, LAST = math.radians(30.0), math.radians(148.0)
"""Angles between +Y and the foremost pair of legs, and between +Y and the hindmost pair, in radians."""
HIP_ACROSS, HIP_ALONG, HIP_AHEAD = 0.07, 0.085, 0.03
REACH, MORE_REACH = 0.455, 0.075
"""Distance of a foot from the body's middle if it stands at the side, and what is added if it stands ahead or behind."""
USUAL_PAIRS = 4
"""Number of pairs of legs up to which the body keeps its length; a body with more pairs is longer."""


class Leg(NamedTuple):
    """A leg of a spider. name: its pair and side, such as " 1.L", the end of its bones' names. hip, knee, foot: places of its joints."""

    name: str
    hip: Vector
    knee: Vector
    foot: Vector


def stretch(count):
    """Length of the body, as a multiple of the length for eight legs; at least 1. count: number of legs."""
    return max(1.0, count / (2.0 * USUAL_PAIRS))


def legs(count):
    """List the Leg of each of `count` legs, pair by pair from the front; if the number is odd, the last leg points backwards."""
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
    # Legs beyond eight stand along a longer body.
    along = (stretch(count) - 1.0) * (HIP_ALONG + REACH) * (1.0 - 2.0 * share)
    middle = Vector((0.0, HIP_AHEAD + along, 0.0))
    hip = middle + Vector((HIP_ACROSS * ahead.x, HIP_ALONG * ahead.y, HEIGHT - 0.01))
    foot = middle + (REACH + MORE_REACH * ahead.y**2) * ahead
    return Leg(name, hip, _knee(hip, foot), foot)


def _knee(hip, foot):
    """Place of a leg's knee, which bends upwards, from the places of hip and foot and the lengths of the two bones."""
    way = foot - hip
    angle = math.acos((UPPER**2 + way.length**2 - LOWER**2) / (2.0 * UPPER * way.length))
    across = way.cross(Vector((0.0, 0.0, 1.0))).normalized()
    upwards = across.cross(way).normalized()
    return hip + UPPER * (math.cos(angle) * way.normalized() + math.sin(angle) * upwards)
