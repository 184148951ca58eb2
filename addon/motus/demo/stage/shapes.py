"""Building blocks of the demo's meshes. A part is (vertices, faces); MeshBuilder joins parts into one mesh."""

import bpy
import numpy as np


def smooth_profile(stations, count):
    """Resample rows of (position, value, ...) to `count` rows by cubic Hermite interpolation (Catmull-Rom slopes)."""
    stations = np.asarray(stations, dtype=float)
    x, y = stations[:, 0], stations[:, 1:]
    slopes = np.gradient(y, x, axis=0)
    # Profiles are strongly curved at their ends (noses, tips), so cosine spacing puts more rows there.
    sample = x[0] + (x[-1] - x[0]) * 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, count)))
    index = np.clip(_interval(x, sample), 0, len(x) - 2)
    width = (x[index + 1] - x[index])[:, None]
    t = ((sample - x[index])[:, None]) / width
    h00, h10 = (1 + 2 * t) * (1 - t) ** 2, t * (1 - t) ** 2
    h01, h11 = t * t * (3 - 2 * t), t * t * (t - 1)
    values = h00 * y[index] + h10 * width * slopes[index] + h01 * y[index + 1] + h11 * width * slopes[index + 1]
    return np.column_stack((sample, values))


def smooth_profile_points(points, count):
    """Resample a polyline of (radius, y) points to `count` points of a smooth curve through them."""
    points = np.asarray(points, dtype=float)
    steps = np.hypot(*np.diff(points, axis=0).T)
    position = np.concatenate(([0.0], np.cumsum(steps)))
    return smooth_profile(np.column_stack((position, points)), count)[:, 1:]


def _interval(x, sample):
    ascending = x if x[0] < x[-1] else -x
    return np.searchsorted(ascending, sample if x[0] < x[-1] else -sample, side="right") - 1


def ring(count):
    """Return the angles of `count` points around a circle, starting at +X, in radians."""
    return np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)


def loft(sections, closed=True):
    """Return (vertices, quads) of a surface through sections, (rows, points, 3). closed: whether the ends of each row are joined."""
    sections = np.asarray(sections, dtype=float)
    rows, points = sections.shape[:2]
    spans = points if closed else points - 1
    row, point = np.meshgrid(np.arange(rows - 1), np.arange(spans), indexing="ij")
    following = (point + 1) % points
    here, beyond = row * points, (row + 1) * points
    corners = np.stack((here + point, here + following, beyond + following, beyond + point), axis=-1)
    return sections.reshape(-1, 3), corners.reshape(-1, 4)


def lathe(profile, segments=32):
    """Turn a profile of (radius, y) rows about the Y axis. Normals point outwards if y decreases along the profile."""
    profile = np.asarray(profile, dtype=float)
    angle = ring(segments)
    radius, y = profile[:, :1], profile[:, 1:2]
    sections = np.stack((radius * np.cos(angle), np.broadcast_to(y, (len(profile), segments)), radius * np.sin(angle)), axis=-1)
    return loft(sections)


def upright(part, place=(0.0, 0.0, 0.0), depth=1.0):
    """Turn a part from lathe() so that its axis is Z instead of Y, scale it along Y by `depth`, and move it to a place."""
    vertices, faces = part
    return vertices[:, (0, 2, 1)] * (1.0, -depth, 1.0) + np.asarray(place), faces


def sphere(radius, centre=(0.0, 0.0, 0.0), scale=(1.0, 1.0, 1.0), segments=20, rings=12):
    """Return (vertices, faces) of an ellipsoid around `centre`. scale: factors of the radius along X, Y and Z."""
    polar = np.linspace(1e-3, np.pi - 1e-3, rings)
    vertices, faces = lathe(np.column_stack((np.sin(polar), np.cos(polar))), segments)
    return vertices * radius * np.asarray(scale) + np.asarray(centre), faces


