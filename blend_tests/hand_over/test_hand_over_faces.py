"""How many meshes lying snow is handed over as: one for each sample, one for each frame where these would be large, and none beyond a limit."""

from types import SimpleNamespace
from unittest import mock

import numpy as np

import support

PER_FRAME, SAMPLE = 4, {"position": np.zeros((100, 3), np.float32), "corners": np.zeros(300, np.int32)}
SIZE = 3 * sum(value.nbytes for value in SAMPLE.values())
"""Bytes of the mesh of one sample."""


class TestStride(support.SceneTestCase):
    def stride(self, large, largest):
        """Of eight samples, with limits in meshes."""
        faces = support.addon("hand_over.faces")
        made = SimpleNamespace(_samples=[SAMPLE] * 8, owner=SimpleNamespace(name="Roof"))
        with mock.patch.multiple(faces, LARGE=large * SIZE, LARGEST=largest * SIZE):
            return faces.Faces._stride(made, PER_FRAME)

    def test_as_many_meshes_as_have_room(self):
        self.assertEqual(self.stride(9, 20), 1)
        self.assertEqual(self.stride(5, 20), 2)
        self.assertEqual(self.stride(1, 3), PER_FRAME)

    def test_too_many(self):
        with self.assertRaisesRegex(support.addon("core.refusals").Refused, "Roof would be too large"):
            self.stride(1, 2)
