"""World matrices of several evaluated objects as one array."""

from .. import keeping
from ..evaluated import copies
from ..file import deleted
from ..lazy import numpy as np
from .arrays import LENDS_MEMORY, columns

LARGE_SCENE = 4  # objects in the view layer for each object that is read

_layer_sizes = keeping.OfFile(
    "numbers of objects in view layers, for choosing the faster of two algorithms with equal results",
    "names of the scene and the view layer",
    most=256,
)


def world_matrices(objects):
    """World matrices of evaluated objects, (n, 16), column by column."""
    if LENDS_MEMORY:
        matrices = (memoryview(one.matrix_world).tobytes('A') for one in objects)
        return np.frombuffer(b"".join(matrices), np.float32).reshape(-1, 16)
    return np.array([columns(one.matrix_world) for one in objects])


class WorldMatrixReader:
    """Reads the world matrices of several evaluated objects, by one foreach_get over the view layer if that is faster.

    found: (n, 16) float32, column by column, the matrices that read() has read last.
    """

    def __init__(self, objects):
        self._objects = objects
        self._every = self._rows = self._room = self._table = self._scene = None
        self.found = np.empty((len(objects), 16), np.float32)

    def read(self, depsgraph):
        """Read the world matrices of the objects into `found`. Returns the indices of those that were deleted.

        They are read one by one if one of them is not in the evaluated view layer, or if the view layer has more than LARGE_SCENE
        objects for each object that is read.
        """
        if not self._objects:
            return ()
        # If the view layer gets or loses objects, Blender makes a new evaluated copy of the scene.
        scene, view_layer = copies.of(depsgraph.scene_eval), depsgraph.view_layer_eval
        if scene is None or scene is not self._scene:
            self._look(view_layer)
            self._scene = scene
        if self._rows is None:
            self.found[:] = world_matrices(self._objects)
            return deleted.which(self._objects)
        view_layer.objects.foreach_get("matrix_world", self._room)
        self._table.take(self._rows, axis=0, out=self.found, mode='clip')  # mode 'raise' would copy the array first
        return ()

    def _look(self, view_layer):
        layer = view_layer.id_data.name, view_layer.name
        deleted.which(self._objects)  # registers the objects: a handler then notices if one of them is deleted
        most = LARGE_SCENE * len(self._objects)
        if _layer_sizes.get(layer, 0) <= most:
            # Hashes of evaluated objects stand for their addresses in memory.
            every = list(map(hash, view_layer.objects.values()))
            _layer_sizes.add(layer, len(every))
            if len(every) <= most:
                if every != self._every:
                    self._find(every)
                return
        self._every = self._rows = None

    def _find(self, every):
        rows, wanted = {mark: row for row, mark in enumerate(every)}, list(map(hash, self._objects))
        is_there = all(mark in rows for mark in wanted)
        self._rows = np.array([rows[mark] for mark in wanted]) if is_there else None
        self._room = np.empty(16 * len(every), np.float32)
        self._table = self._room.reshape(-1, 16)
        self._every = every
