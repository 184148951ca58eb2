"""Pins: what they do to the mesh, at any frame and in any order."""

import bpy
import numpy as np

import support
from pull.pins import pin_cases as cases
from pull.pins.pin_cases import add, basis, centre, evaluated, vertex_at
from support import go_to


class ShapeTest(cases.PinsTestCase):
    def test_one_pin_pulls_what_is_near(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root, (0.1, 0.2, 1.0))
        self.assert_shape(grid, cases.pulled(basis(grid), root, (0.1, 0.2, 1.0)))

    def test_nothing_beyond_the_radius_moves(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root)
        far = np.linalg.norm(basis(grid) - basis(grid)[root], axis=1) >= cases.RADIUS
        self.assert_bits(evaluated(grid)[far], basis(grid)[far])

    def test_the_mesh_itself_is_left_alone(self):
        grid = cases.new_grid()
        before = basis(grid)
        add(grid, centre(grid))
        self.assert_bits(basis(grid), before)

    def test_every_falloff(self):
        for falloff in ("smooth", "sphere", "root", "linear", "sharp", "constant", "gaussian", "classic"):
            with self.subTest(falloff):
                support.empty_scene()
                grid = cases.new_grid()
                root = centre(grid)
                add(grid, root, radius=0.77, falloff=falloff.upper())
                self.assert_shape(grid, cases.pulled(basis(grid), root, (0.0, 0.0, 1.0), 0.77, falloff))

    def test_curve_of_ones_own(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root, falloff='CURVE', curve=[index / 31.0 for index in range(32)])
        self.assert_shape(grid, cases.pulled(basis(grid), root, (0.0, 0.0, 1.0), falloff="linear"))

    def test_edges_are_counted(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root, radius=3.0, distance='EDGES', falloff='LINEAR')
        steps = np.abs((basis(grid) - basis(grid)[root])[:, :2] / 0.1).round().sum(axis=1)
        wanted = basis(grid)
        wanted[:, 2] = cases.force(steps, 3.0, "linear")
        self.assert_shape(grid, wanted)

    def test_surface_distance_does_not_jump_to_a_near_sheet(self):
        grid = cases.new_grid(41, 4.0)
        folded = basis(grid)  # in the middle it is bent over, to a sheet 0.05 above itself
        folded[:, 2] = np.where(folded[:, 0] > 0.0, 0.05, 0.0)
        folded[:, 0] = np.abs(folded[:, 0])
        grid.data.vertices.foreach_set("co", folded.ravel())
        grid.data.update()
        root = int((((folded - (1.5, 0.0, 0.0)) ** 2).sum(axis=1)).argmin())
        add(grid, root, radius=0.5, distance='SURFACE')
        moved = np.abs(evaluated(grid) - folded).max(axis=1) > 0.0
        self.assertTrue(moved[root])
        self.assertFalse(moved[folded[:, 2] > 0.01].any())

    def test_several_add_up_whatever_was_pulled_before(self):
        grid = cases.new_grid()
        first, second = centre(grid), vertex_at(grid, 0.3, 0.1)
        add(grid, first, (0.0, 0.0, 1.0))
        add(grid, second, (0.5, 0.0, -0.2), radius=0.5)
        wanted = cases.pulled(basis(grid), first, (0.0, 0.0, 1.0))
        wanted = cases.pulled(wanted, second, (0.5, 0.0, -0.2), 0.5, source=basis(grid))
        self.assert_shape(grid, wanted)

    def test_limits_make_the_order_count(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root, (0.0, 0.0, 1.0), falloff='CONSTANT')
        add(grid, root, (0.0, 0.0, 1.0), falloff='CONSTANT', use_maximum=True, maximum=0.25)
        self.assertAlmostEqual(evaluated(grid)[root, 2], 0.25, places=6)
        bpy.ops.motus.pin_move(index=1, place=0)
        self.assertAlmostEqual(evaluated(grid)[root, 2], 1.25, places=6)

    def test_minimum_leaves_what_is_out_of_reach(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root, (0.0, 0.0, -1.0), use_minimum=True, minimum=-0.3)
        wanted = cases.pulled(basis(grid), root, (0.0, 0.0, -1.0))
        wanted[:, 2] = np.maximum(wanted[:, 2], -0.3)
        self.assert_shape(grid, wanted)

    def test_mirror(self):
        grid = cases.new_grid()
        root, other = vertex_at(grid, 0.6, 0.2), vertex_at(grid, -0.6, 0.2)
        add(grid, root, (0.1, 0.0, 0.5), radius=0.4, mirror={'X'})
        wanted = cases.pulled(basis(grid), root, (0.1, 0.0, 0.5), 0.4)
        wanted = cases.pulled(wanted, other, (-0.1, 0.0, 0.5), 0.4, source=basis(grid))
        self.assert_shape(grid, wanted)

    def test_vertex_group_is_a_mask(self):
        grid = cases.new_grid()
        root = centre(grid)
        group = grid.vertex_groups.new(name="Half")
        right = [index for index, place in enumerate(basis(grid)) if place[0] > 0.0]
        group.add(right, 0.5, 'REPLACE')
        add(grid, root, vertex_group="Half")
        wanted = cases.pulled(basis(grid), root, (0.0, 0.0, 1.0))
        wanted[:, 2] *= np.where(basis(grid)[:, 0] > 0.0, 0.5, 0.0)
        self.assert_shape(grid, wanted)

    def test_world_units_on_a_scaled_object(self):
        grid = cases.new_grid()
        grid.scale, grid.location = (2.0, 0.5, 3.0), (5.0, 6.0, 7.0)
        bpy.context.view_layer.update()
        root = centre(grid)
        add(grid, root, (0.0, 0.0, 1.5))
        wanted = cases.pulled(basis(grid), root, (0.0, 0.0, 0.5), metric=np.diag((2.0, 0.5, 3.0)))
        self.assert_shape(grid, wanted)

    def test_local_units_on_a_scaled_object(self):
        grid = cases.new_grid()
        grid.scale = (2.0, 0.5, 3.0)
        bpy.context.view_layer.update()
        root = centre(grid)
        add(grid, root, (0.0, 0.0, 1.5), unit='LOCAL')
        self.assert_shape(grid, cases.pulled(basis(grid), root, (0.0, 0.0, 1.5)))

    def test_shape_keys_and_a_subdivision_after_it(self):
        grid = cases.new_grid()
        grid.shape_key_add(name="Basis")
        key = grid.shape_key_add(name="Lift")
        lifted = basis(grid) + np.array((0.0, 0.3, 0.0), np.float32)
        (key.points if hasattr(key, "points") else key.data).foreach_set("co", lifted.ravel())
        key.value = 0.5
        root = centre(grid)
        add(grid, root)
        wanted = cases.pulled(basis(grid), root, (0.0, 0.0, 1.0)) + np.array((0.0, 0.15, 0.0), np.float32)
        self.assert_shape(grid, wanted)
        grid.modifiers.new("Subdivision", 'SUBSURF')
        self.assertGreater(len(evaluated(grid)), 3 * len(basis(grid)))
        self.assertAlmostEqual(evaluated(grid)[root, 2], evaluated(grid)[:, 2].max(), places=6)

    def test_modifiers_that_were_there_come_after(self):
        grid = cases.new_grid()
        grid.modifiers.new("Subdivision", 'SUBSURF')
        add(grid, centre(grid))
        self.assertEqual([modifier.type for modifier in grid.modifiers], ['NODES', 'SUBSURF'])
        self.assertGreater(evaluated(grid)[:, 2].max(), 0.8)

    def test_influence_mute_and_strength(self):
        grid = cases.new_grid()
        root = centre(grid)
        pin = add(grid, root)
        for value in (0.0, 0.5, -1.0, 2.0):
            pin.strength = value
            self.assertAlmostEqual(evaluated(grid)[root, 2], value, places=6)
        grid.motus.pull.influence = 0.25
        self.assertAlmostEqual(evaluated(grid)[root, 2], 0.5, places=6)
        pin.is_muted = True
        self.assert_bits(evaluated(grid), basis(grid))

    def test_a_way_that_is_no_usable_number(self):
        """Numbers that are usable each by itself; the other pin goes on."""
        wiring, setup, solve = (support.addon(name) for name in ("core.wiring", "pull.pins.setup", "pull.pins.solve"))
        grid = cases.new_grid()
        root = centre(grid)
        pin = add(grid, root - 1)
        add(grid, root)
        pin = grid.motus.pull.pins[0]
        wanted = cases.pulled(basis(grid), root, (0.0, 0.0, 1.0))
        for mirror in (set(), {'X'}, {'X', 'Y'}):
            for strength, way in ((1e25, 1e20), (1.0, 3e38), (3e38, 3e38), (-1e30, 1e30), (1e30, -1e8)):
                for has_limit in (False, True):
                    pin.mirror, pin.use_maximum, pin.strength = mirror, has_limit, strength
                    pin.displacement = 0.0, 0.0, way
                    self.assert_shape(grid, wanted)
                    problem = wiring.problem(setup.system(), grid, bpy.context.view_layer.depsgraph)
                    self.assertEqual(problem and problem.sentence, solve.UNUSABLE.sentence, (mirror, strength, way))
        pin.mirror, pin.use_maximum, pin.strength, pin.displacement = set(), False, 1e25, (0.0, 0.0, 1e-25)
        self.assertAlmostEqual(evaluated(grid)[root - 1, 2], wanted[root - 1, 2] + 1.0, places=5)

    def test_a_pin_by_location_and_the_scenes_brush(self):
        grid = cases.new_grid()
        brush = bpy.context.scene.motus.pull
        brush.radius, brush.strength, brush.direction, brush.falloff = 0.7, 0.4, 'Z', 'LINEAR'
        bpy.ops.motus.pin_add(location=(0.31, -0.18, 0.05))
        root = vertex_at(grid, 0.31, -0.18)
        self.assert_shape(grid, cases.pulled(basis(grid), root, (0.0, 0.0, 0.4), 0.7, "linear"))


