"""Share of the snow's depth at each vertex of a layer: the weights of a vertex group, or values of an attribute, of the surfaces."""

import hashlib
from typing import Any, NamedTuple

from ...core import keeping
from ...core.evaluated import copies
from ...core.lazy import numpy as np
from ...core.scenery.meshes import hash_of, is_same

_read = keeping.OfFile(
    "shares of the snow's depth at the vertices of evaluated surfaces (Painted), or None",
    "unique number of the evaluated copy of the mesh, name and index of the vertex group",
    most=256,
)
_spread = keeping.OfFile(
    "shares of the snow's depth at the vertices of a layer", "surfaces and resolution of the layer, and the shares at the surfaces", most=4
)


class Painted(NamedTuple):
    """Shares of the snow's depth at the vertices of a surface. stamp: hash of the shares. shares: (v,) float32, from 0 to 1."""

    stamp: Any
    shares: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


def of(surface, name):
    """Return the Painted of an evaluated surface; None if it has neither a vertex group nor a number attribute of this name."""
    group = surface.vertex_groups.get(name)
    index = -1 if group is None else group.index
    mesh = surface.data
    if mesh == surface.original.data:  # an original mesh: evaluated copies would inherit a number that is written into it
        return _of(mesh, name, index)
    return _read.made((copies.number_given(mesh), name, index), lambda: _of(mesh, name, index))


def _of(mesh, name, index):
    shares = np.zeros(len(mesh.vertices), np.float32)
    attribute = mesh.attributes.get(name)
    if attribute is not None and attribute.domain == 'POINT' and attribute.data_type == 'FLOAT' and len(attribute.data) == len(shares):
        attribute.data.foreach_get("value", shares)
    elif index >= 0:
        for place, vertex in enumerate(mesh.vertices):
            for entry in vertex.groups:
                if entry.group == index:
                    shares[place] = entry.weight
    else:
        return None
    np.clip(np.nan_to_num(shares), 0.0, 1.0, out=shares)
    return Painted(hashlib.blake2b(shares, digest_size=16).digest(), shares)


def spread(plan, ground, painted):
    """Return the shares (v,) at the vertices of a layer; None if they are 1 everywhere, or if the surfaces have changed since.

    plan, ground: work.Plan of the layer, and its Ground. painted: for each surface its Painted, or None for a share of 1.
    """
    counts = [len(one.faces.positions) for one in plan.lain_on]
    if not any(painted) or counts != [count if one is None else len(one.shares) for count, one in zip(counts, painted)]:
        return None
    return _spread.made((plan.lain_on, plan.resolution, painted), lambda: _refined(counts, ground, painted))


def _refined(counts, ground, painted):
    given = np.concatenate([np.ones(count, np.float32) if one is None else one.shares for count, one in zip(counts, painted)])
    first = len(given)
    shares = np.concatenate([given, np.empty(len(ground.ends), np.float32)])
    at, later = first, ground.ends.max(axis=1, initial=0)
    while at < len(shares):
        # The middles of all edges whose ends are known by now.
        waits = later[at - first :] >= at
        end = at + int(waits.argmax()) if waits.any() else len(shares)
        ends = ground.ends[at - first : end - first]
        shares[at:end] = 0.5 * (shares[ends[:, 0]] + shares[ends[:, 1]])
        at = end
    return shares
