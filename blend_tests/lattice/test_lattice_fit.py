"""motus.lattice_fit and its removal."""

import itertools
import math

import bpy
import numpy as np
from mathutils import Matrix, Vector

import support
from lattice import lattice_cases as cases


def fit(**keywords):
    """The new lattice."""
    before = set(bpy.data.objects)
    assert bpy.ops.motus.lattice_fit(**keywords) == {'FINISHED'}
    (lattice,) = set(bpy.data.objects) - before
    bpy.context.view_layer.update()
    return lattice


def corners(lattice):
    """World places of the corners of a lattice at rest."""
    return np.array([lattice.matrix_world @ Vector(corner) for corner in itertools.product((-0.5, 0.5), repeat=3)])


def state(obj):
    """What must be as before when the lattice is gone."""
    return (
        [modifier.name for modifier in obj.modifiers],
        [group.name for group in getattr(obj, "vertex_groups", ())],
        getattr(obj.vertex_groups, "active_index", None),
        cases.evaluated(obj).tobytes(),
        obj.parent,
        tuple(value for row in obj.matrix_world for value in row),
    )


class FitTest(support.SceneTestCase):
    def assert_refused(self, sentence, **keywords):
        """Refused with that sentence, and nothing is changed."""
        before = len(bpy.data.objects), len(bpy.data.lattices), [len(obj.modifiers) for obj in bpy.data.objects]
        mode = bpy.context.mode
        with self.assertRaisesRegex(RuntimeError, sentence):
            bpy.ops.motus.lattice_fit(**keywords)
        self.assertEqual((len(bpy.data.objects), len(bpy.data.lattices), [len(obj.modifiers) for obj in bpy.data.objects]), before)
        self.assertEqual(bpy.context.mode, mode)

    def test_it_goes_around_and_changes_nothing(self):
        ball = cases.ball(place=(1.0, 2.0, 3.0))
        ball.rotation_euler, ball.scale = (0.4, 0.2, 1.0), (1.0, 2.0, 0.5)
        before = cases.evaluated(ball)
        for orientation in ('LOCAL', 'GLOBAL', 'FIT'):
            cases.only(ball)
            lattice = fit(orientation=orientation, margin=0.0, resolution=(3, 4, 5))
            with self.subTest(orientation=orientation):
                data = lattice.data
                self.assertEqual((data.points_u, data.points_v, data.points_w), (3, 4, 5))
                local = cases.shapes().in_world(before, lattice.matrix_world.inverted())
                np.testing.assert_allclose(local.min(axis=0), -0.5, atol=1e-5)
                np.testing.assert_allclose(local.max(axis=0), 0.5, atol=1e-5)
                np.testing.assert_allclose(cases.evaluated(ball), before, atol=1e-6)
                self.assertEqual(bpy.context.object, lattice)
                self.assertEqual(lattice.parent, ball)
            cases.only(ball)
            bpy.ops.motus.lattice_remove()

    def test_fitting_in_every_orientation(self):
        sheet = cases.grid()
        sheet.matrix_world = Matrix.Rotation(0.6, 4, 'Z')
        bpy.context.view_layer.update()
        volumes = {}
        for orientation in ('LOCAL', 'GLOBAL', 'FIT'):
            lattice = fit(objects=sheet.name, orientation=orientation, margin=0.0)
            volumes[orientation] = lattice.matrix_world.determinant()
            if orientation == 'GLOBAL':
                self.assertLess(max(abs(value) for value in lattice.matrix_world.to_euler()), 1e-6)
            else:
                self.assertAlmostEqual(lattice.matrix_world.to_euler().z, 0.6, places=5)
            bpy.ops.motus.lattice_remove(objects=sheet.name)
        self.assertAlmostEqual(volumes['FIT'], volumes['LOCAL'], places=5)
        self.assertGreater(volumes['GLOBAL'], 1.5 * volumes['LOCAL'])

    def test_a_turned_mesh_is_fitted_tightly(self):
        """Turned in its data, so that the object's axes do not tell."""
        box = cases.grid(count=3)
        box.data.transform(Matrix.Rotation(0.5, 4, (1, 2, 3)) @ Matrix.Diagonal((3.0, 1.0, 1.0, 1.0)))
        lattice = fit(objects=box.name, orientation='FIT', margin=0.0)
        sides = sorted(lattice.matrix_world.to_scale())
        np.testing.assert_allclose(sides, (0.6, 2.0, 6.0), rtol=1e-4)

    def test_flat_thin_and_single(self):
        flat = cases.grid()
        lattice = fit(objects=flat.name, margin=0.0)
        np.testing.assert_allclose(lattice.matrix_world.to_scale(), (2.0, 2.0, 0.2), rtol=1e-5)
        for points, sides in (([(1, 2, 3)], (1.0, 1.0, 1.0)), ([(0, 0, 0), (0, 3, 0)], (0.3, 3.0, 0.3))):
            mesh = bpy.data.meshes.new("Few")
            mesh.from_pydata(points, [], [])
            few = support.link("Few", mesh)
            lattice = fit(objects=few.name, margin=0.0)
            np.testing.assert_allclose(lattice.matrix_world.to_scale(), sides, rtol=1e-5)
            bpy.ops.motus.lattice_pull(object=few.name, vertex=0, displacement=(0.0, 0.0, 1.0))
            np.testing.assert_allclose(cases.evaluated(few)[0], np.array(points[0]) + (0.0, 0.0, 1.0), atol=1e-4)

    def test_a_resolution_of_one(self):
        ball = cases.ball()
        lattice = fit(objects=ball.name, resolution=(4, 1, 2))
        self.assertEqual(len(lattice.data.points), 8)
        before = cases.evaluated(ball)
        bpy.ops.motus.lattice_pull(object=ball.name, vertex=5, displacement=(0.0, 0.2, 0.1))
        np.testing.assert_allclose(cases.evaluated(ball)[5] - before[5], (0.0, 0.2, 0.1), atol=1e-5)

    def test_fitting_with_margin_and_interpolation(self):
        ball = cases.ball()
        tight = np.array(fit(objects=ball.name, margin=0.0).matrix_world.to_scale())
        wide = fit(objects=ball.name, margin=0.25, interpolation='CATMULL_ROM')
        np.testing.assert_allclose(np.array(wide.matrix_world.to_scale()) - tight, 0.5 * tight.max(), rtol=1e-4)
        self.assertEqual(wide.data.interpolation_type_w, 'KEY_CATMULL_ROM')

    def test_every_type_of_object_is_fitted(self):
        for make in (cases.ball, cases.curve, cases.surface, cases.text, cases.lattice):
            obj = make()
            with self.subTest(type=obj.type):
                before = cases.evaluated(obj)
                before_state = state(obj)
                lattice = fit(objects=obj.name)
                local = cases.shapes().in_world(before, lattice.matrix_world.inverted())
                self.assertLessEqual(np.abs(local).max(), 0.5)
                np.testing.assert_allclose(cases.evaluated(obj), before, atol=1e-5)
                lattice.location.z += 1.0
                for point in lattice.data.points:
                    point.co_deform.z += 0.5
                self.assertGreater(np.abs(cases.evaluated(obj) - before).max(), 0.1)
                bpy.ops.motus.lattice_remove(objects=obj.name)
                self.assertEqual(state(obj), before_state)

    def test_several_objects_share_one_lattice(self):
        balls = [cases.ball(f"Ball {index}", place=(3.0 * index, 0.0, index)) for index in range(3)]
        camera = support.link("Camera", bpy.data.cameras.new("Camera"))
        cases.only(*balls, camera)
        lattice = fit(orientation='GLOBAL', margin=0.0)
        self.assertIsNone(lattice.parent)
        everything = np.concatenate([cases.evaluated(ball) for ball in balls])
        box = corners(lattice)
        np.testing.assert_allclose(box.min(axis=0), everything.min(axis=0), atol=1e-5)
        np.testing.assert_allclose(box.max(axis=0), everything.max(axis=0), atol=1e-5)
        self.assertEqual([[modifier.object for modifier in ball.modifiers] for ball in balls], [[lattice]] * 3)
        bpy.ops.motus.lattice_remove(objects=balls[0].name)
        self.assertIn(lattice.name, bpy.data.objects)
        bpy.ops.motus.lattice_remove(objects=lattice.name)
        self.assertFalse(any(ball.modifiers for ball in balls))
        self.assertFalse(bpy.data.lattices)

    def test_by_collection_and_by_names(self):
        group = bpy.data.collections.new("Things")
        bpy.context.scene.collection.children.link(group)
        for name in ("One", "Two"):
            obj = cases.ball(name)
            group.objects.link(obj)
            bpy.context.scene.collection.objects.unlink(obj)
        lattice = fit(objects="Things")
        self.assertEqual(list(lattice.users_collection), [group])
        bpy.ops.motus.lattice_remove(objects="One, Two")
        self.assertFalse(bpy.data.lattices)

    def test_the_lattice_moves_along(self):
        ball = cases.ball()
        lattice = fit(objects=ball.name)
        cases.displace(lattice)
        before = cases.evaluated(ball)
        ball.matrix_world = Matrix.Translation((5, 0, 0)) @ Matrix.Rotation(1.0, 4, 'Y')
        bpy.context.view_layer.update()
        np.testing.assert_allclose(cases.evaluated(ball), cases.shapes().in_world(before, ball.matrix_world), atol=1e-5)
        bpy.ops.motus.lattice_remove(objects=ball.name)
        self.assertIsNone(fit(objects=ball.name, use_parent=False).parent)

    def test_selected_vertices(self):
        sheet = cases.grid()
        subdivision = sheet.modifiers.new("Subdivision", 'SUBSURF')
        sheet.vertex_groups.new(name="Mine").add([0], 1.0, 'REPLACE')
        before = state(sheet)
        cases.only(sheet)
        for vertex in sheet.data.vertices:
            vertex.select = vertex.co.x > 0.0 and vertex.co.y > 0.0
        chosen = [vertex.index for vertex in sheet.data.vertices if vertex.select]
        for polygon in sheet.data.polygons:
            polygon.select = all(sheet.data.vertices[index].select for index in polygon.vertices)
        for edge in sheet.data.edges:
            edge.select = all(sheet.data.vertices[index].select for index in edge.vertices)
        bpy.ops.object.mode_set(mode='EDIT')
        lattice = fit(margin=0.0)
        self.assertEqual(bpy.context.mode, 'OBJECT')
        modifier = sheet.modifiers[0]
        self.assertEqual((modifier.object, sheet.modifiers[1]), (lattice, subdivision))
        group = sheet.vertex_groups[modifier.vertex_group]
        self.assertEqual(sheet.vertex_groups.active.name, "Mine")
        weighted = [vertex.index for vertex in sheet.data.vertices if any(one.group == group.index for one in vertex.groups)]
        self.assertEqual(weighted, chosen)
        box = corners(lattice)
        self.assertGreater(box[:, :2].min(), 0.0)
        np.testing.assert_allclose(box[:, :2].max(), 1.0, atol=1e-5)
        subdivision.show_viewport = False
        rest = cases.evaluated(sheet)
        for point in lattice.data.points:
            point.co_deform.z += 1.0
        moved = np.abs(cases.evaluated(sheet) - rest).max(axis=1) > 1e-6
        self.assertEqual(np.flatnonzero(moved).tolist(), chosen)
        subdivision.show_viewport = True
        bpy.ops.motus.lattice_remove(objects=sheet.name)
        self.assertEqual(state(sheet), before)

    def test_a_vertex_group(self):
        ball = cases.ball()
        ball.vertex_groups.new(name="Some").add(list(range(40)), 0.5, 'REPLACE')
        lattice = fit(objects=ball.name, vertex_group="Some", margin=0.0)
        local = cases.shapes().in_world(cases.evaluated(ball)[:40], lattice.matrix_world.inverted())
        np.testing.assert_allclose(np.abs(local).max(axis=0), 0.5, atol=1e-5)
        self.assert_refused("has no vertex group Other", objects=ball.name, vertex_group="Other")
        ball.vertex_groups.new(name="Empty")
        self.assert_refused("Empty of Ball is empty", objects=ball.name, vertex_group="Empty")

    def test_refusals(self):
        self.assert_refused("Select a mesh, a curve")
        self.assert_refused("There is no object Nobody", objects="Nobody")
        support.link("Camera", bpy.data.cameras.new("Camera"))
        self.assert_refused("Camera has no shape", objects="Camera")
        support.link("Nothing", bpy.data.meshes.new("Nothing"))
        self.assert_refused("Nothing has no geometry", objects="Nothing")
        cases.ball("Flat").scale.x = 0.0
        bpy.context.view_layer.update()
        self.assert_refused("Flat is scaled to nothing", objects="Flat")
        cases.curve("Wire")
        self.assert_refused("Wire has no vertices to choose from", objects="Wire", vertex_group="Any")
        ball = cases.ball("Far")
        places = cases.shapes().positions(ball.data)
        places[3, 0] = math.inf
        ball.data.vertices.foreach_set("co", places.ravel())  # which, unlike a single one, is not clamped
        ball.data.update()
        self.assert_refused("Far has vertices at infinity", objects="Far")
        self.assert_refused("margin is not a finite number", objects="Far", margin=math.nan)

    def test_sizes_that_blender_cannot_scale_to(self):
        cases.ball("Ball")
        for margin in (1e19, 1e30, 3e38):
            self.assert_refused("too large or too small", objects="Ball", margin=margin)
        for size in (1e-30, 1e25):
            tiny = cases.ball("Ball")
            tiny.data.transform(Matrix.Scale(size, 4))
            self.assert_refused("too large or too small", objects=tiny.name)
        lattice = fit(objects="Ball", margin=1e17)
        self.assertTrue(all(0.0 < side < math.inf for side in lattice.scale))

    def test_nothing_selected_in_edit_mode(self):
        sheet = cases.grid()
        cases.only(sheet)
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.mesh.select_all(action='DESELECT')
        self.assert_refused("Select the vertices")
        bpy.ops.object.mode_set(mode='OBJECT')

    def test_linked_objects_are_refused(self):
        cases.ball("Ball")
        path = self.folder / "library.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
        support.empty_scene()
        with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
            wanted.objects = ["Ball"]
        bpy.context.scene.collection.objects.link(wanted.objects[0])
        self.assert_refused("linked from another file", objects="Ball")
        own = support.link("Own", wanted.objects[0].data)
        own.vertex_groups.clear()
        self.assert_refused("The mesh of Own is linked", objects="Own", vertex_group="Any")
        self.assertEqual(fit(objects="Own").parent, own)  # the object's own modifiers are free

    def test_undone_in_one_step(self):
        sheet = cases.grid()
        cases.only(sheet)
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.mesh.select_all(action='SELECT')
        bpy.ops.ed.undo_push(message="before")
        fit()
        bpy.ops.ed.undo_push(message="fitted")
        bpy.ops.ed.undo()
        sheet = bpy.data.objects["Sheet"]
        self.assertFalse(sheet.modifiers)
        self.assertFalse(sheet.vertex_groups)
        self.assertEqual(set(bpy.data.objects), {sheet})
        bpy.ops.ed.redo()
        self.assertEqual(len(bpy.data.objects["Sheet"].modifiers), 1)


