"""Strands through the binding: shapes, defaults and errors. The formulas are tested natively."""

import unittest

import numpy as np

import motus_native as native

DOWN = (0.0, 0.0, -9.81)


def shot(samples=3, links=3):
    """Return parents, times and poses of one chain along X that stands still for a second."""
    pose = [(0.5 * link, 0.0, 1.0) for link in range(links)]
    return [link - 1 for link in range(links)], np.linspace(0.0, 1.0, samples), np.tile(pose, (samples, 1, 1))


class StrandTest(unittest.TestCase):
    def test_places_over_time(self):
        parents, times, poses = shot()
        motion = native.StrandMotion(parents, times, poses, gravity=DOWN)
        self.assertEqual(len(motion), 3)
        self.assertFalse(motion.is_solved)
        self.assertFalse(motion.solve(100))
        self.assertGreater(motion.solved_until, 0.0)
        self.assertLess(motion.solved_until, 1.0)
        self.assertTrue(motion.solve())
        self.assertTrue(motion.is_solved)
        self.assertEqual(motion.solved_until, 1.0)
        self.assertEqual(motion.gap, 0.0)
        self.assertGreater(motion.nbytes, 1000)
        places = motion.places(0.25)
        self.assertEqual(places.shape, (3, 3))
        np.testing.assert_array_equal(places[0], poses[0, 0])
        self.assertLess(places[2, 2], 0.9)
        np.testing.assert_allclose(np.linalg.norm(np.diff(places, axis=0), axis=1), 0.5, atol=1e-6)
        np.testing.assert_array_equal(motion.places(0.0), poses[0])

    def test_a_number_is_that_of_all_links(self):
        parents, times, poses = shot()
        settings = {
            "mass": 2.0,
            "frequency": 1.5,
            "damping": 0.5,
            "response": 1.0,
            "drag": 0.3,
            "stretch": 0.1,
            "bend_frequency": 2.0,
            "bend": 1.0,
            "side_bend": 0.5,
            "thickness": 0.1,
        }
        one = native.StrandMotion(parents, times, poses, gravity=DOWN, **settings)
        each = native.StrandMotion(
            parents, times, poses, gravity=np.tile(DOWN, (3, 1)), **{name: np.full(3, number) for name, number in settings.items()}
        )
        one.solve()
        each.solve()
        np.testing.assert_array_equal(one.places(0.7), each.places(0.7))
        limp = native.StrandMotion(parents, times, poses, gravity=DOWN, obstacles=[], surfaces=[], pinned=[], resets=[])
        limp.solve()
        self.assertGreater(np.abs(limp.places(0.7) - one.places(0.7)).max(), 0.1)

    def test_obstacles_pins_wind_and_resets(self):
        parents, times, poses = shot()
        floor = np.tile([[(0.0, 0.0, 0.8), (0.0, 0.0, 1.8)], [(5.0, 0.0, 0.0), (5.0, 0.0, 0.0)]], (3, 1, 1, 1))
        held = {"obstacles": ["plane", "capsule"], "obstacle_places": floor, "radii": [0.0, 0.1], "friction": 0.2}
        lying = native.StrandMotion(parents, times, poses, gravity=DOWN, thickness=0.05, **held)
        lying.solve()
        self.assertGreater(lying.places(1.0)[1:, 2].min(), 0.849)
        pins = {"pinned": [2], "pin_places": poses[:, 2:] + (0.0, 0.5, 0.0), "pin_weights": 1.0}
        pinned = native.StrandMotion(parents, times, poses, gravity=DOWN, **pins)
        pinned.solve()
        np.testing.assert_allclose(pinned.places(1.0)[2], (1.0, 0.5, 1.0), atol=1e-12)
        blown = native.StrandMotion(parents, times, poses, drag=1.0, air=(0.0, 3.0, 0.0))
        blown.solve()
        self.assertGreater(blown.places(0.5)[2, 1], 0.1)
        anew = native.StrandMotion(parents, times, poses, gravity=DOWN, resets=[1])
        anew.solve()
        np.testing.assert_array_equal(anew.places(0.5), poses[0])

    def test_sides_and_links_that_touch(self):
        _, times, poses = shot(samples=49, links=6)
        poses[:, 3:] = poses[:, :3] + (0.0, 0.0, 0.5)  # a limp chain falls onto a stiff one
        parents = [-1, 0, 1, -1, 3, 4]
        stiff = np.array([5.0, 5.0, 5.0, 0.0, 0.0, 0.0])
        settings = {"gravity": DOWN, "frequency": stiff, "thickness": 0.1, "bend": 1.0, "side_bend": 0.1, "touching_friction": 0.2}
        moved = {}
        for name, changes in (
            ("alone", {}),
            ("touching", {"touching": True}),
            ("sides", {"sides": np.tile((0.0, 0.0, 1.0), (49, 6, 1))}),
        ):
            motion = native.StrandMotion(parents, times, poses, **settings | changes)
            motion.solve()
            moved[name] = motion.places(0.6)
        self.assertGreater(np.abs(moved["touching"] - moved["alone"]).max(), 1e-3)
        # It bends by a tenth of a radian alone towards its side, which is up in the pose.
        first, second = np.diff(moved["sides"][3:], axis=0)
        angle = np.arccos(first @ second / np.linalg.norm(first) / np.linalg.norm(second))
        self.assertLess(angle, 0.102)
        first, second = np.diff(moved["alone"][3:], axis=0)
        self.assertGreater(np.arccos(first @ second / np.linalg.norm(first) / np.linalg.norm(second)), 0.2)

    def test_a_surface(self):
        parents, times, poses = shot(samples=33)
        corners = np.array([(-9, -9, 0), (9, -9, 0), (-9, 9, 0), (9, 9, 0)], np.float32)
        surface = native.StrandSurface(corners, np.array([(0, 1, 2), (2, 1, 3)], np.int32))
        self.assertGreater(surface.nbytes, 0)
        placed = np.tile(np.eye(4), (33, 1, 1, 1))
        placed[:, 0, 2, 3] = np.linspace(0.5, 0.9, 33)
        settings = {"surfaces": [surface], "surface_matrices": placed, "surface_distances": 0.01, "surface_friction": [0.2]}
        lifted = native.StrandMotion(parents, times, poses, gravity=DOWN, thickness=0.05, **settings)
        lifted.solve()
        self.assertGreater(lifted.places(1.0)[1:, 2].min(), 0.955)
        for changes, problem in (
            ({"surfaces": [3]}, "surfaces"),
            ({"surface_matrices": placed[:, 0]}, "surface_matrices"),
            ({"surface_matrices": placed * (1.0, 2.0, 1.0, 1.0)}, "surface_matrices"),
            ({"surface_distances": [0.1, 0.2]}, "surface_distances"),
        ):
            with self.subTest(changes=list(changes)), self.assertRaisesRegex((TypeError, ValueError), problem):
                native.StrandMotion(parents, times, poses, **settings | changes)
        with self.assertRaisesRegex(ValueError, "triangles"):
            native.StrandSurface(corners, [(0, 1, 4)])

    def test_a_loop_closes(self):
        parents, times, poses = shot(samples=49)
        poses = poses + 0.1 * np.sin(2.0 * np.pi * times)[:, None, None]
        motion = native.StrandMotion(parents, times, poses, gravity=DOWN, drag=2.0, settle=1.0, loop=True)
        self.assertTrue(motion.solve())
        self.assertLess(motion.gap, 1e-4)
        np.testing.assert_allclose(motion.places(0.3), motion.places(3.3), atol=1e-9)

    def test_errors_name_the_argument(self):
        parents, times, poses = shot()
        for changes, problem in (
            ({"parents": [-1, 0]}, "poses"),
            ({"parents": [0, 0, 1]}, "parent"),
            ({"times": [0.0, 1.0, 1.0]}, "times"),
            ({"times": [[0.0]]}, "times"),
            ({"poses": poses[0]}, "poses"),
            ({"mass": 0.0}, "mass"),
            ({"mass": [1.0, 2.0]}, "mass"),
            ({"frequency": 100.0}, "frequency"),
            ({"bend": -1.0}, "bend"),
            ({"side_bend": 4.0}, "side_bend"),
            ({"sides": np.zeros((3, 2, 3))}, "sides"),
            ({"touching_friction": -1.0}, "friction"),
            ({"gravity": (0.0, 1.0)}, "gravity"),
            ({"gravity": np.zeros((2, 3))}, "gravity"),
            ({"obstacles": ["cube"]}, "obstacles"),
            ({"obstacles": ["plane"], "obstacle_places": np.zeros((3, 2, 3))}, "obstacle_places"),
            ({"obstacles": ["plane"], "obstacle_places": np.zeros((3, 1, 2, 3)), "radii": [1.0, 2.0]}, "radii"),
            ({"pinned": [1], "pin_places": np.zeros((3, 3))}, "pin_places"),
            ({"pinned": [1], "pin_places": np.zeros((3, 1, 3)), "pin_weights": [1.0]}, "pin_weights"),
            ({"pinned": [3], "pin_places": np.zeros((3, 1, 3))}, "pinned"),
            ({"resets": [0]}, "resets"),
            ({"rate": 1.0}, "rate"),
            ({"settle": float("nan")}, "settle"),
            ({"loop": True, "resets": [1]}, "resets"),
        ):
            with self.subTest(changes=list(changes)), self.assertRaisesRegex(ValueError, problem):
                native.StrandMotion(**{"parents": parents, "times": times, "poses": poses} | changes)
        for changes, problem in (({"parents": "x"}, "parents"), ({"loop": 1}, "loop"), ({"obstacles": 3}, "obstacles")):
            with self.subTest(changes=list(changes)), self.assertRaisesRegex((TypeError, ValueError), problem):
                native.StrandMotion(**{"parents": parents, "times": times, "poses": poses} | changes)
        motion = native.StrandMotion(parents, times, poses)
        for call, problem in ((lambda: motion.solve(-1), "steps"), (lambda: motion.places(float("inf")), "time")):
            with self.assertRaisesRegex(ValueError, problem):
                call()


if __name__ == "__main__":
    unittest.main()
