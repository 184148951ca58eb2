"""What a session asks of the mesh's surface: what a ray meets, what is near, and which way it faces."""

import math
from functools import cached_property

import bpy

from ...core.lazy import numpy as np
from ..mesh import arrays
from .relax import Neighbourhood
from .trees import MOST_PARTS, Tree


class Surface:
    """Two shapes of one mesh: `start`, which distances are measured on, and the one that is seen.

    The seen one is what modifiers and shape keys make of the mesh where they keep its vertices; else the mesh itself.
    """

    def __init__(self, mesh):
        self._mesh = mesh
        self._start_tree, self._seen_tree = Tree(), Tree()
        self._moved_since_start = []
        self._seen = None
        self._is_deformed = mesh.is_deformed()

    @cached_property
    def triangles(self):
        """int32 (t, 3); without hidden faces in the modes that do not show them."""
        return self._mesh.triangles(visible_only=self._mesh.obj.mode != 'OBJECT')

    @cached_property
    def edges(self):
        """int32 (e, 2)."""
        return self._mesh.edges()

    @cached_property
    def neighbourhood(self):
        """Who is next to whom, for smoothing."""
        return Neighbourhood(self.edges, arrays.faces_of_edges(self._mesh.mesh))

    @cached_property
    def _corners(self):
        return self._mesh.corners()

    @cached_property
    def _hidden(self):
        return self._mesh.hidden()

    def reopen(self, mesh):
        """The same mesh, read anew by others' means: what is hidden is asked again."""
        self._mesh = mesh
        self.__dict__.pop("_hidden", None)
        self._is_deformed, self._seen = mesh.is_deformed(), None

    def normal(self, vertex, shape):
        """Unit normal of a shape (n, 3) of the mesh at a vertex; zero for a loose one."""
        return arrays.vertex_normal(self._mesh.mesh, self._corners, shape, vertex)

    def pick(self, origin, direction, metric, start, current):
        """What a ray in the object's space meets: (triangle, point, its normal there, the root) or None; see Hit.

        current: the shape that is pulled and seen; None where that is the start.
        """
        shape = self._seen_shape(start if current is None else current)
        is_start = current is None and not self._is_deformed
        tree = self._start_tree if is_start else self._seen_tree
        found = tree.pick(shape, self.triangles, self.edges, origin, direction, metric, self._hidden)
        if found is None:
            return None
        triangle, point, vertex = found
        places = shape[self.triangles[triangle]].astype(float)
        return triangle, point, np.cross(places[1] - places[0], places[2] - places[0]), vertex

    def seen_place(self, vertex, start, current):
        """Where a vertex is seen, in the object's space; start, current: as for pick()."""
        return self._seen_shape(start if current is None else current)[vertex]

    def picker(self, start):
        """The native Picker over the start."""
        return self._start_tree.picker(start, self.triangles, self.edges)

    @property
    def has_picker(self):
        """Whether picker() needs not be built first."""
        return self._start_tree.is_built

    def moved(self, indices, at_most=math.inf):
        """Vertices of the current shape are elsewhere now; None means any. at_most: how far they have moved."""
        self._seen_tree.moved(indices, math.inf if self._is_deformed else at_most)
        if indices is None or len(self._moved_since_start) > MOST_PARTS:
            self._moved_since_start = [None]
        else:
            self._moved_since_start.append(indices)
        self._seen = None

    def start_moved(self, indices):
        """Vertices of the start are elsewhere now; None means any."""
        self._start_tree.moved(indices)

    def start_is_current(self):
        """The start is now what is current."""
        for indices in self._moved_since_start:
            self._start_tree.moved(indices)
        self._moved_since_start = []

    def _seen_shape(self, shape):
        if not self._is_deformed:
            return shape
        if self._seen is None:
            # Of the present view layer: the one that the mesh was read in may be gone, and its graph with it.
            found = self._mesh.evaluated_positions(bpy.context.evaluated_depsgraph_get())
            if found is None:
                self._is_deformed = False
                return shape
            self._seen = found
            self._seen_tree.moved(None)
        return self._seen
