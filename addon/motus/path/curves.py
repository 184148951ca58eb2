"""Convert Blender's splines (Bézier, NURBS, poly) into curve objects of the native module."""

import threading
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

from ..core import keeping, native, rigs
from ..core.declare import Problem
from ..core.evaluated import copies
from ..core.lazy import numpy as np

ALL_SPLINES = -1
MAX_DEGREE = 64
MAX_ORDER = 6
CONTROL_POLYGON_KEY = "motus_bezier"
"""Custom property of Curve data in which the points of each poly spline are the control points of one Bézier curve."""

NO_SPLINES = Problem("The curve has no splines")
NO_SUCH_SPLINE = Problem("The curve has no spline of this index")
TOO_FEW_POINTS = Problem("A spline needs two points at least")
TOO_MANY_POINTS = Problem("A Bézier curve of more than 65 control points is not supported")
RATIONAL = Problem("NURBS splines with different weights cannot be followed: make the weights equal")
HIGH_ORDER = Problem("NURBS splines of an order above 6 cannot be followed: lower the order")
PROBLEMS = (NO_SPLINES, NO_SUCH_SPLINE, TOO_FEW_POINTS, TOO_MANY_POINTS, RATIONAL, HIGH_ORDER)

# A second to_curve() on an object frees the result of the first, and drivers run in several threads. Within to_curve() Blender
# may evaluate another driver in the same thread (modifiers run in parallel); that driver ends before to_curve() returns.
_temporary_curve = threading.RLock()

_CURVES = keeping.OfEvaluation(
    "native curves of the splines of an evaluated curve, in the curve's local space",
    "index of the spline",
    "one for each spline that is followed",
)
_IN_WORLD = keeping.OfEvaluation(
    "native curves of the splines of an evaluated curve, in world space",
    "index of the spline; recomputed if the world matrix differs",
    "one for each spline that is followed",
)


class Unreadable(Exception):
    """Exception for a curve that cannot be converted into a native curve. Its attribute `problem` is the Problem that says why."""

    def __init__(self, problem):
        super().__init__(problem.sentence)
        self.problem = problem


@dataclass(frozen=True, eq=False)
class WorldCurve:
    """A native curve in world space. tilt: array of the splines' tilt in radians at the joints of the curve's segments.

    It has what a solve.Course has, for followers that need nothing but the curve.
    """

    curve: Any
    tilt: Any
    space: ClassVar[Any] = None
    rail: ClassVar[Any] = None

    def told(self, reads_length, reads_tilt):
        """Return what a plan of followers is made from of the curve: (length, tilt as bytes), None in place of what the plan does not read."""
        return self.curve.length() if reads_length else None, self.tilt.tobytes() if reads_tilt else None


def read_evaluated(curve_object, depsgraph, index):
    """Convert the spline `index` (or ALL_SPLINES) of an evaluated curve object into a WorldCurve. Raises Unreadable."""
    return read(curve_object, curve_object.data.splines, depsgraph, index, curve_object.matrix_world)


def read(curve_object, splines, depsgraph, index, matrix):
    """Convert spline `index` (or ALL_SPLINES) of an evaluated curve object into a WorldCurve. Raises Unreadable.

    splines: the splines of the object's evaluated data. matrix: world matrix of the result.
    If the object has modifiers or shape keys, the deformed splines are read on each call. In Edit Mode the splines are read on each call
    too, since Blender then moves the points within one evaluated copy. All other splines are read once for each evaluated copy of the data,
    and transformed to the world once for each matrix.
    """
    data = curve_object.data
    is_edited = data.is_editmode  # in Edit Mode Blender shows only the edited shape key
    is_deformed = bool(curve_object.modifiers or (data.shape_keys and not is_edited))
    copy = None if is_deformed or is_edited else copies.of(splines.id_data)  # the splines of a hidden object belong to its original data
    if copy is None or copy.has_animated_splines:
        return _in_world(*_read(curve_object, splines, depsgraph, index, is_deformed), matrix)  # type: ignore[call-arg]
    kept_in_world, place = _IN_WORLD.on(copy), rigs.bytes_of(matrix)
    if index not in kept_in_world or kept_in_world[index][0] != place:
        kept = _CURVES.on(copy)
        if index not in kept:
            kept[index] = _read(curve_object, splines, depsgraph, index, is_deformed)
        kept_in_world[index] = place, _in_world(*kept[index], matrix)  # type: ignore[call-arg]
    return kept_in_world[index][1]


def _in_world(curve, tilt, matrix):
    # If the matrix mirrors the curve, the tilt turns in the opposite sense about the direction of travel.
    return WorldCurve(curve.transformed(np.array(matrix, dtype=float)), -tilt if matrix.is_negative else tilt)


def _read(curve_object, splines, depsgraph, index, is_deformed):
    is_polygon = CONTROL_POLYGON_KEY in curve_object.data
    if not is_deformed:
        return _read_splines(splines, index, is_polygon)
    with _temporary_curve:
        if curve_object.data.is_editmode:
            return _read_shown(curve_object, splines, index, is_polygon)
        try:
            with keeping.aside():
                deformed = curve_object.to_curve(depsgraph, apply_modifiers=True)
            return _read_splines(deformed.splines, index, is_polygon)
        finally:
            curve_object.to_curve_clear()


