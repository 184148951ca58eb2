"""Rigs that are scaled unevenly: there bones change their lengths as they turn, which the links between particles do not."""

from typing import NamedTuple

from ..core.lazy import numpy as np

EVEN = 1e-4
"""Largest part by which the axes of a rig may differ in length, or lean towards each other, and it still counts as scaled evenly."""


class Links(NamedTuple):
    """The bones of a chain as links. parents: index of the parent of each particle, -1 of the first. lengths: of the bones, in the rig's space."""

    parents: list
    lengths: list


def tails(places, links, world):
    """Return where the tails of the bones of a chain come to, (n - 1, 3), for the places (n, 3) of its particles.

    In a rig that is scaled evenly, that is to the particles. In another one each bone points along its link, from where its head has come
    to. world: world matrix (4, 4) of the rig.
    """
    axes = np.array(world, float)[:3, :3]
    if is_even(axes):
        return places[1:]
    found = places.copy()
    back = np.linalg.pinv(axes)
    for index, (parent, length) in enumerate(zip(links.parents[1:], links.lengths), 1):
        inside = back @ (places[index] - places[parent])
        found[index] = found[parent] + axes @ inside * (length / max(np.sqrt(inside @ inside), np.finfo(float).tiny))
    return found[1:]


def is_even(axes):
    """Whether a matrix (3, 3) turns, mirrors and scales evenly alone."""
    products = axes.T @ axes
    return bool(np.abs(products - products[0, 0] * np.eye(3)).max() <= EVEN * products[0, 0])
