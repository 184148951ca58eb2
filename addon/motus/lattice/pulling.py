"""Pull a lattice by a point of the surface that it deforms: the lattice's points move as little as possible (least squares)."""

import contextlib
from itertools import combinations
from typing import Any

from ..core import native
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import shapes
from .targets import check_scale

ROUNDS = 6
"""Most correction steps, for modifiers after the lattice that are not linear in its points."""
NEAR = 1e-5
"""Share of the pull's length: a point that ends nearer to its goal counts as brought there."""


def check_pullable(lattice):
    """Refuse a lattice whose points cannot be set."""
    if lattice.library or lattice.data.library:
        raise Refused(tr("{object} is linked from another file: make a library override of it first").format(object=lattice.name))
    if lattice.data.is_editmode:
        raise Refused(tr("Leave Edit Mode of {object} first").format(object=lattice.name))
    if lattice.data.shape_keys:
        raise Refused(tr("{object} has shape keys, which decide where its points are").format(object=lattice.name))
    check_scale(lattice)


def modifier_of(obj, name=""):
    """The object's Lattice modifier of this name; without a name the last one that has an effect."""
    found = [one for one in obj.modifiers if one.type == 'LATTICE' and one.object and one.object.type == 'LATTICE']
    if name:
        found = [one for one in found if one.name == name]
        if not found:
            raise Refused(tr("{object} has no lattice modifier {modifier}").format(object=obj.name, modifier=name))
    found = [one for one in found if one.show_viewport]
    if not found:
        raise Refused(tr("{object} is deformed by no lattice: fit one first").format(object=obj.name))
    return found[-1]


class Shape:
    """An object's points with its lattice and without: `after` and `before`, (v, 3) in world space."""

    def __init__(self, context, obj, modifier):
        context.view_layer.update()
        if not obj.evaluated_get(context.view_layer.depsgraph).is_evaluated or obj.type == 'LATTICE':
            raise Refused(tr("{object} has no surface that could be pulled").format(object=obj.name))
        self.object, self.modifier, self._context = obj, modifier, context
        with _muted(context, modifier):
            self.before = shapes.world_points(obj, context.view_layer.depsgraph)
        self.after = shapes.world_points(obj, context.view_layer.depsgraph)
        if not len(self.after):
            raise Refused(tr("{object} has no geometry").format(object=obj.name))
        if len(self.before) != len(self.after):
            raise Refused(
                tr("Other modifiers give {object} another number of vertices when {modifier} deforms it: switch them off first").format(
                    object=obj.name, modifier=modifier.name
                )
            )

    def triangles(self):
        """Triangles of the deformed surface, (t, 3) int32 indices of vertices."""
        with shapes.evaluated_mesh(self.object, self._context.view_layer.depsgraph) as mesh:
            return shapes.triangles(mesh)

    def nearest(self, place):
        """Index of the vertex nearest to a world position."""
        return int(((self.after - np.array(place, np.float32)) ** 2).sum(axis=1).argmin())

    def influence(self, vertices):
        """Share of the lattice's effect that each vertex gets: strength of the modifier times weight of the vertex group."""
        result = np.full(len(vertices), self.modifier.strength)
        group = self.object.vertex_groups.get(self.modifier.vertex_group) if self.object.type == 'MESH' else None
        if group:
            with shapes.evaluated_mesh(self.object, self._context.view_layer.depsgraph) as mesh:
                weights = np.array([weight(mesh.vertices[vertex], group.index) for vertex in vertices])
            result *= 1.0 - weights if self.modifier.invert_vertex_group else weights
        return result


@contextlib.contextmanager
def _muted(context, modifier):
    before = modifier.show_viewport
    modifier.show_viewport = False
    try:
        context.view_layer.update()
        yield
    finally:
        modifier.show_viewport = before
        context.view_layer.update()


def weight(point, group):
    """Weight of a vertex, or of a lattice point, in the vertex group of this index."""
    return next((entry.weight for entry in point.groups if entry.group == group), 0.0)


