"""What the tests of Pick & Pull share: meshes, where their vertices are, and what a pull does by its definition."""

import bmesh
import bpy
import numpy as np

import support

FORMULAS = {
    'SMOOTH': lambda d, radius: np.polyval((-2, 3, 0, 0), 1 - d / radius),
    'SPHERE': lambda d, radius: np.sqrt(np.polyval((-1, 2, 0), 1 - d / radius)),
    'ROOT': lambda d, radius: np.sqrt(1 - d / radius),
    'LINEAR': lambda d, radius: 1 - d / radius,
    'SHARP': lambda d, radius: (1 - d / radius) ** 2,
    'CONSTANT': lambda d, radius: np.ones_like(d),
    'GAUSSIAN': lambda d, radius: (np.exp(-4.5 * d**2 / radius**2) - np.exp(-4.5)) / (1 - np.exp(-4.5)),
}
"""Forces within the radius, by the definitions."""


def forces(falloff, d, radius):
    """Forces at distances: 0 at the radius and beyond."""
    inside = d < radius
    return np.where(inside, FORMULAS[falloff](np.where(inside, d, 0.0), radius), 0.0)


class PullTestCase(support.SceneTestCase):
    """An empty scene; self.brush are the scene's settings of the brush."""

    def setUp(self):
        super().setUp()
        self.scene = bpy.context.scene
        self.brush = self.scene.motus.pull

    def link(self, mesh, name="Mesh"):
        """An object with the mesh, active and selected."""
        obj = bpy.data.objects.new(name, mesh)
        self.scene.collection.objects.link(obj)
        for other in self.scene.objects:
            other.select_set(other == obj)
        bpy.context.view_layer.objects.active = obj
        return obj

    def mesh(self, places, faces=(), edges=(), name="Mesh"):
        data = bpy.data.meshes.new(name)
        data.from_pydata([tuple(place) for place in places], list(edges), list(faces))
        data.update()
        return self.link(data, name)

    def plane(self, count=21, spacing=0.1, name="Mesh"):
        """count x count vertices about the origin, in rows along X, of quads that face up."""
        line = (np.arange(count) - (count - 1) / 2) * spacing
        places = [(x, y, 0.0) for y in line for x in line]
        corners = [row * count + column for row in range(count - 1) for column in range(count - 1)]
        faces = [(corner, corner + 1, corner + count + 1, corner + count) for corner in corners]
        return self.mesh(places, faces, name=name)

    def ball(self, subdivisions=4, radius=1.0, name="Mesh"):
        data = bpy.data.meshes.new(name)
        edit = bmesh.new()
        bmesh.ops.create_icosphere(edit, subdivisions=subdivisions, radius=radius)
        edit.to_mesh(data)
        edit.free()
        return self.link(data, name)

    def middle(self, obj):
        """The vertex nearest to the object's origin."""
        return int(np.linalg.norm(self.places(obj), axis=1).argmin())

    def places(self, obj):
        """(n, 3) float64 of the mesh's own vertices."""
        if obj.mode == 'EDIT':
            return np.array([vertex.co[:] for vertex in bmesh.from_edit_mesh(obj.data).verts])
        return np.array([vertex.co[:] for vertex in obj.data.vertices]).reshape(-1, 3)

    def seen(self, obj):
        """(n, 3) of what is evaluated, in the object's space."""
        evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        return np.array([vertex.co[:] for vertex in evaluated.data.vertices])

    def in_world(self, obj, places):
        bpy.context.view_layer.update()
        matrix = np.array(obj.matrix_world)
        return places @ matrix[:3, :3].T + matrix[:3, 3]

    def pull(self, **keywords):
        self.assertEqual(bpy.ops.motus.pick_pull(**keywords), {'FINISHED'})

    def moved_by(self, obj, **keywords):
        """(n, 3): how far each vertex goes by a pull."""
        before = self.places(obj)
        self.pull(**keywords)
        return self.places(obj) - before

    def assertRefused(self, part, **keywords):
        """The pull refuses with a sentence that has `part` in it, and the active mesh stays as it is."""
        obj = bpy.context.object
        before = self.places(obj) if obj is not None and obj.type == 'MESH' else None
        with self.assertRaisesRegex(RuntimeError, part):
            bpy.ops.motus.pick_pull(**keywords)
        if before is not None:
            self.assertTrue(np.array_equal(self.places(obj), before, equal_nan=True))

    def assertNear(self, found, wanted, tolerance=2e-6):
        found, wanted = np.asarray(found, float), np.asarray(wanted, float)
        self.assertEqual(found.shape, wanted.shape)
        self.assertLessEqual(np.abs(found - wanted).max(initial=0.0), tolerance)
