"""Directions of the rods of pendulums: as turns of the rods, as angles, and as places of the end bobs.

A spherical pendulum's state is the direction from the pivot to the bob, of length 1, and the change of the direction per second, six
numbers. That of a single or double pendulum is its rods' angles, then their angular velocities. The `math` module is used, because the last
bit of NumPy's sine and cosine depends on an angle's place in its array.
"""

import math

from ..core.lazy import numpy as np


def turn(direction, share):
    """Return the quaternion (w, x, y, z) that turns a rod from hanging straight down by a share of its smallest angle to a direction."""
    x, y, z = direction
    level = math.hypot(x, y)
    half = 0.5 * share * math.atan2(level, -z)
    if level == 0.0:  # straight up or down: the pivot's X axis is the heading
        x, level = 1.0, 1.0
    sine = math.sin(half) / level
    return math.cos(half), sine * y, -sine * x, 0.0


def of_angles(angle, heading):
    """Return the direction (x, y, z) at an angle from straight down, towards a heading about the Z axis from X."""
    return math.sin(angle) * math.cos(heading), math.sin(angle) * math.sin(heading), -math.cos(angle)


def angles(state):
    """Return (angle, heading, velocity, sideways velocity): the settings with which a spherical pendulum starts in a state."""
    x, y, z, *velocity = state
    level = math.hypot(x, y)
    cosine, sine = (x / level, y / level) if level > 0.0 else (1.0, 0.0)
    outward = cosine * velocity[0] + sine * velocity[1]
    return (
        math.atan2(level, -z),
        math.atan2(sine, cosine),
        level * velocity[2] - z * outward,
        cosine * velocity[1] - sine * velocity[0],
    )


def ends(swing, states, lengths, share=1.0):
    """Return the places (n, 3) of a pendulum's end bob in the pivot's space.

    swing: the Swing (solve.py) that has given the states (n, m). lengths: of the rods. share: influence of the pendulum.
    """
    if swing.is_spherical:
        w, x, y, _ = np.array([turn(direction, share) for direction in states[:, :3].tolist()]).reshape(-1, 4).T
        found = np.stack((-2.0 * w * y, 2.0 * w * x, 2.0 * (x * x + y * y) - 1.0), axis=1)
        return lengths[0] * found
    turned = share * states[:, : swing.each]
    found = np.zeros((len(states), 3))
    found[:, 0] = _each(math.sin, turned) @ lengths
    found[:, 2] = -(_each(math.cos, turned) @ lengths)
    return found


def _each(function, values):
    return np.fromiter(map(function, values.ravel().tolist()), float, values.size).reshape(values.shape)
