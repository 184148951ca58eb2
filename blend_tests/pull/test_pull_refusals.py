"""What cannot be pulled is refused with a sentence, and changes nothing."""

import math

import bpy

from pull.pull_cases import PullTestCase


class Refusals(PullTestCase):
    def test_pulling_without_an_object_is_refused(self):
        self.assertRefused("Select a mesh", vertex=0)
        self.assertRefused("no object Nobody", object="Nobody", vertex=0)

    def test_pulling_an_object_without_a_mesh_is_refused(self):
        curve = bpy.data.objects.new("Curve", bpy.data.curves.new("Curve", 'CURVE'))
        self.scene.collection.objects.link(curve)
        self.assertRefused("Curve is not a mesh", object="Curve", vertex=0)

    def test_pulling_a_mesh_without_vertices_is_refused(self):
        self.mesh([])
        self.assertRefused("has no vertices", vertex=0)
        bpy.ops.object.mode_set(mode='EDIT')
        self.assertRefused("has no vertices", vertex=0)

    def test_a_missing_place_is_refused(self):
        self.plane()
        self.assertRefused("a location or a vertex", radius=0.5)
        self.assertRefused("no vertex 441: it has 441", vertex=441)
        self.assertRefused("No vertex lies within the radius", location=(0.0, 0.0, 3.0), radius=0.5)

    def test_invalid_numbers_are_refused(self):
        self.plane()
        for name in ("radius", "strength", "scale_factor", "minimum", "maximum"):
            for value in (math.nan, math.inf):
                self.assertRefused(f"{name} is not a finite number", vertex=220, **{name: value})
        self.assertRefused("location is not a finite", location=(math.nan, 0.0, 0.0))
        self.assertRefused("displacement is not a finite", vertex=220, displacement=(math.inf, 0.0, 0.0))
        self.assertRefused("minimum is above", vertex=220, use_minimum=True, use_maximum=True, minimum=1.0, maximum=0.0)

    def test_numbers_that_are_too_large_together(self):
        obj = self.plane()
        dab = {"name": "", "kind": 'PULL', "vertex": 220, "is_first": True, "strength": 0.0, "radius": 1.0, "displacement": (0.0, 0.0, 1.0)}
        for mirror in (set(), {'X'}, {'X', 'Y'}):
            self.assertRefused("too large", dabs=[dab | {"displacement": (0.0, 0.0, 1e30)}], strength=9e17, mirror=mirror)
            self.assertRefused("too large", dabs=[dab | {"radius": 1e30}], radius=9e17, mirror=mirror)
        obj.scale = (1e-12,) * 3
        bpy.context.view_layer.update()
        for mirror in (set(), {'X'}):
            self.assertRefused("too large", vertex=220, displacement=(0.0, 0.0, 9e17), radius=1e-12, mirror=mirror)
            self.assertRefused("too large", vertex=220, direction='Z', strength=9e17, radius=1e-12, mirror=mirror)

    def test_hidden_root(self):
        obj = self.plane()
        obj.data.vertices[220].hide = True
        self.assertRefused("Vertex 220 is hidden", vertex=220)

    def test_no_such_group(self):
        self.plane()
        self.assertRefused("no vertex group Nothing", vertex=220, vertex_group="Nothing")

    def test_pulling_fully_masked_vertices_is_refused(self):
        obj = self.plane()
        obj.vertex_groups.new(name="Empty")
        self.assertRefused("Nothing moved", vertex=220, vertex_group="Empty")

    def test_mirror_images_that_cancel_each_other_out(self):
        """At a root on the mirror plane, or one whose mirror image along the surface is itself; nowhere else."""
        obj = self.plane()
        pushed = {"vertex": 220, "displacement": (0.3, 0.0, 0.0), "radius": 0.5}
        for distance in ('STRAIGHT', 'SURFACE', 'EDGES'):
            for accumulate in (True, False):
                self.assertRefused("mirror image cancel", **pushed, mirror={'X', 'Y'}, distance=distance, accumulate=accumulate)
        obj.data.vertices[220].co.x = 0.01
        self.assertRefused("mirror image cancel", **pushed, mirror={'X'}, distance='EDGES')
        self.pull(**pushed, mirror={'Y'})
        self.pull(**{**pushed, "displacement": (0.3, 0.0, 0.1)}, mirror={'X'})
        obj.vertex_groups.new(name="Empty")
        self.assertRefused("hidden, masked or held", **pushed, mirror={'X'}, vertex_group="Empty")

    def test_a_strength_of_zero_is_no_error(self):
        self.plane()
        self.pull(vertex=220, strength=0.0)

    def test_view_without_a_view(self):
        self.plane()
        self.assertRefused("no view", vertex=220, direction='VIEW')

    def test_dynamic_topology(self):
        self.plane()
        bpy.ops.object.mode_set(mode='SCULPT')
        bpy.ops.sculpt.dynamic_topology_toggle()
        self.assertRefused("Dynamic topology", vertex=220)

    def test_multires(self):
        obj = self.plane()
        obj.modifiers.new("Multires", 'MULTIRES')
        self.assertRefused("Multiresolution", vertex=220)

    def test_other_modes_are_refused(self):
        self.plane()
        bpy.ops.object.mode_set(mode='WEIGHT_PAINT')
        self.assertRefused("Object, Edit or Sculpt Mode", vertex=220)

    def test_linked(self):
        self.plane(name="Shared")
        path = str(self.folder / "library.blend")
        bpy.data.libraries.write(path, {bpy.data.objects["Shared"]})
        with bpy.data.libraries.load(path, link=True) as (_, linked):
            linked.objects = ["Shared"]
        obj = linked.objects[0]
        self.scene.collection.objects.link(obj)
        bpy.data.objects.remove(next(found for found in bpy.data.objects if found.library is None))
        self.assertRefused("linked from another file", object="Shared", vertex=220)
        local = bpy.data.objects.new("Local", obj.data)
        self.scene.collection.objects.link(local)
        self.assertRefused("linked from another file", object="Local", vertex=220)

    def test_flat_object(self):
        obj = self.plane()
        obj.scale = 1.0, 1.0, 0.0
        self.assertRefused("scaled to nothing", vertex=220)

    def test_locked_shape_key(self):
        obj = self.plane()
        key = obj.shape_key_add(name="Basis")
        if not hasattr(key, "lock_shape"):
            self.skipTest("shape keys have no lock yet")
        key.lock_shape = True
        self.assertRefused("Basis is locked", vertex=220)
