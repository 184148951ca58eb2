"""Surface of the pulled mesh: which point a ray meets, which vertices are near, and the normals."""

import math
from functools import cached_property

import bpy

from ...core.lazy import numpy as np
from ..mesh import arrays
from .relax import Neighbourhood
from .trees import MOST_PARTS, Tree


class Surface:
    """Two shapes of one mesh: `start`, on which distances are measured, and the visible shape.

    The visible shape is the evaluated mesh if modifiers and shape keys keep the number of vertices; otherwise it is the mesh itself.
    """

    def __init__(self, mesh):
        self._mesh = mesh
        self._start_tree, self._seen_tree = Tree(), Tree()
        self._moved_since_start = []
        self._seen = None
        self._is_deformed = mesh.is_deformed()

    @cached_property
    def triangles(self):
        """Triangles, int32 (t, 3), without hidden faces in the modes that do not show these."""
        return self._mesh.triangles(visible_only=self._mesh.obj.mode != 'OBJECT')

    @cached_property
    def edges(self):
        """Edges, int32 (e, 2) indices of vertices."""
        return self._mesh.edges()

    @cached_property
    def neighbourhood(self):
        """Neighbours of each vertex, for smoothing."""
        return Neighbourhood(self.edges, arrays.faces_of_edges(self._mesh.mesh))

    @cached_property
    def _corners(self):
        return self._mesh.corners()

    @cached_property
    def _hidden(self):
        return self._mesh.hidden()

    def reopen(self, mesh):
        """Continue on a newly opened view of the same mesh; re-reads which vertices are hidden."""
        self._mesh = mesh
        self.__dict__.pop("_hidden", None)
        self._is_deformed, self._seen = mesh.is_deformed(), None

    def normal(self, vertex, shape):
        """Unit normal at a vertex of a shape (n, 3) of the mesh; zero for a loose vertex."""
        return arrays.vertex_normal(self._mesh.mesh, self._corners, shape, vertex)

    def pick(self, origin, direction, metric, start, current):
        """Intersect a ray in the object's space: (triangle, point, normal at the point, root) or None. See Hit.

        current: the present shape; None if it equals the start.
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
        """Position in the object's space at which a vertex is seen; start and current as for pick()."""
        return self._seen_shape(start if current is None else current)[vertex]

    def picker(self, start):
        """The library's Picker over the start shape."""
        return self._start_tree.picker(start, self.triangles, self.edges)

    @property
    def has_picker(self):
        """Whether picker() can answer without building a tree first."""
        return self._start_tree.is_built

    def moved(self, indices, at_most=math.inf):
        """Record that vertices of the present shape have moved; None stands for any vertices. at_most: largest distance of a move."""
        self._seen_tree.moved(indices, math.inf if self._is_deformed else at_most)
        if indices is None or len(self._moved_since_start) > MOST_PARTS:
            self._moved_since_start = [None]
        else:
            self._moved_since_start.append(indices)
        self._seen = None

    def start_moved(self, indices):
        """Record that vertices of the start shape have moved; None stands for any vertices."""
        self._start_tree.moved(indices)

    def start_is_current(self):
        """Record that the start shape was replaced by the present shape."""
        for indices in self._moved_since_start:
            self._start_tree.moved(indices)
        self._moved_since_start = []

    def _seen_shape(self, shape):
        if not self._is_deformed:
            return shape
        if self._seen is None:
            # The present view layer's: the view layer in which the mesh was read may have been removed with its depsgraph.
            found = self._mesh.evaluated_positions(bpy.context.evaluated_depsgraph_get())
            if found is None:
                self._is_deformed = False
                return shape
            self._seen = found
            self._seen_tree.moved(None)
        return self._seen
