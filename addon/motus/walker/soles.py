"""Turns of a walker's feet, whose soles lie on the ground and roll over heel and toe."""

from mathutils import Quaternion

from ..core.lazy import numpy as np
from ..core.tracks import rotations


def turned(planned, seconds):
    """Turns (legs, 4) of the feet in the world at a time, or (n, legs, 4) at times (n,), w, x, y, z. planned: Plan with turns."""
    turns = planned.walker.turns(seconds)
    own = np.broadcast_to(np.array(planned.turns), turns.shape)
    return rotations.product(turns.reshape(-1, 4), own.reshape(-1, 4)).reshape(turns.shape)


def mixed(lower, upper, weights):
    """Turns (n, 4) between two, (n, 4) each, as constraints of this influence make them; 0 of the weights (n,) gives the lower ones."""
    return np.array([Quaternion(one).slerp(Quaternion(other), weight) for one, other, weight in zip(lower, upper, weights)])
