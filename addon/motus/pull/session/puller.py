"""Apply one dab of the brush to arrays: find the vertices in reach, and call the native function that moves them."""

from ...core import native
from ...core.lazy import numpy as np
from ..mesh import clipping, welding

LARGE = 0.12
"""If a straight reach exceeds this share of the mesh's size, one pass over all vertices is faster than the search tree."""
MOST_REACHES = 64
"""Largest number of pulled vertices whose reach is cached, for a mouse that rests or moves to and fro."""


class Puller:
    """Applies dabs to the positions of one mesh; reads the weights of the vertices when they are first needed."""

    def __init__(self, mesh, surface, space, welded):
        """Apply dabs to a mesh. welded: Welding of its vertices, or None. The remaining arguments are those of reopen()."""
        self._surface, self._welded = surface, welded
        self._groups = {}
        self.reopen(mesh, space)

    def reopen(self, mesh, space):
        """Continue with the same mesh after it was opened anew; reads hidden and masked vertices again, but not vertex groups.

        mesh: access to the mesh's data, from open_mesh(). space: the object's transform.
        """
        self._mesh, self._space = mesh, space
        self._planes = clipping.planes(mesh.obj)
        self._weights = {}
        self.forget()

    def forget(self):
        """Drop the cached distances, which were measured on the shape at the start of the previous stroke."""
        self._reaches = {}
        self._extent = None

    def pull(self, current, vertex, displacement, brush, radius, start):
        """Pull the positions `current` (n, 3) at a vertex, in place; returns the indices of vertices that may have moved.

        displacement: in the object's space. start: shape on which distances are measured.
        """
        reaches = self._reaches_of(vertex, brush, radius, start)
        moved = _together(reaches)
        before = current[moved]
        self._native_pull(current, vertex, displacement, brush, radius, current, reach=reaches)
        self._clamp(current, moved, before, brush)
        self._clip(current, moved, start)
        return moved

    def pull_from(self, base, current, last_moved, vertex, displacement, brush, radius):
        """Set `current` (n, 3) to the result of one pull on the shape `base`; returns the indices of vertices that may differ from `base`.

        last_moved: vertices at which `current` differs from `base` before the call; None if they are unknown. displacement: in the object's
        space.
        """
        if last_moved is None:
            np.copyto(current, base)
        elif len(last_moved):
            current[last_moved] = base[last_moved]
        return self.pull(current, vertex, displacement, brush, radius, base)

    def smooth(self, current, vertex, strength, brush, radius, start):
        """Smooth the positions `current` (n, 3) around a vertex, in place; returns the indices of vertices that may have moved.

        start: shape on which distances are measured.
        """
        moved, forces = np.empty(0, np.int64), np.empty(0, np.float32)
        for indices, distances in self._reaches_of(vertex, brush, radius, start):
            both = np.union1d(moved, indices)
            largest = np.zeros(len(both), np.float32)
            largest[np.searchsorted(both, moved)] = forces
            at = np.searchsorted(both, indices)
            largest[at] = np.maximum(largest[at], native.module.pull_forces(distances, radius, **brush.profile))
            moved, forces = both, largest  # type: ignore[assignment]
        weights = self.weights(brush)
        if weights is not None:
            forces = forces * weights[moved]
        before = current[moved]
        leaders, places = moved, slice(None)
        if self._welded is not None:
            leaders, places = np.unique(self._welded.leaders[moved], return_inverse=True)
        step = self._surface.neighbourhood.middles(current, leaders) - current[leaders]
        # Forces are in [0, 1]: with a strength of 1 a vertex moves exactly to the middle of its neighbours.
        share = np.minimum(strength * forces, 1.0)[:, None]
        current[moved] += (share * step[places]).astype(np.float32)
        self._clamp(current, moved, before, brush, always=True)
        self._clip(current, moved, start)
        return moved

    def forces(self, vertex, brush, radius, start):
        """Return (indices, forces) of the vertices that a dab at a vertex moves, without mirror images."""
        indices, distances = self._reach(vertex, 0, brush, radius, start)
        return indices, native.module.pull_forces(distances, radius, **brush.profile)

    def weights(self, brush):
        """Factor on the displacement of each vertex, float32 (n,): vertex group, sculpt mask and hidden vertices multiplied.

        None if all vertices follow in full.
        """
        if brush.vertex_group not in self._weights:
            self._weights[brush.vertex_group] = self._read_weights(brush.vertex_group)
        return self._weights[brush.vertex_group]

    def _read_weights(self, group):
        factors = []
        if group:
            if group not in self._groups:
                self._groups[group] = self._mesh.weights(group)
            factors.append(self._groups[group])
        mask, hidden = self._mesh.mask(), self._mesh.hidden()
        if mask is not None:
            factors.append(np.clip(1.0 - mask, 0.0, 1.0))
        if hidden is not None:
            factors.append(~hidden)
        if not factors:
            return None
        weights = np.ascontiguousarray(np.multiply.reduce(factors), np.float32)
        return weights if self._welded is None else self._welded.least(weights, np.arange(len(weights)))

    def may_sweep(self, brush, radius, start):
        """Whether sweep() can apply this dab, and is faster than pull(), which uses the search tree."""
        if brush.distance != 'STRAIGHT' or self._welded or self._planes or self.is_clamped_in_world(brush):
            return False
        if brush.mirror and self._space.is_skewed_by_mirrors(brush.unit):
            return False
        if not self._surface.has_picker:
            return True
        if self._extent is None:
            with np.errstate(invalid="ignore"):
                self._extent = np.nan_to_num(np.ptp(start, axis=0))
        sides = np.linalg.norm(self._space.metric(brush.unit) * self._extent, axis=0)
        return brush.reach_of(radius) > LARGE * sides.max()

    @property
    def has_planes(self):
        """Whether the object has Mirror modifiers with Clipping, whose planes hold vertices."""
        return bool(self._planes)

    def is_clamped_in_world(self, brush):
        """Whether the brush has limits along a world axis to which no axis of the object is parallel."""
        return (brush.use_minimum or brush.use_maximum) and self._space.limits(brush) is None

    def sweep(self, shape, vertex, displacement, brush, radius, start, out, copy=None):
        """Write the result of a dab on `shape` into `out` (and `copy`, if given), by one pass over all vertices.

        start: shape on which distances are measured. Returns the indices of moved vertices; None stands for all vertices, if the mesh is
        written as a whole anyway.
        """
        self._native_pull(shape, vertex, displacement, brush, radius, out, copy=copy, shape=None if start is shape else start)
        if self._mesh.writes_all:
            return None
        return np.flatnonzero((out.view(np.uint32) != shape.view(np.uint32)).any(axis=1))

    def _native_pull(self, positions, vertex, displacement, brush, radius, out, **measured):
        limits = self._space.limits(brush)
        axis, minimum, maximum = limits if limits is not None else (2, -np.inf, np.inf)
        native.module.pull(
            positions,
            vertex,
            displacement,
            radius,
            weights=self.weights(brush),
            minimum=float(minimum) if np.isfinite(minimum) else None,
            maximum=float(maximum) if np.isfinite(maximum) else None,
            clamp_axis=axis,
            mirror="".join(sorted(brush.mirror)).lower(),
            metric=self._space.metric(brush.unit),
            out=out,
            **measured,
            **brush.profile,
        )

    def _reaches_of(self, vertex, brush, radius, start):
        return [self._reach(vertex, bits, brush, radius, start) for bits in brush.mirror_bits()]

    def _reach(self, vertex, bits, brush, radius, start):
        """Return (indices, distances) of the vertices that a pull at a vertex reaches.

        bits: axes that are reversed for a mirror image of the pull, 0 for the pull itself.
        """
        key = vertex, bits, radius, brush.falloff, brush.distance, brush.unit
        if key not in self._reaches:
            if len(self._reaches) >= MOST_REACHES:
                self._reaches.clear()
            self._reaches[key] = welding.reach(
                self._surface.picker(start),
                start,
                self._welded,
                vertex,
                bits,
                brush.reach_of(radius),
                brush.distance.lower(),
                self._space.metric(brush.unit),
            )
        return self._reaches[key]

    def _clamp(self, current, moved, before, brush, always=False):
        """Apply the brush's limits to moved vertices, if they are along a world axis to which no axis of the object is parallel.

        Limits along an axis of the object are applied by the native function already. always: apply them in any case. before: positions
        before the dab.
        """
        if not (brush.use_minimum or brush.use_maximum) or not (always or self.is_clamped_in_world(brush)):
            return
        changed = moved[(current[moved] != before).any(axis=1)]
        current[changed] = self._space.clamp(current[changed], brush)

    def _clip(self, current, moved, start):
        if self._planes:
            current[moved] = clipping.clip(current[moved], start[moved], self._planes)


def _together(reaches):
    """Rising indices of all vertices in several reaches, each (indices, distances)."""
    found = reaches[0][0]
    for indices, _ in reaches[1:]:
        found = np.union1d(found, indices)
    return found
