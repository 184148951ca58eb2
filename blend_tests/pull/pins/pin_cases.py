"""What the tests of pins share: meshes, pins by the operator, and a plain reference of what pins do."""

import bpy
import numpy as np

import support

RADIUS = 0.8


class PinsTestCase(support.SceneTestCase):
    """Tests with small helpers that compare shapes."""

    def assert_shape(self, obj, wanted, tolerance=2e-6):
        actual = evaluated(obj)
        self.assertEqual(actual.shape, wanted.shape)
        self.assertLessEqual(float(np.abs(actual - wanted).max()), tolerance)

    def assert_bits(self, actual, wanted):
        self.assertEqual(actual.shape, wanted.shape)
        self.assertTrue((actual.view(np.uint32) == wanted.view(np.uint32)).all())

    def assert_refused(self, words, operator, **keywords):
        """The operator reports an error that contains the words, and changes nothing."""
        before = bpy.context.object and evaluated(bpy.context.object)
        with self.assertRaisesRegex(RuntimeError, words):
            operator(**keywords)
        if before is not None:
            self.assert_bits(evaluated(bpy.context.object), before)


def new_grid(side=21, size=2.0, name="Grid"):
    """A flat grid of side x side vertices, the active object."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=side - 1, y_subdivisions=side - 1, size=size)
    obj = bpy.context.object
    obj.name = obj.data.name = name
    return obj


def new_monkey(levels=1):
    """Suzanne, subdivided, the active object."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    modifier = obj.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels = levels
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    return obj


def add(obj, vertex, way=(0.0, 0.0, 1.0), radius=RADIUS, **keywords):
    """A pin by the operator; returns it."""
    if isinstance(vertex, int):
        keywords["vertex"] = vertex
    else:
        keywords["location"] = vertex
    bpy.ops.motus.pin_add(object=obj.name, displacement=way, radius=radius, **keywords)
    return obj.motus.pull.pins[obj.motus.pull.active_pin]


def centre(obj):
    """Index of the vertex nearest to the object's origin."""
    return int((basis(obj) ** 2).sum(axis=1).argmin())


def vertex_at(obj, x, y):
    """Index of the vertex nearest to x, y."""
    return int(((basis(obj)[:, :2] - (x, y)) ** 2).sum(axis=1).argmin())


def basis(obj):
    """The mesh's own positions, float32 (n, 3)."""
    return _positions(obj.data)


def evaluated(obj):
    """The positions after modifiers, float32 (n, 3)."""
    return _positions(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)


def _positions(mesh):
    found = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", found)
    return found.reshape(-1, 3)


def key_strength(pin, keys):
    """Key the strength: {frame: value}, linear in between."""
    for frame, value in keys.items():
        pin.strength = value
        pin.keyframe_insert("strength", frame=frame)
    for curve in support.addon("core.blender.actions").fcurves(pin.id_data):
        for point in curve.keyframe_points:
            point.interpolation = 'LINEAR'


def force(distance, radius=RADIUS, falloff="smooth", factor=0.0):
    """The forces of mission and manual, in double precision."""
    d = np.asarray(distance, float)
    t = np.clip(1.0 - d / radius, 0.0, 1.0)
    if falloff == "classic":
        return np.where(d * d < radius, np.maximum(1.0 - d * d / (radius + 1.0), 0.0) ** (1.0 + abs(factor)), 0.0)
    curves = {
        "smooth": 3.0 * t**2 - 2.0 * t**3,
        "sphere": np.sqrt(2.0 * t - t**2),
        "root": np.sqrt(t),
        "linear": t,
        "sharp": t**2,
        "constant": np.ones_like(t),
        "gaussian": (np.exp(-4.5 * d * d / radius**2) - np.exp(-4.5)) / (1.0 - np.exp(-4.5)),
    }
    return np.where(d < radius, curves[falloff], 0.0)


def pulled(positions, root, way, radius=RADIUS, falloff="smooth", metric=None, source=None):
    """Positions with one straight pull; distances are those of `source`, else of the positions themselves."""
    source = positions if source is None else source
    away = source.astype(float) - source[root]
    if metric is not None:
        away = away @ np.asarray(metric, float).T
    forces = force(np.linalg.norm(away, axis=1), radius, falloff)
    return (positions + np.outer(forces, way)).astype(np.float32)
