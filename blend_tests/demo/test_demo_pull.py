"""The demo of Pick & Pull: it stands in a scene of its own, and land and face live by their pins alone."""

import unittest
from pathlib import Path

import bpy
import numpy as np

import support
from demo import demo_cases

MODULES = ("pull/scene", "pull/balls", "pull/face", "pull/face_motion", "pull/terrain", "places/clay_studio", "stage/keying")
SEA = 0.11  # height of the sea over the grid, m
SOME_FRAMES = (1, 36, 46, 56, 66, 80, 100, 126, 150, 160, 170, 184, 200, 216)


def positions(mesh):
    """(n, 3) of the vertices of a mesh."""
    found = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", found)
    return found.reshape(-1, 3)


class PulledFromClay(unittest.TestCase):
    """All tests look at one scene, which takes some seconds to build."""

    @classmethod
    def setUpClass(cls):
        support.empty_scene()
        cls.own = bpy.context.scene
        cls.own.collection.objects.link(bpy.data.objects.new("Own", None))
        cls.own.frame_set(7)
        cls.before = cls.state_of_own()
        cls.result = demo_cases.build('PULL')
        cls.scene = bpy.context.window.scene
        cls.land, cls.head = cls.scene.objects["Land"], cls.scene.objects["Suzanne"]
        cls.scan, cls.ball = cls.scene.objects["Clay Ball 1"], cls.scene.objects["Clay Ball 2"]
        cls.seen = {frame: cls.moment(frame) for frame in SOME_FRAMES}

    @classmethod
    def tearDownClass(cls):
        support.empty_scene()

    @classmethod
    def state_of_own(cls):
        scene, brush = cls.own, cls.own.motus.pull
        settings = [getattr(brush, name) for name in ("radius", "strength", "falloff", "distance")]
        names = [thing.name for thing in scene.objects]
        return names, scene.frame_current, scene.render.fps, scene.world, scene.camera, settings, brush.last.object

    @classmethod
    def moment(cls, frame):
        """(positions of the land, of the head) as seen on a frame."""
        cls.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        return [positions(thing.evaluated_get(depsgraph).data) for thing in (cls.land, cls.head)]

    def head_moved(self, frame):
        """How far each point of the head is from where the mesh has it."""
        return self.seen[frame][1] - positions(self.head.data)

    def near(self, place, within):
        """The points of the head within a distance of a place."""
        return np.linalg.norm(positions(self.head.data) - np.array(place), axis=1) < within

    # --- the scene ------------------------------------------------------------------------------------------------

    def test_in_a_scene_of_its_own(self):
        self.assertEqual(self.result, {'FINISHED'})
        self.assertNotEqual(self.scene, self.own)
        self.assertEqual(self.state_of_own(), self.before)
        self.assertFalse(set(self.scene.objects) & set(self.own.objects))
        self.assertIsNotNone(self.scene.camera)
        seconds = (self.scene.frame_end - self.scene.frame_start + 1) / self.scene.render.fps
        self.assertTrue(8.0 <= seconds <= 10.0, seconds)

    def test_by_public_operators_only(self):
        folder = Path(support.addon("demo").__file__).parent
        for module in MODULES:
            self.assertNotIn("from ...", (folder / f"{module}.py").read_text(encoding="utf-8"), module)
        for thing in self.scene.objects:
            wanted = ['NODES'] if thing in (self.land, self.head, self.scan) else []
            self.assertEqual([modifier.type for modifier in thing.modifiers], wanted, thing.name)
            self.assertEqual(thing.type == 'MESH' and thing.data.shape_keys is not None, thing == self.ball, thing.name)

    def test_every_pin_holds_and_is_keyed(self):
        pins_solve, wiring = support.addon("pull.pins.solve"), support.addon("core.wiring")
        system, depsgraph = support.addon("pull").SYSTEM, bpy.context.evaluated_depsgraph_get()
        for thing in (self.land, self.head, self.scan):
            self.assertIsNone(wiring.problem(system, thing, depsgraph))
            keyed = {curve.data_path for curve in support.addon("core.blender.actions").fcurves(thing)}
            for index, pin in enumerate(thing.motus.pull.pins):
                with self.subTest(pin=pin.name, of=thing.name):
                    found = wiring.output(system, thing, f"pin{index}", depsgraph)
                    self.assertEqual(int(found), pins_solve.OK)
                    self.assertIn(f"motus.pull.pins[{index}].strength", keyed)

    def test_the_scan_is_pulled_and_does_not_tear(self):
        rest = positions(self.scan.data)
        self.scene.frame_set(110)
        pulled = positions(self.scan.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)
        self.assertGreater(float(np.linalg.norm(pulled - rest, axis=1).max()), 0.15)
        _, same = np.unique(np.round(rest, 4), axis=0, return_inverse=True)
        same = same.ravel()
        self.assertLess(same.max() + 1, len(rest) // 4)
        first = np.full(same.max() + 1, -1)
        first[same[::-1]] = np.arange(len(rest))[::-1]
        self.assertLess(float(np.abs(pulled - pulled[first[same]]).max()), 2e-3)

    def test_the_other_ball_leans_by_a_shape_key(self):
        heights = []
        for frame in (1, 36):
            self.scene.frame_set(frame)
            heights.append(positions(self.ball.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)[:, 2].max())
        self.assertGreater(heights[1], heights[0] + 0.05)

    def test_built_twice(self):
        self.addCleanup(setattr, bpy.context.window, "scene", self.scene)
        bpy.ops.motus.demo_scene(system='PULL')
        second = bpy.context.window.scene
        self.assertNotEqual(second, self.scene)
        second.frame_set(100)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for name, wanted in zip(("Land", "Suzanne"), self.seen[100]):
            thing = next(one for one in second.objects if one.name.startswith(name))
            self.assertNotIn(thing, (self.land, self.head))
            self.assertLess(float(np.abs(positions(thing.evaluated_get(depsgraph).data) - wanted).max()), 1e-6)

    # --- the land -------------------------------------------------------------------------------------------------

    def test_land_rises_from_the_sea_and_sinks_again(self):
        dry = {frame: float((land[:, 2] > SEA).mean()) for frame, (land, _) in self.seen.items()}
        for frame in (1, 36, 46, 216):
            self.assertEqual(dry[frame], 0.0, frame)
        self.assertTrue(0.0 < dry[66] < dry[100], dry)
        self.assertTrue(0.2 < dry[126] < 0.7, dry)
        self.assertGreater(self.seen[126][0][:, 2].max(), 1.0)

    def test_land_is_pulled_upwards_only_and_stays_in_its_tray(self):
        flat = self.land.data
        rest = positions(flat)
        for frame, (land, _) in self.seen.items():
            with self.subTest(frame=frame):
                self.assertTrue((land[:, :2] == rest[:, :2]).all())
                border = np.abs(rest[:, :2]).max(axis=0) - np.abs(rest[:, :2]) < 0.02
                self.assertLess(land[border.any(axis=1), 2].max(), SEA)

    def test_limits_make_a_level_mesa(self):
        pin = self.land.motus.pull.pins["Mesa"]
        rest, land = positions(self.land.data), self.seen[126][0]
        away = np.linalg.norm(rest[:, :2] - np.array(pin.place[:2]), axis=1)
        step = self.land.motus.pull.pins["Mesa Step"]
        clear = np.linalg.norm(rest[:, :2] - np.array(step.place[:2]), axis=1) > step.radius
        ledge = land[(away < 0.4) & clear, 2]
        self.assertGreater(len(ledge), 50)
        self.assertLess(float(np.ptp(ledge)), 1e-6)

    # --- the face -------------------------------------------------------------------------------------------------

    def test_face_is_still_at_rest(self):
        self.assertLess(float(np.abs(self.head_moved(1)).max()), 0.06)  # a trace of a smile

    def test_squash_and_stretch(self):
        crown = self.near((0.0, 0.2, 1.2), 0.3)
        self.assertLess(self.head_moved(46)[crown, 2].mean(), -0.35)
        self.assertGreater(self.head_moved(56)[crown, 2].mean(), 0.12)

    def test_brows_have_strengths_of_their_own(self):
        pins = self.head.motus.pull.pins
        left, right = (self.near(pins[name].place, 0.1) for name in ("Brow", "Other Brow"))
        self.assertLess(pins["Brow"].place[0] * pins["Other Brow"].place[0], 0.0)
        moved = self.head_moved(126)
        self.assertGreater(moved[left, 2].mean() - moved[right, 2].mean(), 0.15)
        both = self.head_moved(100)
        self.assertAlmostEqual(float(both[left, 2].mean()), float(both[right, 2].mean()), delta=0.01)

    def test_pulls_along_the_surface_leave_the_eyes(self):
        """The eyes are pieces of their own: only what pulls through space takes them along."""
        is_eye = np.zeros(len(self.head.data.vertices), bool)
        for face in self.head.data.polygons:
            if face.material_index == 1:
                is_eye[list(face.vertices)] = True
        self.assertTrue(1000 < is_eye.sum() < 0.25 * len(is_eye), is_eye.sum())
        moved = np.linalg.norm(self.head_moved(126), axis=1)
        self.assertLess(moved[is_eye].max(), 1e-4)
        self.assertGreater(moved[~is_eye].max(), 0.4)
        self.assertGreater(np.linalg.norm(self.head_moved(46), axis=1)[is_eye].min(), 0.05)

    # --- the motion -----------------------------------------------------------------------------------------------

    def test_cycle_closes(self):
        cycle = support.addon("demo.stage.keying").CYCLE
        for frame in (0, 1, 2):
            first, later = self.moment(frame), self.moment(frame + cycle)
            for one, other in zip(first, later):
                self.assertLess(float(np.abs(one - other).max()), 1e-5, frame)

    def test_frames_in_any_order(self):
        self.moment(3)
        for played, alone in zip(self.seen[126], self.moment(126)):
            self.assertTrue((played == alone).all())