def _read_shown(curve_object, splines, index, is_polygon):
    """Read a curve in Edit Mode, where to_curve() ignores edits and modifiers.

    Reads the line that Blender draws, from to_mesh(). If the curve has a surface (a bevel, an extrusion or a fill), the edited control
    points are read instead.
    """
    try:
        with keeping.aside():
            mesh = curve_object.to_mesh()
        strips = None if mesh is None or len(mesh.polygons) else _strips(mesh)
    finally:
        curve_object.to_mesh_clear()
    return _read_splines(splines if strips is None else strips, index, is_polygon)


class _Strip(NamedTuple):
    """A line of mesh edges, with the attributes that the reader of splines needs: points, use_cyclic_u and type."""

    points: Any  # (n, 3)
    use_cyclic_u: bool
    type: str = 'STRIP'


def _strips(mesh):
    """Split a mesh without faces into lines (list of _Strip); edges join consecutive vertices, or the ends of a closed line."""
    points = _vectors(mesh.vertices, "co", 3)
    edges = set(map(tuple, np.sort(_whole_pairs(mesh.edges), axis=1).tolist()))
    starts = [at for at in range(len(points)) if (at - 1, at) not in edges]
    ends = [*starts[1:], len(points)]
    return [_Strip(points[start:end], end - start > 2 and (start, end - 1) in edges) for start, end in zip(starts, ends)]


def _whole_pairs(edges):
    found = np.empty(2 * len(edges), np.int32)
    edges.foreach_get("vertices", found)
    return found.reshape(-1, 2)


def _read_splines(splines, index, is_polygon):
    count = len(splines)
    if count == 0:
        raise Unreadable(NO_SPLINES)
    if index != ALL_SPLINES:
        if not 0 <= index < count:
            raise Unreadable(NO_SUCH_SPLINE)
        return _read_spline(splines[index], is_polygon)
    long = long_splines(splines) or splines[:1]
    if len(long) == 1:
        return _read_spline(long[0], is_polygon)
    return _joined([_read_spline(spline, is_polygon) for spline in long])


def long_splines(splines):
    """Return the splines that have more than one point. Followers of all splines skip single points, since a single point has no length."""
    return [one for one in splines if len(one.bezier_points if one.type == 'BEZIER' else one.points) > 1]


def _read_spline(spline, is_polygon):
    if spline.type == 'BEZIER':
        return _read_bezier(spline)
    points, weights, tilt = _read_points(spline)
    if spline.type == 'NURBS':
        return _read_nurbs(spline, points, weights, tilt)
    if is_polygon:
        if len(points) > MAX_DEGREE + 1:
            raise Unreadable(TOO_MANY_POINTS)
        return native.module.Bezier(points), tilt[[0, -1]]
    return native.module.PolyLine(points, spline.use_cyclic_u), tilt


def _read_bezier(spline):
    points = spline.bezier_points
    _require_points(points)
    arrays = [_vectors(points, name, 3) for name in ("co", "handle_left", "handle_right")]
    return native.module.Spline(*arrays, spline.use_cyclic_u), _vectors(points, "tilt", 1)


def _read_nurbs(spline, points, weights, tilt):
    if np.ptp(weights) > 1e-6 * weights.max():
        raise Unreadable(RATIONAL)
    if spline.order_u > MAX_ORDER:
        raise Unreadable(HIGH_ORDER)
    options = spline.order_u, spline.use_cyclic_u, spline.use_endpoint_u, spline.use_bezier_u
    curve = native.module.BSpline(points, *options)
    # A NURBS spline blends the tilt by the basis functions that blend the position.
    tilts = native.module.BSpline(np.column_stack((tilt, tilt, tilt)), *options)
    joints = np.arange(curve.segment_count + (not curve.cyclic), dtype=float)
    return curve, tilts.position(joints)[:, 0]


def _read_points(spline):
    points = spline.points
    _require_points(points)
    if spline.type == 'STRIP':
        return points, None, np.zeros(len(points), np.float32)
    homogeneous = _vectors(points, "co", 4)
    return homogeneous[:, :3], homogeneous[:, 3], _vectors(points, "tilt", 1)


def _require_points(points):
    if len(points) < 2:
        raise Unreadable(TOO_FEW_POINTS)


def _vectors(points, name, size):
    buffer = np.empty(len(points) * size, np.float32)
    points.foreach_get(name, buffer)
    return buffer.reshape(-1, size) if size > 1 else buffer


def _joined(parts):
    """Join several native curves into one chain, with gaps between the curves; returns (chain, tilt at the joints)."""
    degree = max(curve.degree for curve, _ in parts)
    segments = np.concatenate([curve.elevate(degree - curve.degree).control_points.reshape(-1, degree + 1, 3) for curve, _ in parts])
    # At a joint the tilt of the segment that begins there is taken: at a gap the end tilt of the previous spline is not used.
    last, last_tilt = parts[-1]
    end = last_tilt[0 if last.cyclic else -1]
    tilt = np.concatenate([*(values[: curve.segment_count] for curve, values in parts), [end]])
    return native.module.Chain(segments, False), tilt