class RemoveTest(support.SceneTestCase):
    def test_lattice_is_applied(self):
        ball = cases.ball()
        ball.vertex_groups.new(name="Some").add(list(range(100)), 1.0, 'REPLACE')
        lattice = fit(objects=ball.name, vertex_group="Some")
        cases.displace(lattice, 0.1)
        deformed = cases.evaluated(ball)
        bpy.ops.motus.lattice_remove(objects=ball.name, use_apply=True)
        self.assertFalse(ball.modifiers)
        self.assertEqual([group.name for group in ball.vertex_groups], ["Some"])
        self.assertEqual(set(bpy.data.objects), {ball})
        np.testing.assert_allclose(cases.shapes().positions(ball.data), deformed, atol=1e-6)

    def test_applied_among_other_modifiers(self):
        """What is seen stays, or a sentence names the modifier in the way, and nothing is changed."""
        for kind in ('SUBSURF', 'MIRROR', 'ARRAY', 'SIMPLE_DEFORM', 'SMOOTH', 'WEIGHTED_NORMAL'):
            for is_behind in (False, True):
                ball = cases.ball(kind)
                if not is_behind:
                    ball.modifiers.new("Other", kind)
                lattice = fit(objects=ball.name)
                if is_behind:
                    ball.modifiers.new("Other", kind)
                cases.displace(lattice, 0.2)
                before = cases.evaluated(ball)
                with self.subTest(kind=kind, is_behind=is_behind):
                    if is_behind or kind == 'WEIGHTED_NORMAL':
                        bpy.ops.motus.lattice_remove(objects=ball.name, use_apply=True)
                        self.assertEqual(len(ball.modifiers), 1)
                    else:
                        with self.assertRaisesRegex(RuntimeError, "Other of .* acts before"):
                            bpy.ops.motus.lattice_remove(objects=ball.name, use_apply=True)
                        self.assertEqual(len(ball.modifiers), 2)
                    np.testing.assert_allclose(cases.evaluated(ball), before, atol=1e-5)

    def test_a_modifier_in_the_way_that_is_off_or_applied_along(self):
        ball = cases.ball()
        other = ball.modifiers.new("Other", 'SUBSURF')
        other.show_viewport = other.show_render = False
        for _ in range(2):
            cases.displace(fit(objects=ball.name), 0.1)
        before = cases.evaluated(ball)
        bpy.ops.motus.lattice_remove(objects=ball.name, use_apply=True)
        self.assertEqual([one.name for one in ball.modifiers], ["Other"])
        np.testing.assert_allclose(cases.evaluated(ball), before, atol=1e-5)

    def test_one_of_two_lattices_is_removed(self):
        ball = cases.ball()
        first, second = fit(objects=ball.name), fit(objects=ball.name)
        bpy.ops.motus.lattice_remove(objects=ball.name, modifier=ball.modifiers[0].name)
        self.assertEqual([modifier.object for modifier in ball.modifiers], [second])
        self.assertEqual(set(bpy.data.objects), {ball, second})
        with self.assertRaises(ReferenceError):
            first.name  # noqa: B018  (gone, which this shows)

    def test_the_users_own_lattice_stays(self):
        ball = cases.ball()
        own = cases.lattice()
        modifier = ball.modifiers.new("Own", 'LATTICE')
        modifier.object = own
        with self.assertRaisesRegex(RuntimeError, "Nothing here has a lattice"):
            bpy.ops.motus.lattice_remove(objects=ball.name)
        fit(objects=ball.name)
        bpy.ops.motus.lattice_remove(objects=ball.name)
        self.assertEqual([one.name for one in ball.modifiers], ["Own"])

    def test_a_lattice_that_followed_a_path_is_still_a_fitted_one(self):
        ball = cases.ball()
        cases.curve("Course")
        for release in ("alone", "as a wagon"):
            with self.subTest(release):
                lattice = fit(objects=ball.name, use_parent=False)
                if release == "alone":
                    bpy.ops.motus.path_follow_add(object=lattice.name, curve="Course")
                else:
                    support.link("Engine", None)
                    bpy.ops.motus.path_train_add(objects=f"Engine,{lattice.name}", curve="Course")
                bpy.ops.motus.path_follow_remove(object=lattice.name)
                self.assertTrue(lattice.motus.lattice.is_fitted)
                self.assertIsNone(lattice.motus.path.curve)
                bpy.ops.motus.lattice_remove(objects=ball.name)
                self.assertEqual(len(bpy.data.lattices), 0)

    def test_what_cannot_be_applied_is_left(self):
        twin = cases.ball("Twin")
        support.link("Other", twin.data)
        keyed = cases.ball("Keyed")
        keyed.shape_key_add(name="Basis")
        words = cases.text("Words")
        hidden = cases.ball("Hidden")
        for obj, sentence in ((twin, "shares its shape"), (keyed, "has shape keys"), (words, "is a text"), (hidden, "is switched off")):
            fit(objects=obj.name)
            obj.modifiers[0].show_viewport = obj is not hidden
            with self.subTest(object=obj.name), self.assertRaisesRegex(RuntimeError, sentence):
                bpy.ops.motus.lattice_remove(objects=f"{obj.name}", use_apply=True)
            self.assertEqual(len(obj.modifiers), 1)
            self.assertIsNotNone(obj.modifiers[0].object)

    def test_points_are_reset(self):
        ball = cases.ball()
        before = cases.evaluated(ball)
        lattice = fit(objects=ball.name)
        rest = cases.points_of(lattice)
        cases.displace(lattice)
        bpy.ops.motus.lattice_reset(object=lattice.name)
        np.testing.assert_array_equal(cases.points_of(lattice), rest)
        np.testing.assert_allclose(cases.evaluated(ball), before, atol=1e-6)