def box(size, centre=(0.0, 0.0, 0.0)):
    """Return (vertices, faces) of a box along the axes."""
    corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    faces = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    return corners * np.asarray(size) + np.asarray(centre), faces


def beam(size, centre, bevel):
    """Return (vertices, faces) of a beam whose edges along its longest side are chamfered."""
    size = np.asarray(size, dtype=float)
    along = int(np.argmax(size))
    first, second = ((1, 2), (2, 0), (0, 1))[along]
    a, b = size[first] / 2.0, size[second] / 2.0
    outline = np.array(
        (
            (a, b - bevel),
            (a - bevel, b),
            (bevel - a, b),
            (-a, b - bevel),
            (-a, bevel - b),
            (bevel - a, -b),
            (a - bevel, -b),
            (a, bevel - b),
        )
    )
    half = size[along] / 2.0
    sections = np.zeros((4, 8, 3))
    for row, (place, inset) in enumerate(((half, bevel), (half - bevel, 0.0), (bevel - half, 0.0), (-half, bevel))):
        sections[row][:, (first, second)] = outline * (1.0 - inset / a, 1.0 - inset / b)
        sections[row][:, along] = place
    vertices, sides = loft(sections)
    octagon = np.array(((0, 1, 2, 3), (0, 3, 4, 7), (4, 5, 6, 7)))
    ends = np.concatenate((octagon, octagon[:, ::-1] + len(vertices) - 8))
    return vertices + np.asarray(centre), np.concatenate((sides[:, ::-1], ends))


def torus(radius, thickness, segments=64, sides=10):
    """Return (vertices, faces) of a torus around the Y axis. thickness: radius of its cross-section."""
    angle = np.linspace(0.0, 2.0 * np.pi, sides + 1)
    return lathe(np.column_stack((radius + thickness * np.cos(angle), -thickness * np.sin(angle))), segments)


class MeshBuilder:
    """Collects parts, each with a material slot, and joins them into one mesh."""

    def __init__(self):
        self._vertices, self._faces, self._slots, self._smooth = [], [], [], []
        self._count = 0

    def add(self, part, slot=0, smooth=True):
        """Add a part, (vertices, faces). slot: one material index, or one for each face. smooth: whether the faces are shaded smooth."""
        vertices, faces = part
        self._vertices.append(np.asarray(vertices, dtype=float))
        self._faces.append(np.asarray(faces) + self._count)
        self._slots.append(np.broadcast_to(np.asarray(slot, dtype=np.int32), (len(faces),)))
        self._smooth.append(np.full(len(faces), smooth))
        self._count += len(vertices)

    def build(self, name, materials):
        """Make the joined mesh with its materials. Returns the mesh."""
        mesh = bpy.data.meshes.new(name)
        # Mesh.from_pydata() makes the same mesh of lists, which takes three times as long.
        mesh.vertices.add(self._count)
        mesh.vertices.foreach_set("co", np.concatenate(self._vertices).astype(np.float32).ravel())
        corners = np.concatenate([faces.ravel() for faces in self._faces]).astype(np.int32)
        sizes = np.concatenate([np.full(len(faces), faces.shape[1], np.int32) for faces in self._faces])
        mesh.loops.add(len(corners))
        mesh.loops.foreach_set("vertex_index", corners)
        mesh.polygons.add(len(sizes))
        mesh.polygons.foreach_set("loop_start", np.cumsum(sizes, dtype=np.int32) - sizes)
        mesh.polygons.foreach_set("loop_total", sizes)
        mesh.update(calc_edges=True)
        mesh.polygons.foreach_set("material_index", np.concatenate(self._slots))
        mesh.polygons.foreach_set("use_smooth", np.concatenate(self._smooth))
        for material in materials:
            mesh.materials.append(material)
        mesh.update()
        return mesh


def link_object(collection, name, data, parent=None):
    """Make an object with the data, which may be None for an empty, in a collection. Returns the object."""
    thing = bpy.data.objects.new(name, data)
    collection.objects.link(thing)
    thing.parent = parent
    return thing
