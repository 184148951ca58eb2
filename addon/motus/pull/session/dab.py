"""A session of pulls on one mesh: used by the operator, from scripts or by the mouse."""

import dataclasses
import math
from typing import Any, NamedTuple

from mathutils import Vector

from ...core import native
from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.translations import tr
from ..brush import AXIS_INDEX, Space
from ..mesh import object_mesh
from ..mesh.open_mesh import open_mesh
from ..properties import is_finite
from .history import Done, History
from .puller import Puller
from .surface import Surface


NONE_MOVED = ()
"""No indices."""


class Hit(NamedTuple):
    """What a ray meets, in the world; vertex: the root.

    That is the vertex nearest to the point, of those that are not hidden, on the surface that was hit as far as it is seen
    from there: it may belong to another triangle, where they are thin, but not to the far side of a wall.
    """

    point: Any
    normal: Any
    triangle: int
    vertex: int


class Session:
    """The mesh as it was, as it is, and what changes it. Raises Refused where the mesh cannot be edited.

    accumulate on: each pull builds on the last; distances are those of the shape when the stroke began. Off: each pull
    starts from the shape when the session began. A drag starts from the shape when its stroke began, and what is pulled
    afterwards starts from its result, both whether or not it accumulates. Nothing here makes an undo step or a report.
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
        self._surface = Surface(self.mesh)
        self._puller = Puller(self.mesh, self._surface, self.space)
        self._given: tuple[Any, ...] = ()
        self._begin()

    def begin_again(self, context, obj, brush):
        """What is there now becomes what the session began with; False where the mesh is not as the session left it."""
        mesh = open_mesh(obj)
        depsgraph = context.evaluated_depsgraph_get()
        space = Space(obj.evaluated_get(depsgraph).matrix_world)
        is_same = obj.name == self.object_name and type(mesh) is type(self.mesh)
        if not is_same or not _same(self.current, mesh.positions()):
            return False
        self.brush, self.mesh, self.space = brush, mesh, space
        self._surface.reopen(mesh)
        self._puller.reopen(mesh, space)
        self._begin()
        return True

    def _begin(self):
        # These shapes are never changed in place, so that others may keep them; see _writable().
        self._original = self._base = self._start = self.current
        self._surface.start_is_current()
        self._is_fresh = True
        self._is_drag = False
        self._history = History()
        self._unwritten = []
        self._spares = []  # shapes for sweeps to fill, in turn; see _spare()
        self._last_moved: Any = NONE_MOVED

    # --- Where it pulls ---------------------------------------------------------------------------------------------

    def pick(self, origin, direction):
        """What a world ray meets first: a Hit, or None."""
        found = self._surface.pick(
            self.space.point_to_local(origin), self.space.inverse @ np.asarray(direction, float), self.metric, self._start,
            self._shape_of_now)
        if found is None:
            return None
        triangle, point, normal, vertex = found
        return Hit(
            Vector(self.space.point_to_world(point)), Vector(self.space.normal_to_world(normal)), triangle, vertex)

    def nearest(self, location):
        """(index, distance) of the visible vertex nearest to a place of the world; the distance in the brush's unit."""
        return object_mesh.nearest(
            self.current, self.space.point_to_local(location), self.metric, self.mesh.hidden())

    def place(self, vertex):
        """Where a vertex is in the world now."""
        return Vector(self.space.point_to_world(self.current[vertex]))

    def seen_place(self, vertex):
        """Where a vertex is seen in the world: as modifiers and shape keys have it, where they keep the mesh's vertices."""
        return Vector(self.space.point_to_world(self._surface.seen_place(vertex, self._start, self._shape_of_now)))

    def normal(self, vertex):
        """World normal of the surface at a vertex, as the stroke began; zero for a loose one."""
        return Vector(self.space.normal_to_world(self._surface.normal(vertex, self._start)))

    def world_positions(self, indices=None):
        """(m, 3) world positions of these vertices, or of all, as they are now."""
        return self.space.point_to_world(self.current if indices is None else self.current[indices])

    def to_world_vector(self, vector):
        """A vector in the space that the brush's unit says, in the world."""
        return Vector(vector if self.brush.unit == 'WORLD' else self.space.linear @ np.asarray(vector, float))

    def length(self, vector):
        """The length of a world vector in the brush's unit."""
        return float(np.linalg.norm(self.metric @ (self.space.inverse @ np.asarray(vector, float))))

    def to_world_point(self, point):
        """A point in the space that the brush's unit says, in the world."""
        return Vector(point if self.brush.unit == 'WORLD' else self.space.point_to_world(point))

    def forces(self, vertex):
        """(indices, forces) of a pull at a vertex, without mirror images and weights: what the cursor shows."""
        return self._puller.forces(vertex, self.brush, self.brush.radius, self._start)

    @property
    def metric(self):
        """3x3: |metric @ v| is the length of a local vector v in the brush's unit."""
        return self.space.metric(self.brush.unit)

    @property
    def reach_radius(self):
        """The distance from the root, in the brush's unit, at and beyond which nothing moves."""
        return self.brush.reach_of(self.brush.radius)

    # --- What it does -----------------------------------------------------------------------------------------------

    def begin_stroke(self, is_drag=False):
        """From here on distances and normals are those of the shape of now. is_drag: whether drag() makes the stroke."""
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
        """World vector that the brush moves a root by. view: world direction to the viewer. May raise Refused."""
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
        """Move a vertex by a world vector and let those in reach follow; False where there is nothing to do.

        write=False leaves the mesh to flush(), after more dabs.
        """
        brush = self.brush
        local = self.space.inverse @ np.asarray(displacement, float)
        if brush.use_pressure_strength:
            local = local * pressure
        radius = brush.radius * (pressure if brush.use_pressure_size else 1.0)
        return self.repeat(Done('PULL', vertex, local, radius), write)

    def drag(self, vertex, displacement, write=True):
        """Let all of this stroke be one pull of a vertex by a world vector; by a zero vector the stroke is taken back.

        A pen's pressure does not count, so that the vertex stays under it. False where there is nothing to do.
        """
        local = self.space.inverse @ np.asarray(displacement, float)
        return self.repeat(Done('DRAG', vertex, local, self.brush.radius), write)

    def smooth(self, vertex, strength=0.5, pressure=1.0, write=True):
        """Even the surface out around a vertex.

        What is pulled afterwards starts from the result, whether or not it accumulates. False where there is nothing to do.
        """
        brush = self.brush
        if brush.use_pressure_strength:
            strength *= pressure
        radius = brush.radius * (pressure if brush.use_pressure_size else 1.0)
        return self.repeat(Done('SMOOTH', vertex, (0.0, 0.0, 0.0), radius, strength), write)

    def repeat(self, dab, write=False):
        """Do a dab whose numbers are known: a Done, whose displacement is local. False where there is nothing to do."""
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
        """Write what pull(write=False) and smooth(write=False) have left."""
        if not self._unwritten:
            return
        moved = None
        if all(part is not None for part in self._unwritten):
            parts = [part for part in self._unwritten if len(part)]
            moved = np.concatenate(parts) if parts else NONE_MOVED
        self.mesh.write(self.current, moved)
        self._unwritten = []

    def step_back(self):
        """Undo the last stroke; False where there is none."""
        found = self._history.pop_stroke(self.current)
        if found is None:
            return False
        shape, self._base = found
        self._is_drag = False
        self._go_to(shape)
        return True

    def restore(self):
        """Everything as it was when the session began, bit for bit."""
        self._base = self._original
        self._is_drag = False
        self._go_to(self._original.copy())
        self._history = History()

    def finish(self):
        """Leave the mesh in order; True where anything has changed. The session may begin again afterwards."""
        self.flush()
        self.mesh.finish()
        return self.has_changed

    @property
    def has_changed(self):
        """Whether any vertex is elsewhere than when the session began."""
        if self.current is self._original:
            return False
        roots = [dab.vertex for dab in self.dabs]  # which moves most
        return not _same(self._original[roots], self.current[roots]) or not _same(self._original, self.current)

    @property
    def is_cancelled(self):
        """Whether the last pull moved nothing only because its mirror images cancel each other out."""
        last = self.last
        if last is None or not last.brush.mirror:
            return False
        alone = dataclasses.replace(last.brush, mirror=frozenset())
        return self._would_move(last.dab, alone) and not self._would_move(last.dab, last.brush)

    def shapes_of_last(self):
        """The shapes (n, 3) before the last stroke and after it; the session leaves them as they are."""
        self._given = self.last.before, self.current
        return self._given

    @property
    def is_last_like_a_pin(self):
        """Whether a pin of the same numbers does what the last stroke did: it knows one root, and no masks."""
        last = self.last
        is_held = self._puller.has_planes or self._puller.is_clamped_in_world(last.brush)
        return last.is_alone and self.mesh.follows_whole() and not is_held

    @property
    def dabs(self):
        """What has been done, in order: Done values."""
        return self._history.dabs

    @property
    def last(self):
        """The last stroke, a Pulled value; None after smoothing and where there is none."""
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
        # What the dab before has moved is back in its place, which is a change too.
        changed, self._last_moved = [moved, self._last_moved], moved
        self._changed(changed, write, room)

    def _pull(self, dab, write, is_on_top):
        """Let what is current be what a dab makes of it, or of the base.

        One pass over all vertices does it or the tree, whichever takes less time.
        Returns (what has moved, or None for all, the mesh's memory where that is filled too).
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
            # It holds the shape already, and has just been through the processor.
            moved = self._puller.sweep(room, *numbers, start, room, after)  # type: ignore[call-arg]
        else:
            moved = self._puller.sweep(source, *numbers, start, after, room)  # type: ignore[call-arg]
        self.current = after
        return moved

    def _smooth(self, dab, write):
        place = tuple(self.current[dab.vertex].tolist())
        moved = self._puller.smooth(
            self._writable(), dab.vertex, dab.strength, self.brush, dab.radius, self._start)
        self._history.add(dab, self.brush, place, self._start)
        self._changed([moved], write)
        if not self.brush.accumulate:
            self._start_now()
            self._build_on_start()

    @property
    def _shape_of_now(self):
        """The shape that is pulled and seen; None where that is the start."""
        return self.current if (self.brush.accumulate or self._is_drag) and not self._is_fresh else None

    def _is_kept(self, shape):
        """Whether somebody else counts on the shape to stay as it is."""
        last = self._history.last
        kept = (self._original, self._base, self._start, *self._given, last.before if last else None)
        return any(shape is one for one in kept)

    def _writable(self):
        """The current shape, to be changed in place."""
        if self._is_kept(self.current):
            self.current = self.current.copy()
        return self.current

    def _spare(self):
        """Room (n, 3) for another shape: one that is no longer kept, or new."""
        found = next((one for one in self._spares if one is not self.current and not self._is_kept(one)), None)
        if found is None:
            found = np.empty_like(self.current)
            self._spares.append(found)
        return found

    def _room(self, write):
        """The mesh's own memory, where all of it is to be written now; None where it is not, or is not to be had."""
        return self.mesh.room() if write else None

    def _changed(self, parts, write, room=None, at_most=math.inf):
        """Let the mesh and the trees know what has moved.

        parts: lists of indices; None among them means all. room: of the mesh, which has been filled with what is current.
        at_most: how far a vertex has moved, in the object.
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
        """What does not accumulate starts from the shape of now, which is the start."""
        self._base = self._start
        self._last_moved = NONE_MOVED

    def _start_at_base(self):
        self._start = self._base
        self._surface.start_moved(None)
        self._puller.forget()
        # Where the shape differs from the base is not known.
        self._last_moved = None


def _refuse_strange(positions):
    """Raise Refused where a vertex is nowhere."""
    with np.errstate(over="ignore", invalid="ignore"):
        if np.isfinite(positions.sum()):
            return
    strange = ~np.isfinite(positions).all(axis=1)
    if strange.any():
        raise Refused(tr("Vertex {index} is at no place: its coordinates are not finite").format(
            index=int(strange.argmax())))


def _same(one, other):
    """Whether two shapes are equal bit for bit, NaNs included."""
    return one.shape == other.shape and np.array_equal(one.view(np.uint32), other.view(np.uint32))