class TimeTest(cases.PinsTestCase):
    FRAMES = (1, 30, 7.25, 11, 2.5, 30, 1, 19.75)

    def animated(self):
        grid = cases.new_grid()
        for vertex, keys in ((centre(grid), {1: 0.0, 11: 1.0}), (vertex_at(grid, 0.4, 0.3), {5: -1.0, 25: 0.7})):
            cases.key_strength(add(grid, vertex, (0.2, 0.1, 1.0)), keys)
        return grid

    def test_keyed_strength(self):
        grid = cases.new_grid()
        root = centre(grid)
        cases.key_strength(add(grid, root), {1: 0.0, 11: 1.0})
        for frame, strength in ((6, 0.5), (1, 0.0), (3.5, 0.25), (50, 1.0)):
            go_to(frame)
            self.assert_shape(grid, cases.pulled(basis(grid), root, (0.0, 0.0, strength)))

    def test_any_order_of_frames_bit_for_bit(self):
        grid = self.animated()
        shapes = {}
        for frame in self.FRAMES:
            go_to(frame)
            shape = evaluated(grid).copy()
            self.assert_bits(shape, shapes.setdefault(frame, shape))
        for frame in sorted(set(self.FRAMES)):
            go_to(frame)
            self.assert_bits(evaluated(grid), shapes[frame])

    def test_nothing_kept_gives_the_same_bits(self):
        grid = self.animated()
        go_to(7.25)
        kept = evaluated(grid).copy()
        support.addon("pull.pins.shapes")._shapes.clear()
        go_to(3)
        support.addon("pull.pins.shapes")._shapes.clear()
        go_to(7.25)
        self.assert_bits(evaluated(grid), kept)

    def test_driven_strength_and_mute(self):
        grid = cases.new_grid()
        root = centre(grid)
        pin = add(grid, root)
        pin.driver_add("strength").driver.expression = "0.1 * frame"
        for frame in (4, 9, 2.5):
            go_to(frame)
            self.assertAlmostEqual(evaluated(grid)[root, 2], 0.1 * frame, places=6)
        pin.driver_add("is_muted").driver.expression = "frame > 5"
        go_to(9)
        self.assert_bits(evaluated(grid), basis(grid))
        go_to(4)
        self.assertAlmostEqual(evaluated(grid)[root, 2], 0.4, places=6)

    def test_keyed_influence(self):
        grid = cases.new_grid()
        root = centre(grid)
        add(grid, root)
        settings = grid.motus.pull
        for frame, value in ((1, 0.0), (11, 1.0)):
            settings.influence = value
            settings.keyframe_insert("influence", frame=frame)
        for curve in support.addon("core.blender.actions").fcurves(grid):
            curve.keyframe_points[0].interpolation = 'LINEAR'
        for frame in (6, 2, 11):
            go_to(frame)
            self.assertAlmostEqual(evaluated(grid)[root, 2], (frame - 1) / 10.0, places=6)

    def test_still_pins_are_not_computed_on_every_frame(self):
        solver = support.addon("core.wiring.solving.namespace")
        grid = cases.new_grid()
        add(grid, centre(grid))
        go_to(1)
        calls = []
        original = solver.motus_solve
        solver.motus_solve = lambda *arguments: calls.append(arguments[1]) or original(*arguments)
        self.addCleanup(setattr, solver, "motus_solve", original)
        for frame in (2, 3, 4):
            go_to(frame)
        self.assertEqual(calls, [])
        cases.key_strength(grid.motus.pull.pins[0], {1: 0.0, 11: 1.0})
        go_to(5)
        self.assertIn("pull", calls)

    @support.needs_drawing
    def test_rendered_as_seen(self):
        grid = cases.new_grid()
        cases.key_strength(add(grid, centre(grid), (0.0, 0.0, 2.0)), {1: 0.0, 11: 1.0})
        scene = bpy.context.scene
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        camera.data.type, camera.data.ortho_scale = 'ORTHO', 6.0
        camera.location, camera.rotation_euler = (0.0, -10.0, 0.0), (np.pi / 2.0, 0.0, 0.0)
        scene.collection.objects.link(camera)
        scene.camera = camera
        render = scene.render
        render.engine, render.film_transparent = 'BLENDER_WORKBENCH', True
        render.resolution_x = render.resolution_y = 60
        render.resolution_percentage, render.image_settings.file_format = 100, 'PNG'
        heights = []
        for frame in (11, 1, 6):
            scene.frame_set(frame)
            render.filepath = str(self.folder / f"{frame}.png")
            bpy.ops.render.render(write_still=True)
            image = bpy.data.images.load(render.filepath)
            alpha = np.array(image.pixels[:]).reshape(60, 60, 4)[..., 3]
            heights.append(int((alpha.max(axis=1) > 0.5).sum()))
        self.assertLessEqual(heights[1], 2)
        self.assertAlmostEqual(heights[0], 20, delta=2)
        self.assertAlmostEqual(heights[2], 10, delta=2)
