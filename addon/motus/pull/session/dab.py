"""Session of pulls on one mesh: the operator uses it both from scripts and with the mouse."""

import dataclasses
import math
from typing import Any, NamedTuple

from mathutils import Vector

from ...core import native
from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.translations import tr
from ..brush import AXIS_INDEX, Space
from ..mesh import object_mesh, welding
from ..mesh.open_mesh import open_mesh
from ..properties import is_finite
from .history import Done, History
from .puller import Puller
from .surface import Surface

NONE_MOVED = ()
"""Stands for an empty array of vertex indices."""


class Hit(NamedTuple):
    """World position and normal at which a ray hits the visible surface, with the hit triangle.

    vertex: the vertex that a pull there moves (the root). It is the vertex nearest to the point among the hit triangle's vertices and those
    of connected triangles that are seen from the ray's side; hidden vertices are left out. If triangles are thin, it may belong to a
    neighbouring triangle, but never to the far side of a wall.
    """

    point: Any
    normal: Any
    triangle: int
    vertex: int


class Session:
    """Session of pulls on one mesh: the shape at the start, the present shape, and the methods that change it.

    Raises Refused if the mesh cannot be edited.
    If the brush's `accumulate` is on, each pull builds on the previous pull, and distances are measured on the shape at the start of the
    stroke. Otherwise each pull starts from the shape at the start of the session. In both cases a drag starts from the shape at the start
    of its stroke, and later pulls start from the result of the drag.
    A session makes no undo steps and no reports.
    """

    def __init__(self, context, obj, brush):
        if native.module is None:
            raise Refused(native.status.sentence)
        self.brush = brush
        self.mesh = open_mesh(obj)
        self.object_name = obj.name
        depsgraph = context.evaluated_depsgraph_get()
        self.space = Space(obj.evaluated_get(depsgraph).matrix_world)
        self.current = self.mesh.positions()
        _refuse_strange(self.current)
        self._welded = welding.weld(self.current, brush.weld, self.metric)
        self._surface = Surface(self.mesh, self._welded)
        self._puller = Puller(self.mesh, self._surface, self.space, self._welded)
        self._given: tuple[Any, ...] = ()
        self._begin()

    def begin_again(self, context, obj, brush):
        """Make the present shape the start of a new session with this brush, in which the same vertices are welded.

        Returns False, and changes nothing, if the object or its mesh is not in the state in which the session left it, or if vertices are
        to be welded differently.
        """
        mesh = open_mesh(obj)
        depsgraph = context.evaluated_depsgraph_get()
        space = Space(obj.evaluated_get(depsgraph).matrix_world)
        is_same = obj.name == self.object_name and type(mesh) is type(self.mesh)
        if not is_same or not self._welds_alike(brush, space) or not _same(self.current, mesh.positions()):
            return False
        self.brush, self.mesh, self.space = brush, mesh, space
        self._surface.reopen(mesh)
        self._puller.reopen(mesh, space)
        self._begin()
        return True

    def _welds_alike(self, brush, space):
        """Whether a brush, on an object with this Space, welds the vertices that are welded already."""
        if self._welded is None:
            return brush.weld == 0.0
        return brush.weld == self.brush.weld and np.array_equal(space.metric(brush.unit), self.metric)

    def _begin(self):
        # These arrays are never changed in place, so that the history may refer to them; see _writable().
        self._original = self._base = self._start = self.current
        self._surface.start_is_current()
        self._is_fresh = True
        self._is_drag = False
        self._history = History()
        self._unwritten = []
        self._spares = []  # unused arrays for shapes, which sweeps fill in turn; see _spare()
        self._last_moved: Any = NONE_MOVED

    # --- Vertices to pull -------------------------------------------------------------------------------------------

    def pick(self, origin, direction):
        """Return the Hit of a ray with the visible surface; None if the ray hits nothing. origin, direction: in the world."""
        found = self._surface.pick(
            self.space.point_to_local(origin),
            self.space.inverse @ np.asarray(direction, float),
            self.metric,
            self._start,
            self._shape_of_now,
        )
        if found is None:
            return None
        triangle, point, normal, vertex = found
        return Hit(Vector(self.space.point_to_world(point)), Vector(self.space.normal_to_world(normal)), triangle, vertex)

    def nearest(self, location):
        """Return (index, distance in the brush's unit) of the visible vertex nearest to a world position."""
        return object_mesh.nearest(self.current, self.space.point_to_local(location), self.metric, self.mesh.hidden())

    def place(self, vertex):
        """World position of a vertex in the present shape, without modifiers."""
        return Vector(self.space.point_to_world(self.current[vertex]))

    def seen_place(self, vertex):
        """World position at which the user sees a vertex.

        Modifiers and shape keys are included if they keep the number of vertices.
        """
        return Vector(self.space.point_to_world(self._surface.seen_place(vertex, self._start, self._shape_of_now)))

    def normal(self, vertex):
        """World normal of the surface at a vertex, in the shape at the start of the stroke; zero for a vertex without faces."""
        return Vector(self.space.normal_to_world(self._surface.normal(vertex, self._start)))

    def world_positions(self, indices=None):
        """World positions (m, 3) of vertices in the present shape. indices: of the vertices; None for all."""
        return self.space.point_to_world(self.current if indices is None else self.current[indices])

    def to_world_vector(self, vector):
        """Convert a vector from the space that the brush's unit names (world or object) to the world."""
        return Vector(vector if self.brush.unit == 'WORLD' else self.space.linear @ np.asarray(vector, float))

    def length(self, vector):
        """Length of a world vector, measured in the brush's unit."""
        return float(np.linalg.norm(self.metric @ (self.space.inverse @ np.asarray(vector, float))))

    def to_world_point(self, point):
        """Convert a position from the space that the brush's unit names (world or object) to the world."""
        return Vector(point if self.brush.unit == 'WORLD' else self.space.point_to_world(point))

    def forces(self, vertex):
        """Return (indices, forces) of the vertices that a pull at a vertex moves, for drawing the cursor.

        Mirror images and weights of vertices are ignored.
        """
        return self._puller.forces(vertex, self.brush, self.brush.radius, self._start)

    @property
    def metric(self):
        """3x3 matrix: |metric @ v| is the length of a local vector v in the brush's unit."""
        return self.space.metric(self.brush.unit)

    @property
    def reach_radius(self):
        """Distance from the pulled vertex, in the brush's unit, at and beyond which a pull moves nothing."""
        return self.brush.reach_of(self.brush.radius)

    # --- Changes ----------------------------------------------------------------------------------------------------

    def begin_stroke(self, is_drag=False):
        """Begin a stroke of dabs; its distances and normals are measured on the present shape.

        is_drag: whether drag() will make the stroke.
        """
        if not self._is_fresh:
            if self.brush.accumulate or self._is_drag or is_drag:
                self._start_now()
            elif self._start is not self._base:
                self._start_at_base()
        if self._is_drag:
            self._build_on_start()
        before = self._start if self._is_fresh else self.current.copy()
        self._history.begin_stroke(before, self.current, self._base)
        self._is_drag = is_drag
        if is_drag:
            self._build_on_start()

    def displacement(self, vertex, sign=1.0, view=None):
        """World-space vector by which one dab of the brush moves a vertex.

        vertex: index of the vertex. sign: -1 to push instead of pulling. view: world direction to the viewer, for the direction View.
        Raises Refused if the brush's direction cannot be determined.
        """
        brush, space = self.brush, self.space
        if brush.direction in AXIS_INDEX:
            local = np.eye(3)[AXIS_INDEX[brush.direction]]
            local = space.inverse @ local if brush.unit == 'WORLD' else local
        elif brush.direction == 'CURSOR':
            raise Refused(tr("There is no cursor to go along with: choose another direction or give a displacement"))
        elif brush.direction == 'VIEW':
            if view is None:
                raise Refused(tr("There is no view to pull towards: choose another direction"))
            local = space.inverse @ np.asarray(view, float)
        else:
            local = self._surface.normal(vertex, self._start)
            if not local.any():
                raise Refused(tr("Vertex {index} has no normal: choose another direction").format(index=vertex))
            if brush.unit == 'WORLD':
                local = space.inverse @ space.normal_to_world(local)
        local = local / np.linalg.norm(self.metric @ local)
        return Vector(sign * brush.strength * (space.linear @ local))

    def pull(self, vertex, displacement, pressure=1.0, write=True):
        """Pull a vertex by a world vector, and let the vertices in reach follow; returns False if nothing is to be done.

        pressure: of the pen, 0 to 1. write: if False, the mesh is left unchanged until flush(), which may follow after several dabs.
        """
        brush = self.brush
        local = self.space.inverse @ np.asarray(displacement, float)
        if brush.use_pressure_strength:
            local = local * pressure
        radius = brush.radius * (pressure if brush.use_pressure_size else 1.0)
        return self.repeat(Done('PULL', vertex, local, radius), write)

    def drag(self, vertex, displacement, write=True):
        """Replace the present stroke by one pull of a vertex by a world vector; a zero vector undoes the stroke.

        The pen's pressure is ignored, so that the vertex stays under the pen. write: if False, the mesh is left unchanged until flush().
        Returns False if nothing is to be done.
        """
        local = self.space.inverse @ np.asarray(displacement, float)
        return self.repeat(Done('DRAG', vertex, local, self.brush.radius), write)

    def smooth(self, vertex, strength=0.5, pressure=1.0, write=True):
        """Smooth the surface around a vertex; returns False if nothing is to be done.

        Later pulls start from the result, with or without `accumulate`. pressure: of the pen, 0 to 1. write: if False, the mesh is left
        unchanged until flush().
        """
        brush = self.brush
        if brush.use_pressure_strength:
            strength *= pressure
        radius = brush.radius * (pressure if brush.use_pressure_size else 1.0)
        return self.repeat(Done('SMOOTH', vertex, (0.0, 0.0, 0.0), radius, strength), write)

    def repeat(self, dab, write=False):
        """Apply a dab, given as a Done with a displacement in the object's space; returns False if nothing is to be done.

        write: if False, the mesh is left unchanged until flush(). Raises Refused if the displacement or the radius is too large.
        """
        if not is_finite((*dab.displacement, dab.radius)):
            raise Refused(tr("The displacement or the radius of this pull is too large"))
        dab = dab._replace(displacement=tuple(np.asarray(dab.displacement, np.float32).tolist()))
        if dab.radius <= 0.0 or not (dab.strength if dab.kind == 'SMOOTH' else any(dab.displacement)):
            if dab.kind == 'DRAG' and self._history.has_begun:
                self.step_back()
                self.begin_stroke(is_drag=True)
            return False
        if dab.kind == 'SMOOTH':
            self._smooth(dab, write)
        elif dab.kind == 'PULL' and self.brush.accumulate:
            self._pull_on(dab, write)
        else:
            self._pull_afresh(dab, write)
        return True

    def flush(self):
        """Write the changes into the mesh that calls with write=False have left out."""
        if not self._unwritten:
            return
        moved = None
        if all(part is not None for part in self._unwritten):
            parts = [part for part in self._unwritten if len(part)]
            moved = np.concatenate(parts) if parts else NONE_MOVED
        self.mesh.write(self.current, moved)
        self._unwritten = []

    def step_back(self):
        """Undo the last stroke; returns False if there is none."""
        found = self._history.pop_stroke(self.current)
        if found is None:
            return False
        shape, self._base = found
        self._is_drag = False
        self._go_to(shape)
        return True

    def restore(self):
        """Restore the mesh to its shape at the start of the session, bit for bit."""
        self._base = self._original
        self._is_drag = False
        self._go_to(self._original.copy())
        self._history = History()

    def finish(self):
        """Write all changes into the mesh and update it; returns whether anything has changed. Another stroke may begin afterwards."""
        self.flush()
        self.mesh.finish()
        return self.has_changed

    @property
    def welded(self):
        """Number of vertices that move as one with another, by the brush's weld distance."""
        return 0 if self._welded is None else self._welded.count

    @property
    def has_changed(self):
        """Whether any vertex has a different position than at the start of the session."""
        if self.current is self._original:
            return False
        roots = [dab.vertex for dab in self.dabs]  # the roots, which move most
        return not _same(self._original[roots], self.current[roots]) or not _same(self._original, self.current)

    @property
    def is_cancelled(self):
        """Whether the last pull moved nothing only because the pull and its mirror images cancel each other."""
        last = self.last
        if last is None or not last.brush.mirror:
            return False
        alone = dataclasses.replace(last.brush, mirror=frozenset())
        return self._would_move(last.dab, alone) and not self._would_move(last.dab, last.brush)

    def shapes_of_last(self):
        """Return the shapes (n, 3) before and after the last stroke, as arrays that the session will not change any more."""
        self._given = self.last.before, self.current
        return self._given

    @property
    def is_last_like_a_pin(self):
        """Whether a pin with the settings of the last stroke would give the shape after the stroke.

        A pin pulls at one vertex, and ignores masks, hidden vertices, mirror planes and limits along slanted world axes.
        """
        last = self.last
        is_held = self._puller.has_planes or self._puller.is_clamped_in_world(last.brush)
        return last.is_alone and self.mesh.follows_whole() and not is_held

    @property
    def dabs(self):
        """Dabs of the session in order, as Done values."""
        return self._history.dabs

    @property
    def last(self):
        """The last stroke of pulls, as a Pulled; None before the first stroke, and after smoothing."""
        return self._history.last

    def _would_move(self, dab, brush):
        shape = self._original.copy()
        self._puller.pull(shape, dab.vertex, dab.displacement, brush, dab.radius, self._original)
        return not _same(shape, self._original)

    def _pull_on(self, dab, write):
        place = tuple(self.current[dab.vertex].tolist())
        moved, room = self._pull(dab, write, is_on_top=True)
        self._history.add(dab, self.brush, place, self._start)
        self._changed([moved], write, room, self.brush.largest_force * np.linalg.norm(dab.displacement))

    def _pull_afresh(self, dab, write):
        place = tuple(self._base[dab.vertex].tolist())
        moved, room = self._pull(dab, write, is_on_top=False)
        self._history.add(dab, self.brush, place, self._base)
        # Vertices that the previous dab has moved return to their previous positions, which is a change too.
        changed, self._last_moved = [moved, self._last_moved], moved
        self._changed(changed, write, room)

    def _pull(self, dab, write, is_on_top):
        """Set the present shape to the result of a dab.

        is_on_top: whether the dab acts on the present shape, or on the base, from which pulls that do not accumulate start. The faster of
        two ways is taken: one pass over all vertices, or the search tree. Returns (indices of moved vertices or None for all, the mesh's
        memory if it was filled too, otherwise None).
        """
        numbers = dab.vertex, dab.displacement, self.brush, dab.radius
        start = self._start if is_on_top else self._base
        if self._puller.may_sweep(self.brush, dab.radius, start):
            room = self._room(write)
            return self._sweep(numbers, start, room, is_on_top), room
        if is_on_top:
            return self._puller.pull(self._writable(), *numbers, start), None
        return self._puller.pull_from(self._base, self._writable(), self._last_moved, *numbers), None

    def _sweep(self, numbers, start, room, is_on_top):
        source = self.current if is_on_top else self._base
        after = self._spare() if is_on_top or self._is_kept(self.current) else self.current
        if is_on_top and room is not None and not self._unwritten:
            # The mesh's memory holds the shape already, and is still in the processor's cache.
            moved = self._puller.sweep(room, *numbers, start, room, after)  # type: ignore[call-arg]
        else:
            moved = self._puller.sweep(source, *numbers, start, after, room)  # type: ignore[call-arg]
        self.current = after
        return moved

    def _smooth(self, dab, write):
        place = tuple(self.current[dab.vertex].tolist())
        moved = self._puller.smooth(self._writable(), dab.vertex, dab.strength, self.brush, dab.radius, self._start)
        self._history.add(dab, self.brush, place, self._start)
        self._changed([moved], write)
        if not self.brush.accumulate:
            self._start_now()
            self._build_on_start()

    @property
    def _shape_of_now(self):
        """Present shape; None if it equals the shape at the start of the stroke, for which a search tree exists."""
        return self.current if (self.brush.accumulate or self._is_drag) and not self._is_fresh else None

    def _is_kept(self, shape):
        """Whether an array is referenced elsewhere (by the history or the caller), so that it must not be changed."""
        last = self._history.last
        kept = (self._original, self._base, self._start, *self._given, last.before if last else None)
        return any(shape is one for one in kept)

    def _writable(self):
        """Return the present shape as an array that may be changed in place; copy it if it is referenced elsewhere."""
        if self._is_kept(self.current):
            self.current = self.current.copy()
        return self.current

    def _spare(self):
        """Return an array (n, 3) for a new shape: an array that is no longer used, or a new array."""
        found = next((one for one in self._spares if one is not self.current and not self._is_kept(one)), None)
        if found is None:
            found = np.empty_like(self.current)
            self._spares.append(found)
        return found

    def _room(self, write):
        """Memory of the mesh's positions if the mesh is to be written now; None if not, or if there is no access to the memory."""
        return self.mesh.room() if write else None

    def _changed(self, parts, write, room=None, at_most=math.inf):
        """Update the search trees and the mesh after a change of the present shape.

        parts: list of arrays of moved vertices; None in the list stands for all vertices. room: memory of the mesh that was filled with the
        present shape, or None. at_most: largest distance that a vertex has moved, in the object's space.
        """
        self._is_fresh = False
        for moved in parts:
            self._surface.moved(moved, at_most)
        if room is not None:
            self.mesh.filled()
            self._unwritten = []
            return
        self._unwritten += parts
        if write:
            self.flush()

    def _go_to(self, shape):
        self.current = shape
        self._changed([None], write=True)
        if self.brush.accumulate:
            self._start_now()
        else:
            self._start_at_base()

    def _start_now(self):
        self._start = self.current.copy()
        self._surface.start_is_current()
        self._puller.forget()
        self._is_fresh = True

    def _build_on_start(self):
        """Make the shape at the start of the stroke the base, from which pulls that do not accumulate start."""
        self._base = self._start
        self._last_moved = NONE_MOVED

    def _start_at_base(self):
        self._start = self._base
        self._surface.start_moved(None)
        self._puller.forget()
        # Which vertices differ from the base is unknown.
        self._last_moved = None


def _refuse_strange(positions):
    """Raise Refused if the position of a vertex is not finite."""
    with np.errstate(over="ignore", invalid="ignore"):
        if np.isfinite(positions.sum()):
            return
    strange = ~np.isfinite(positions).all(axis=1)
    if strange.any():
        raise Refused(tr("Vertex {index} is at no place: its coordinates are not finite").format(index=int(strange.argmax())))


def _same(one, other):
    """Whether two arrays of positions are equal bit for bit; equal NaN values count as equal."""
    return one.shape == other.shape and np.array_equal(one.view(np.uint32), other.view(np.uint32))
