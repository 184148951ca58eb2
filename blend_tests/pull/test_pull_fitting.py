"""The brush that the mouse begins with suits the object's size."""

import bpy

import support


class Fitting(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.fit = support.addon("pull.fitting").fit
        self.brush = bpy.context.scene.motus.pull

    def cube(self, size, scale=1.0):
        bpy.ops.mesh.primitive_cube_add(size=size)
        bpy.context.object.scale = scale, scale, scale
        bpy.context.view_layer.update()
        return bpy.context.object

    def assertBrush(self, radius, strength):
        self.assertAlmostEqual(self.brush.radius, radius, places=6)
        self.assertAlmostEqual(self.brush.strength, strength, places=7)

    def test_brush_is_fitted_to_the_objects_size(self):
        self.fit(self.brush, self.cube(2.0))
        self.assertBrush(0.25, 0.0075)

    def test_brush_fits_each_object_until_the_user_changes_it(self):
        head, hill = self.cube(2.0), self.cube(200.0)
        self.fit(self.brush, head)
        self.fit(self.brush, hill)
        self.assertBrush(25.0, 0.75)
        self.brush.radius = 3.0
        self.fit(self.brush, head)
        self.assertBrush(3.0, 0.09)
        self.brush.strength = -0.5
        self.fit(self.brush, hill)
        self.assertBrush(3.0, -0.5)

    def test_brush_values_of_the_user_stay(self):
        self.brush.radius = 1.0
        self.brush.strength = 0.1
        self.fit(self.brush, self.cube(2.0))
        self.assertBrush(1.0, 0.1)

    def test_units(self):
        scaled = self.cube(2.0, 10.0)
        self.fit(self.brush, scaled)
        self.assertBrush(2.5, 0.075)
        self.brush.unit = 'LOCAL'
        self.fit(self.brush, scaled)
        self.assertBrush(0.25, 0.0075)
        self.brush.distance = 'EDGES'
        self.fit(self.brush, self.cube(4.0))
        self.assertBrush(0.25, 0.0075)

    def test_an_object_without_size(self):
        mesh = bpy.data.meshes.new("Nothing")
        nothing = bpy.data.objects.new("Nothing", mesh)
        self.fit(self.brush, nothing)
        self.assertGreater(self.brush.radius, 0.1)
        self.assertGreater(self.brush.strength, 0.001)
