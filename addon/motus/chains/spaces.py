"""The space in which chains are solved that feel a part of the motion of their rig alone: it takes part in the rest of that motion."""

from typing import Any, NamedTuple

from ..core import tracks
from ..core.lazy import numpy as np
from ..core.tracks import rotations


class Space(NamedTuple):
    """A space that turns and moves. seconds: (m,), rising. turns: unit quaternions (m, 4). shifts: (m, 3). Both lead from the space to the world."""

    seconds: Any
    turns: Any
    shifts: Any

    def inside(self, keywords):
        """Return keywords of the native StrandMotion, whose arrays have a row for each of the times, as they are in this space."""
        return {name: _INSIDE[name](self, value) if name in _INSIDE else value for name, value in keywords.items()}

    def directions(self, vectors):
        """Return vectors (m, ..., 3) of the world as they are in this space."""
        back = np.swapaxes(rotations.matrices(self.turns), 1, 2)
        rows = vectors.reshape(len(vectors), -1, 3)
        return np.swapaxes(rotations.chained(back, np.swapaxes(rows, 1, 2)), 1, 2).reshape(vectors.shape)

    def places(self, found):
        """Return places (m, ..., 3) of the world as they are in this space."""
        return self.directions(found - self.shifts.reshape(len(found), *(1,) * (found.ndim - 2), 3))

    def matrices(self, found):
        """Return matrices (m, s, 4, 4) to the world as such to this space."""
        result = found.copy()
        # The columns of a matrix are axes and origin.
        result[:, :, :3, :3] = np.swapaxes(self.directions(np.swapaxes(found[:, :, :3, :3], 2, 3)), 2, 3)
        result[:, :, :3, 3] = self.places(found[:, :, :3, 3])
        return result

    def outside(self, places, seconds):
        """Return places (n, 3) in this space as they are in the world, at one time, s."""
        above, part = between(self.seconds, seconds)
        turn = rotations.matrices(rotations.mixed(self.turns[above - 1 : above], self.turns[above : above + 1], np.array([part])))[0]
        return places @ turn.T + (1.0 - part) * self.shifts[above - 1] + part * self.shifts[above]


def between(times, at):
    """Return (index of the first of rising times (m,) behind a time, by which part that lies between this one and the one before, 0 to 1)."""
    above = int(np.clip(np.searchsorted(times, at), 1, len(times) - 1))
    lower, upper = times[above - 1 : above + 1]
    return above, np.clip((at - lower) / (upper - lower), 0.0, 1.0)


_INSIDE = {
    "poses": Space.places,
    "gravity": Space.directions,
    "sides": Space.directions,
    "air": Space.directions,
    "obstacle_places": Space.places,
    "surface_matrices": Space.matrices,
    "pin_places": Space.places,
}
"""Keywords of the native StrandMotion that have a place or direction for each time, and how these come into a Space."""


def following(track, frames, seconds, part):
    """Return the Space that takes part in a motion, by a part from 0 to 1, from the first of frames (n,) on, where it is the world.

    track: of the world matrix of what moves. seconds: of the frames.
    """
    name = "chains space", part, frames.tobytes()
    return Space(seconds, *tracks.kept(track, name, lambda: _following(rotations.rigid(track.values(frames)), part)))


def _following(moved, part):
    """Return (turns (n, 4), shifts (n, 3)) of the space that takes part in the motion of rigid matrices (n, 4, 4)."""
    turns, places = rotations.of_rigid(moved), moved[:, :3, 3]
    steps = rotations.product(turns[1:], _conjugate(turns[:-1]))
    first = np.array([(1.0, 0.0, 0.0, 0.0)])
    steps = np.array(rotations.mixed(np.broadcast_to(first, steps.shape), steps, np.full(len(steps), part)))
    # In each step, a part of the turn about where the rig is, and the same part of its way.
    shifts = places[:-1] + part * (places[1:] - places[:-1]) - _turned(steps, places[:-1])
    reach = 1
    while reach < len(steps):  # each step together with all before it
        shifts[reach:] += _turned(steps[reach:], shifts[:-reach])
        steps[reach:] = rotations.unit(rotations.product(steps[reach:], steps[:-reach]))
        reach *= 2
    return np.concatenate([first, steps]), np.concatenate([np.zeros((1, 3)), shifts])


def _turned(turns, vectors):
    return rotations.chained(rotations.matrices(turns), vectors[:, :, None])[:, :, 0]


def _conjugate(turns):
    return turns * np.array((1.0, -1.0, -1.0, -1.0))
