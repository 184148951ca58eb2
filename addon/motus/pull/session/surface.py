"""Surface of the mesh that is pulled: where a ray hits it, which vertices are near, and its normals."""

import math
from functools import cached_property

import bpy

from ...core.lazy import numpy as np
from ..mesh import arrays, welding
from .relax import Neighbourhood
from .trees import MOST_PARTS, Tree


class Surface:
    """Two shapes of one mesh: the start shape, on which distances are measured, and the visible shape.

    The visible shape is the evaluated mesh if modifiers and shape keys keep the number of vertices; otherwise it is the mesh itself.
    """

    def __init__(self, mesh, welded):
        """Read a mesh when it is first asked for. welded: Welding of its vertices, or None."""
        self._mesh, self._welded = mesh, welded
        self._start_tree, self._seen_tree = Tree(), Tree()
        self._moved_since_start = []
        self._seen = None
        self._is_deformed = mesh.is_deformed()

    @cached_property
    def triangles(self):
        """Triangles of the welded mesh, int32 (t, 3) vertex indices, without hidden faces except in Object Mode, which shows them."""
        return welding.leaders_of(self._welded, self._mesh.triangles(visible_only=self._mesh.obj.mode != 'OBJECT'))

    @cached_property
    def edges(self):
        """Edges of the welded mesh, int32 (e, 2) vertex indices."""
        return welding.leaders_of(self._welded, self._mesh.edges())

    @cached_property
    def neighbourhood(self):
        """Finds the neighbours of each vertex that leads itself, for smoothing."""
        face_counts = arrays.faces_of_edges(self._mesh.mesh)
        if self._welded is not None:
            return Neighbourhood(*self._welded.edges(self._mesh.edges(), face_counts))
        return Neighbourhood(self.edges, face_counts)

    @cached_property
    def _corners(self):
        return welding.leaders_of(self._welded, self._mesh.corners())

    @cached_property
    def _hidden(self):
        return self._mesh.hidden()

    def reopen(self, mesh):
        """Continue with the same mesh after it was opened anew; reads again which vertices are hidden."""
        self._mesh = mesh
        self.__dict__.pop("_hidden", None)
        self._is_deformed, self._seen = mesh.is_deformed(), None

    def normal(self, vertex, shape):
        """Unit normal at a vertex of the mesh with the positions `shape` (n, 3); zero for a vertex without faces."""
        return arrays.vertex_normal(self._mesh.mesh, self._corners, shape, welding.leaders_of(self._welded, vertex))

    def pick(self, origin, direction, metric, start, current):
        """Intersect a ray with the visible shape: (triangle, point, normal, vertex to be pulled); None if the ray hits nothing.

        origin, direction: in the object's space. metric: 3x3 matrix that measures lengths. start: start shape. current: present shape; None
        if it equals the start shape. dab.Hit explains the vertex.
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
        """Position in the object's space at which the user sees a vertex.

        start: start shape. current: present shape; None if it equals the start shape.
        """
        return self._seen_shape(start if current is None else current)[vertex]

    def picker(self, start):
        """Native Picker (search tree) over the start shape, brought up to date."""
        return self._start_tree.picker(start, self.triangles, self.edges)

    @property
    def has_picker(self):
        """Whether picker() can answer without building a new search tree."""
        return self._start_tree.is_built

    def moved(self, indices, at_most=math.inf):
        """Note that vertices of the present shape have moved. indices: of the vertices; None for any vertices.

        at_most: largest distance that a vertex has moved.
        """
        self._seen_tree.moved(indices, math.inf if self._is_deformed else at_most)
        if indices is None or len(self._moved_since_start) > MOST_PARTS:
            self._moved_since_start = [None]
        else:
            self._moved_since_start.append(indices)
        self._seen = None

    def start_moved(self, indices):
        """Note that vertices of the start shape have moved. indices: of the vertices; None for any vertices."""
        self._start_tree.moved(indices)

    def start_is_current(self):
        """Note that the present shape has become the start shape."""
        for indices in self._moved_since_start:
            self._start_tree.moved(indices)
        self._moved_since_start = []

    def _seen_shape(self, shape):
        if not self._is_deformed:
            return shape
        if self._seen is None:
            # Use the depsgraph of the present view layer: the view layer in which the mesh was read may have been removed.
            found = self._mesh.evaluated_positions(bpy.context.evaluated_depsgraph_get())
            if found is None:
                self._is_deformed = False
                return shape
            self._seen = found
            self._seen_tree.moved(None)
        return self._seen
