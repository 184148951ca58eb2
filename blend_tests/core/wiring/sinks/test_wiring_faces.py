"""Systems that make surfaces: at any frame, whole meshes, in files, more than there is room for, and none."""

import bpy
import numpy as np

import toy_faces_system as toy
import toy_points_system
import toy_system
from core.wiring.sinks.test_wiring_points import FRAMES, PointsTestCase
from core.wiring.wiring_cases import frame_set

PLACE = (1.0, 2.0, 3.0)


def evaluated(owner):
    return owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).data


def assert_sheet(owner, frame):
    """The owner has the surface that the system says, to the last bit, and Blender finds it whole."""
    frame_set(frame)
    settings = owner.motus.sheet
    target = settings.target and settings.target.evaluated_get(bpy.context.evaluated_depsgraph_get())
    wanted = toy.sheet(frame, np.array(target.matrix_world.translation) if target else np.zeros(3))
    mesh = evaluated(owner)
    for data, field, array in (
        (mesh.vertices, "co", wanted[0]),
        (mesh.edges, "vertices", wanted[1]),
        (mesh.loops, "vertex_index", wanted[2]),
        (mesh.loops, "edge_index", wanted[3]),
        (mesh.polygons, "loop_start", np.arange(0, wanted[2].size, 3)),
        (mesh.polygons, "loop_total", np.full(len(wanted[2]), 3)),
    ):
        found = np.empty(array.size, array.dtype if array.dtype == np.float32 else np.int32)
        data.foreach_get(field, found)
        np.testing.assert_array_equal(found, array.ravel(), field)
    copy = bpy.data.meshes.new_from_object(owner.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    assert not copy.validate(verbose=True)
    assert all(polygon.use_smooth for polygon in copy.polygons)
    np.testing.assert_allclose(copy.attributes["age"].data[0].value, settings.lifetime)
    bpy.data.meshes.remove(copy)


class FacesTest(PointsTestCase):
    SYSTEMS = toy_points_system.SPARKS, toy.SHEET  # whose settings are of the same class

    def sheet(self, **values):
        # It stands in the world, where the owner is as well.
        owner = toy_system.new_object("Owner", data=bpy.data.meshes.new("Owner"))
        toy_points_system.make(toy.SHEET, owner, target=toy_system.new_target(), **values)
        return owner

    def assert_all_sheets(self, owner):
        for frame in FRAMES:
            with self.subTest(frame=frame):
                assert_sheet(owner, frame)

    def test_any_frame_in_any_order(self):
        owner = self.sheet()
        self.assert_all_sheets(owner)
        self.assertIsNone(self.problem(owner, toy.SHEET))

    def test_modifiers_behind_have_it(self):
        owner = self.sheet()
        owner.modifiers.new("Finer", 'SUBSURF').levels = 1
        frame_set(20)
        triangles = len(toy.sheet(20, np.zeros(3))[2])
        self.assertEqual(len(evaluated(owner).polygons), 3 * triangles)

    def test_none(self):
        owner = self.sheet()
        for name, value in (("influence", 0.0), ("rate", 0.0)):
            assert_sheet(owner, 12)
            kept = getattr(owner.motus.sheet, name)
            setattr(owner.motus.sheet, name, value)
            frame_set(13)
            self.assertEqual(len(evaluated(owner).vertices), 0, name)
            setattr(owner.motus.sheet, name, kept)
        assert_sheet(owner, 13)

    def test_a_part_of_a_surface_is_none(self):
        owner = self.sheet(rate=200_000.0)
        frame_set(12)
        mesh = evaluated(owner)
        self.assertEqual((len(mesh.vertices), len(mesh.edges), len(mesh.polygons)), (0, 0, 0))
        self.assertIn("more points", self.problem(owner, toy.SHEET).sentence)
        owner.motus.sheet.rate = 10.0
        assert_sheet(owner, 12)

    def test_saved_and_opened(self):
        assert_sheet(self.sheet(), 30)
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)
        self.assertEqual(len(bpy.data.objects["Owner"].motus.sheet.hub.data.vertices), 0)
        self.assert_all_sheets(bpy.data.objects["Owner"])

    def test_linked(self):
        self.sheet()
        self.assert_all_sheets(self.load(self.save(), True, "Owner", "Target"))