class Held:
    """A point of a deformed surface that is held by the mouse or a script; pull() moves the lattice's points."""

    def __init__(self, context, shape, corners, held=(), mirror=""):
        """Prepare a pull.

        corners: [(vertex, share)] of the held point, with shares that add up to 1. held: vertices that stay in place.
        mirror: letters of "XYZ", axes of the lattice across which the pull is repeated.
        """
        lattice = shape.modifier.object
        check_pullable(lattice)
        self._context, self._object, self._lattice, self._corners = context, shape.object, lattice, corners
        self._matrix = np.array(lattice.evaluated_get(context.view_layer.depsgraph).matrix_world, np.float64)
        self._native, self._middle = native_lattice(lattice.data, self._matrix)
        self._start = shapes.lattice_points(lattice.data)
        self._weights = point_weights(lattice)
        parts = [(0, vertex, share) for vertex, share in corners]
        parts += [(1 + index, vertex, 1.0) for index, vertex in enumerate(held)]
        self._count = 1 + len(held)
        self._pulls, vertices, self._shares = (list(column) for column in zip(*parts))
        self._places = shape.before[vertices].astype(np.float64)
        self._influence = shape.influence(vertices)
        if not self._influence[: len(corners)].any():
            raise Refused(
                tr("{modifier} of {object} has no influence there").format(modifier=shape.modifier.name, object=shape.object.name)
            )
        self._mirror(mirror)
        most = native.module.Lattice.MAX_PULLS
        if len(self._turns) * self._count > most < len(self._start):
            raise Refused(tr("At most {count} vertices can be held").format(count=most // len(self._turns) - 1))
        self.point = self._measure_in(shape.after)
        self._is_sum = (
            False  # whether displacements are a weighted sum of those of the lattice's points, so that the weights need no measuring
        )

    def _mirror(self, axes):
        linear = self._matrix[:3, :3]
        self._turns = [np.eye(3)]
        for count in range(1, len(axes) + 1):
            for chosen in combinations(sorted(set(axes)), count):
                signs = [-1.0 if axis in chosen else 1.0 for axis in "XYZ"]
                self._turns.append(linear @ np.diag(signs) @ np.linalg.inv(linear))
        images = len(self._turns)
        self._places = np.concatenate([(self._places - self._middle) @ turn.T + self._middle for turn in self._turns])
        self._pulls = [pull + image * self._count for image in range(images) for pull in self._pulls]
        self._shares, self._influence = np.tile(self._shares, images), np.tile(self._influence, images)  # type: ignore[assignment]

    def pull(self, displacement):
        """Move the held point by a world displacement from its start; returns the distance that remains to the goal."""
        displacement = np.array(displacement, np.float64)
        if not displacement.any():
            self.restore()
            return 0.0
        aim = displacement
        best: Any = None
        for _ in range(ROUNDS):
            points = self._points_for(aim)
            self._write(points)
            if self._is_sum:
                return self._left
            left = self.point + displacement - self._measure()
            distance = float(np.linalg.norm(left))
            if best is not None and distance >= 0.9 * best[0]:
                break
            self._is_sum = best is None and distance <= self._left + NEAR * np.linalg.norm(displacement)  # type: ignore[assignment]
            best = distance, points
            if distance <= self._left + NEAR * np.linalg.norm(displacement):
                break
            aim = aim + left
        if best[1] is not points:
            self._write(best[1])
        return best[0]

    def _points_for(self, displacement):
        wanted = np.zeros((len(self._turns), self._count, 3))
        for image, turn in enumerate(self._turns):
            wanted[image, 0] = turn @ displacement
        moves, left = self._native.pull(
            self._places,
            wanted.reshape(-1, 3),
            self._pulls,
            self._shares,
            self._influence,
            self._weights,
            outside_only=self._lattice.data.use_outside,
        )
        self._left = float(np.linalg.norm(left[0]))
        return (self._start + moves @ np.linalg.inv(self._matrix[:3, :3]).T).astype(np.float32)

    def _write(self, points):
        shapes.set_lattice_points(self._lattice.data, points)

    def _measure(self):
        self._context.view_layer.update()
        depsgraph = self._context.view_layer.depsgraph
        with shapes.evaluated_mesh(self._object, depsgraph) as mesh:
            corners = np.array([mesh.vertices[vertex].co for vertex, _ in self._corners], np.float32)
            world = shapes.in_world(corners, self._object.evaluated_get(depsgraph).matrix_world)
        return sum(share * place for (_, share), place in zip(self._corners, world.astype(np.float64)))

    def _measure_in(self, positions):
        return sum(share * positions[vertex].astype(np.float64) for vertex, share in self._corners)

    def restore(self):
        """Restore the lattice's points exactly as they were before the pull."""
        self._write(self._start)


def native_lattice(data, matrix):
    """Native Lattice in world space, and its middle."""
    rest = shapes.lattice_points(data, "co").astype(np.float64)
    resolution = [getattr(data, f"points_{axis}") for axis in "uvw"]
    extent = [length if count > 1 else 1.0 for length, count in zip(rest[-1] - rest[0], resolution)]
    basis = [getattr(data, f"interpolation_type_{axis}").removeprefix("KEY_").lower() for axis in "uvw"]
    origin, middle = (matrix[:3, :3] @ place + matrix[:3, 3] for place in (rest[0], 0.5 * (rest[0] + rest[-1])))
    return native.module.Lattice(origin, (matrix[:3, :3] * extent).T, resolution, basis), middle


def point_weights(lattice):
    """Weights of the lattice's own vertex group; None if the lattice has no vertex group."""
    group = lattice.vertex_groups.get(lattice.data.vertex_group)
    if group is None:
        return None
    return np.array([weight(point, group.index) for point in lattice.data.points], np.float32)
