"""The library's deform() is what Blender's Lattice modifier does, to 1e-5, whatever the settings."""

import itertools

import bpy
import numpy as np

import support
from lattice import lattice_cases as cases

TOLERANCE = 1e-5
BASES = ('LINEAR', 'CARDINAL', 'CATMULL_ROM', 'BSPLINE')


class DeformTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.mesh = cases.ball(size=0.8)
        self.lattice = cases.lattice(resolution=(3, 4, 2))
        self.modifier = self.mesh.modifiers.new("Lattice", 'LATTICE')
        self.modifier.object = self.lattice

    def deformed(self):
        """World positions by the library, from the mesh as modelled."""
        pulling, shapes = support.addon("lattice.pulling"), cases.shapes()
        matrix = np.array(self.lattice.matrix_world, np.float64)
        native, _ = pulling.native_lattice(self.lattice.data, matrix)
        rest, now = (shapes.lattice_points(self.lattice.data, name).astype(np.float64) for name in ("co", "co_deform"))
        np.testing.assert_allclose(native.rest_points(), shapes.in_world(rest, matrix), atol=1e-5)
        positions = shapes.in_world(shapes.positions(self.mesh.data), self.mesh.matrix_world)
        influence = np.full(len(positions), self.modifier.strength)
        group = self.mesh.vertex_groups.get(self.modifier.vertex_group)
        if group:
            weights = np.array([pulling.weight(vertex, group.index) for vertex in self.mesh.data.vertices])
            influence *= 1.0 - weights if self.modifier.invert_vertex_group else weights
        return native.deform(positions, (now - rest) @ matrix[:3, :3].T, influence, pulling.point_weights(self.lattice))

    def assert_same(self):
        bpy.context.view_layer.update()
        np.testing.assert_allclose(self.deformed(), cases.evaluated(self.mesh), atol=TOLERANCE)

    def set_basis(self, names):
        for axis, name in zip("uvw", names):
            setattr(self.lattice.data, f"interpolation_type_{axis}", f"KEY_{name}")

    def test_every_interpolation_along_every_axis(self):
        self.lattice.scale = (1.8, 2.2, 1.5)
        cases.displace(self.lattice)
        for names in itertools.product(BASES, repeat=3):
            with self.subTest(names=names):
                self.set_basis(names)
                self.assert_same()
        self.assertGreater(np.abs(cases.evaluated(self.mesh) - cases.shapes().positions(self.mesh.data)).max(), 0.1)

    def test_resolutions(self):
        for resolution in ((1, 1, 1), (1, 2, 3), (2, 2, 2), (5, 1, 4), (3, 7, 5), (9, 2, 6)):
            for basis in BASES:
                with self.subTest(resolution=resolution, basis=basis):
                    for axis, points in zip("uvw", resolution):
                        setattr(self.lattice.data, f"points_{axis}", points)
                    self.set_basis((basis,) * 3)
                    cases.displace(self.lattice, seed=resolution[0])
                    self.assert_same()

    def test_moved_turned_and_scaled(self):
        cases.displace(self.lattice)
        self.lattice.matrix_world = ((1.5, 0.3, -0.2, 0.4), (0.1, 2.0, 0.5, -0.3), (-0.4, 0.2, 1.1, 0.2), (0, 0, 0, 1))
        self.mesh.rotation_euler, self.mesh.scale = (0.3, -0.8, 1.2), (0.7, 1.6, -1.1)
        self.assert_same()

    def test_far_outside(self):
        cases.displace(self.lattice)
        self.lattice.scale = (0.2, 0.3, 0.1)
        self.lattice.location = (0.5, 0.1, 0.9)
        for basis in BASES:
            self.set_basis((basis,) * 3)
            self.assert_same()

    def test_outside_only(self):
        for axis in "uvw":
            setattr(self.lattice.data, f"points_{axis}", 4)
        cases.displace(self.lattice)
        self.lattice.data.use_outside = True
        self.assert_same()

    def test_strength_and_vertex_groups(self):
        cases.displace(self.lattice)
        group = self.mesh.vertex_groups.new(name="Part")
        for index in range(0, len(self.mesh.data.vertices), 2):
            group.add([index], (index % 7) / 6.0, 'REPLACE')
        inner = self.lattice.vertex_groups.new(name="Inner")
        for index in range(0, len(self.lattice.data.points), 3):
            inner.add([index], (index % 4) / 3.0, 'REPLACE')
        for strength in (1.0, 0.35, 0.0, -0.5):
            self.modifier.strength = strength
            for name, inverted, points in itertools.product(("", "Part"), (False, True), ("", "Inner")):
                with self.subTest(strength=strength, name=name, inverted=inverted, points=points):
                    self.modifier.vertex_group, self.modifier.invert_vertex_group = name, inverted
                    self.lattice.data.vertex_group = points
                    self.assert_same()
