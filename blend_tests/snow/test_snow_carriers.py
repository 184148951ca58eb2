"""Colliders that move in a known way: flakes land on them when both are there, and are carried along."""

import math

import bpy
import numpy as np

import support
from snow.snow_cases import OFF_THE_FRAMES, flakes, seconds, state
from snow.test_snow_landing import LandingCase
from support import go_to, key, key_places


class Carried(LandingCase):
    def sledge(self):
        """A board that goes along X and up, at 2 m/s and 0.5 m/s, and what flakes there are over it."""
        sledge = self.board("Sledge", (0.0, 0.0, 0.0))
        key_places(sledge, {1: (-3.0, 0.0, 0.0), 97: (5.0, 0.0, 2.0)})
        for each in support.addon("core.blender.actions").all_fcurves(sledge.animation_data.action):
            for curve in each:
                for point in curve.keyframe_points:
                    point.interpolation = 'LINEAR'
        sledge.update_tag()
        return sledge, self.add(collider="Sledge", emitter_radius=3.0, rate=300.0)

    def test_flakes_ride_along(self):
        sledge, emitter = self.sledge()
        go_to(60)
        self.assertEqual(self.sentence(emitter), "")
        before, place = flakes(emitter), sledge.matrix_world.translation.copy()
        go_to(70)
        after, way = flakes(emitter), np.array(sledge.matrix_world.translation - place)
        rides = (np.abs(before["position"][:, 2] - place.z) < 1e-4) & (np.abs(before["velocity"] - (2.0, 0.0, 0.5)).max(axis=1) < 1e-3)
        self.assertGreater(np.count_nonzero(rides), 40)
        later = dict(zip(after["id"].tolist(), after["position"]))
        for number, was in zip(before["id"][rides].tolist(), before["position"][rides]):
            np.testing.assert_allclose(later[number], was + way, atol=1e-4)
        # Each has landed when the board came to where it was: 3 m - 2 m/s age = 0.5 m/s time.
        for number, was in zip(before["id"][rides].tolist(), before["position"][rides]):
            born = (number + 1) / 300.0
            landed = (3.0 + 2.0 * born) / 2.5
            self.assertLessEqual(landed, seconds(60) + 1e-3)
            middle = -3.0 + 2.0 * landed
            self.assertLess(abs(was[0] - 2.0 * (seconds(60) - landed) - middle), 2.0 + 1e-3)

    def test_any_frame_in_any_order(self):
        _, emitter = self.sledge()
        emitter.motus.snow.use_steering = True
        key(emitter, "location", {1: (0.0, 0.0, 3.0), 80: (2.0, 0.0, 3.0)})
        found = {}
        for _ in range(2):
            for frame in OFF_THE_FRAMES:
                go_to(frame)
                self.assertEqual(found.setdefault(frame, state(emitter)), state(emitter), frame)
        support.addon("snow.flakes")._snows.clear()
        go_to(60)
        self.assertEqual(state(emitter), found[60])

    def test_what_turns_and_hangs_on_something(self):
        wheel = support.link("Wheel")
        board = self.board("Board", (0.0, 0.0, 1.0))
        board.parent = wheel
        for frame, angle in ((1, 0.0), (97, 2.0 * math.pi)):
            wheel.rotation_euler.z = angle
            wheel.keyframe_insert("rotation_euler", frame=frame)
        emitter = self.add(collider="Board")
        go_to(70)
        self.assertEqual(self.sentence(emitter), "")
        before, matrix = flakes(emitter), np.array(board.matrix_world)
        go_to(72)
        after = dict(zip(flakes(emitter)["id"].tolist(), flakes(emitter)["position"]))
        turn = np.array(board.matrix_world) @ np.linalg.inv(matrix)
        rides = np.abs(before["position"][:, 2] - 1.0) < 1e-4
        count = 0
        for number, was in zip(before["id"][rides].tolist(), before["position"][rides]):
            if number in after and abs(after[number][2] - 1.0) < 1e-4:
                count += 1
                np.testing.assert_allclose(after[number], (turn @ np.append(was, 1.0))[:3], atol=2e-3)
        self.assertGreater(count, 20)

    def test_in_a_loop(self):
        board = self.board("Board", (0.0, 0.0, 0.0))
        key_places(board, {1: (0.0, 0.0, 0.0), 25: (2.0, 0.0, 0.5), 49: (0.0, 0.0, 0.0)})
        emitter = self.add(collider="Board", use_loop=True, loop_start=1, loop_end=49)
        for frame in (10, 33.5):
            go_to(frame)
            first = flakes(emitter)
            go_to(frame + 96)
            self.assertEqual(flakes(emitter)["position"].tobytes(), first["position"].tobytes())
        self.assertGreater(np.count_nonzero(np.abs(first["velocity"][:, 0]) > 0.1), 10)
        self.assertEqual(self.sentence(emitter), "")

    def test_with_another_that_is_gone_or_stands(self):
        sledge, emitter = self.sledge()
        floor = self.board("Floor", (0.0, 0.0, -1.0), (20.0, 20.0))
        emitter.motus.snow.more_colliders.add().object = floor
        bpy.ops.motus.refresh(object=emitter.name)
        go_to(80)
        self.assertGreater(self.lying(emitter, -1.0), 20)
        height = sledge.matrix_world.translation.z
        self.assertGreater(np.count_nonzero(np.abs(flakes(emitter)["position"][:, 2] - height) < 1e-4), 20)
        sledge.data.clear_geometry()
        self.assertGreater(self.lying(emitter, -1.0), 20)
