"""Bones that take on the lengths of their links: they are scaled along these, and across so that their volume stays."""

import math
from typing import Any, NamedTuple

from ..core.lazy import numpy as np
from . import spaces

LONGEST = 5.0
"""How many times a bone becomes longer, or shorter, at most."""
UNTOUCHED = frozenset({'NONE', 'NONE_LEGACY', 'AVERAGE'})
"""Choices of Bone.inherit_scale with which a bone stays as it is while its parent is scaled and keeps its volume."""


class Rests(NamedTuple):
    """Where the animation has the particles of a chain over time.

    seconds: (m,), rising. poses: (m, n, 3), in the space. space: the spaces.Space in which the chain is solved; None for the world.
    """

    seconds: Any
    poses: Any
    space: Any

    def at(self, seconds):
        """Return places (n, 3) in the world at a time, s."""
        above, part = spaces.between(self.seconds, seconds)
        found = (1.0 - part) * self.poses[above - 1] + part * self.poses[above]
        return found if self.space is None else self.space.outside(found, seconds)


def first_inheriting(bone):
    """Return the first child of a PoseBone that would inherit its scale along one axis, and be distorted; None if there is none."""
    return next((child for child in bone.bone.children if child.inherit_scale not in UNTOUCHED), None)


def shares(bones, squash):
    """Return how much each of PoseBones takes on its link's length, from 0 to 1, as a list; () if none of them does."""
    squash = min(max(squash, 0.0), 1.0)
    return [0.0 if first_inheriting(bone) else squash for bone in bones] if squash > 0.0 else ()


def sizes(places, rests, parents, taken, axes):
    """Return (scales (n - 1, 3) of the bones of a chain along their own axes, their lengths (n - 1)).

    Lengths are those in the space of the rig, or in the world if the rig is scaled evenly.

    places, rests: (n, 3), where the particles are, and where the animation has them. parents: index of each particle's parent. taken: (n - 1),
    how much each bone takes on its link's length. axes: uneven.axes_of() the rig.
    """
    back = None if axes is None else [list(row) for row in axes.inverted_safe()]
    scales, lengths = np.empty((len(parents) - 1, 3)), np.empty(len(parents) - 1)
    for index, (parent, share) in enumerate(zip(parents[1:], taken)):
        length, rest = (_length(one[index + 1] - one[parent], back) for one in (places, rests))
        ratio = min(max(length / rest, 1.0 / LONGEST), LONGEST) if rest > 0.0 else 1.0
        along = math.pow(ratio, share)
        scales[index], lengths[index] = (1.0 / math.sqrt(along), along, 1.0 / math.sqrt(along)), rest * along
    return scales, lengths


def _length(way, back):
    """Length of a vector of the world in the space of a rig that has these rows of the inverse of its axes; None: in the world."""
    x, y, z = way.tolist()
    if back is not None:
        x, y, z = (a * x + b * y + c * z for a, b, c in back)
    return math.sqrt(x * x + y * y + z * z)
