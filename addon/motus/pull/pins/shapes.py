"""Cache of the vertices that the pins of a mesh reach, since finding them takes long.

An entry is keyed by the name of the mesh, and valid for its content, which is compared on every evaluation: positions, the numbers of
pulled vertices, and the topology if distances are measured along the mesh. The solver's results do not depend on the cache.
"""

from ...core import keeping, native
from ...core.lazy import numpy as np
from ..mesh import arrays, welding
from . import binding

LARGEST = 32
"""Largest number of entries (Shape) in the cache."""
MOST_VERTICES = 8_000_000
"""Largest total number of vertices of all entries in the cache."""
SPARE_REACHES = 64
"""Number of reaches that no present pin uses and that an entry keeps nevertheless, for pins that are being edited."""
MOST_PICKERS = 4
"""Largest number of search trees of an entry; there is one for each weld distance and measure of lengths."""

_shapes = keeping.OfFile(
    "vertices that pins reach, with the mesh for which they were found (Shape)",
    "name of the mesh, and whether distances follow its topology; recomputed if the content of the mesh differs",
    LARGEST,
    MOST_VERTICES,
    lambda _, shape: len(shape.positions),
    "vertices",
)
_BUFFERS = keeping.OfThread(
    "arrays for reading a mesh that is compared with a Shape", "name of the array; an array of a different size replaces it", most=8
)


class Reached:
    """Vertices that a pin reaches.

    reaches: (indices, distances) for the pull and each mirror image, as the native pull() takes them.
    """

    def __init__(self, reaches, welded=None):
        """Keep what was found. welded: Welding of the mesh's vertices, or None."""
        self.reaches, self._welded = reaches, welded
        self._compact = None

    @property
    def compact(self):
        """Reaches with consecutive numbering: (rising indices of all reached vertices, reaches).

        The reaches contain positions in the first array instead of vertex indices.
        """
        if self._compact is None:
            rows = np.unique(np.concatenate([indices for indices, _ in self.reaches]))
            self._compact = rows, [(np.searchsorted(rows, indices), distances) for indices, distances in self.reaches]
        return self._compact

    def together(self, weights):
        """Weights (m,) of the reached vertices with which welded ones stay together."""
        return weights if self._welded is None else self._welded.least(weights, self.compact[0])


class Shape:
    """Cache entry for one shape of a mesh: its content, and the vertices that each of its pins reaches."""

    def __init__(self, mesh, positions, numbers, topology):
        self.positions = positions
        self.is_finite = bool(np.isfinite(positions).all())
        self._numbers = numbers
        self._topology = topology
        self._anchors = binding.by_number(numbers)
        self._size = binding.diagonal(positions)
        self._triangles = None if topology is None else arrays.triangles(mesh)
        self._edges = None if topology is None else arrays.edges(mesh)
        self._pickers = keeping.Latest(MOST_PICKERS)
        self._found = keeping.Latest()

    def is_of(self, positions, numbers, topology):
        """Whether the entry was made for these positions, vertex numbers and topology of a mesh."""
        pairs = [(positions, self.positions), (numbers, self._numbers)]
        pairs += zip(topology or (), self._topology or ())
        return (topology is None) == (self._topology is None) and all(map(_same, *zip(*pairs)))

    def find(self, row):
        """Find the vertex that a pin pulls and the vertices that it reaches: (vertex or None, status, Reached or None).

        status: OK, or why the vertex cannot be found.
        """
        return self._found.made(row.where, lambda: self._find(row))

    def _find(self, row):
        root, status = binding.root(row, self.positions, self._anchors, self._size)
        return root, status, None if root is None else self._reached(row, root)

    def forget_but(self, count):
        """Delete the least recently used sets of reached vertices, until at most `count` plus SPARE_REACHES are left."""
        self._found.trim(count + SPARE_REACHES)

    def _reached(self, row, root):
        metric = np.reshape(np.array(row.metric), (3, 3))
        picker, welded = self._picker(row, metric)
        if welded is None:
            return Reached(picker.reaches(root, row.reach, row.distance, metric, row.mirror))
        args = row.reach, row.distance, metric
        return Reached([welding.reach(picker, self.positions, welded, root, bits, *args) for bits in row.mirror_bits], welded)

    def _picker(self, row, metric):
        """Return (native Picker, Welding or None) of the mesh as a pin welds it."""

        def make():
            welded = welding.weld(self.positions, row.weld, metric)
            ends = [None if ends is None else welding.leaders_of(welded, ends) for ends in (self._triangles, self._edges)]
            return native.module.Picker(self.positions, *ends), welded

        return self._pickers.made((row.weld, row.metric) if row.weld > 0.0 else None, make)


def shape_of(mesh, rows):
    """Return the cache entry for an evaluated mesh and its pins; create a new one if the mesh has changed.

    rows: table.Row of each pin.
    """
    positions, numbers = _positions(mesh), binding.anchors(mesh)
    topology = None
    if any(row.distance != "straight" for row in rows):
        topology = _topology(mesh)
    place = mesh.name_full, topology is None
    shape = _shapes.find(place)
    if shape is not None and shape.is_of(positions, numbers, topology):
        return shape
    return _shapes.add(place, Shape(mesh, positions.copy(), numbers, topology and tuple(array.copy() for array in topology)))


def _positions(mesh):
    """Positions of a mesh's vertices, float32 (n, 3), in an array that the next call in the thread overwrites."""
    return arrays.positions(mesh, _buffer("positions", 3 * len(mesh.vertices), np.float32))


def _topology(mesh):
    """Arrays that describe the faces and edges of a mesh for comparison, valid until the thread's next call."""
    if ".corner_vert" in mesh.attributes:
        corners = _buffer("corners", len(mesh.loops), np.int32)
        mesh.attributes[".corner_vert"].data.foreach_get("value", corners)
        edges = _buffer("edges", 2 * len(mesh.edges), np.int32)
        mesh.attributes[".edge_verts"].data.foreach_get("value", edges)
        return corners, edges
    # Before 4.0 these attributes do not exist, and RNA reads loops and edges one by one, 0.5 s for a million. Blender keeps each
    # collection in one block of memory, which is compared instead.
    return _memory(mesh.loops), _memory(mesh.edges)


def _buffer(name, size, dtype):
    # Reused memory: fresh memory would have to be mapped by the system on every frame, which takes longer than filling it.
    buffers = _BUFFERS.here()
    found = buffers.get(name)
    return buffers.add(name, np.empty(size, dtype)) if found is None or len(found) != size else found


def _memory(items):
    """Memory of a Blender collection as int32 words, whatever its items contain.

    The array is only for reading, and only valid until Blender changes the collection.
    """
    import ctypes

    if len(items) < 2:
        return np.zeros(len(items), np.int32)
    start = items[0].as_pointer()
    words = (items[1].as_pointer() - start) // 4 * len(items)
    return np.ctypeslib.as_array((ctypes.c_int32 * words).from_address(start))


def _same(one, other):
    if one is None or other is None:
        return one is other
    # Compared as bits, so that NaN equals NaN, and as 64-bit words, which takes half the time.
    if one.shape != other.shape:
        return False
    words = one.size // 2
    one, other = one.reshape(-1), other.reshape(-1)
    return np.array_equal(one[: 2 * words].view(np.int64), other[: 2 * words].view(np.int64)) and np.array_equal(
        one[2 * words :].view(np.int32), other[2 * words :].view(np.int32)
    )
