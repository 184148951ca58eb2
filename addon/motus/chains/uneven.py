"""Rigs that are scaled unevenly: there bones change their lengths as they turn, which the links between particles do not."""

from typing import NamedTuple

from mathutils import Matrix

from ..core.lazy import numpy as np

EVEN = 1e-4
"""Largest part by which the axes of a rig may differ in length, or lean towards each other, and it still counts as scaled evenly."""


class Links(NamedTuple):
    """The bones of a chain as links. parents: index of the parent of each particle, -1 of the first. lengths: of the bones, in the rig's space."""

    parents: list
    lengths: list


def axes_of(world):
    """Return the axes of a rig with this world matrix (4, 4), as a mathutils matrix, if it is scaled unevenly; else None."""
    axes = Matrix(world).to_3x3()
    across = axes.transposed()
    x, y, z = across[0], across[1], across[2]
    square = x.dot(x)
    parts = (y.dot(y) - square, z.dot(z) - square, x.dot(y), y.dot(z), z.dot(x))
    return axes if max(map(abs, parts)) > EVEN * square else None


def tails(places, parents, lengths, axes):
    """Return where the tails of the bones of a chain come to, (n - 1, 3), for the places (n, 3) of its particles.

    In a rig that is scaled evenly, that is to the particles. In another one each bone points along its link, from where its head has come
    to. parents: index of each particle's parent. lengths: (n - 1), of the bones in the rig's space. axes: axes_of() the rig.
    """
    if axes is None:
        return places[1:]
    found, forth, back = places.copy(), np.array(axes), np.array(axes.inverted_safe())
    for index, (parent, length) in enumerate(zip(parents[1:], lengths), 1):
        inside = back @ (places[index] - places[parent])
        found[index] = found[parent] + forth @ inside * (length / max(np.sqrt(inside @ inside), np.finfo(float).tiny))
    return found[1:]
