"""Turns that are taken out of matrices, and quaternions of turns."""

import unittest

import numpy as np
from mathutils import Euler

import support

rotations = support.addon("core.tracks.rotations")


class RotationsTest(unittest.TestCase):
    def test_quaternions_of_all_turns(self):
        numbers = np.random.default_rng(1)
        turns = rotations.unit(numbers.normal(size=(500, 4)))
        turns[:4] = np.eye(4)  # none, and half a turn about each axis
        turns[4:8] = rotations.unit(np.eye(4) + 1e-9)
        matrices = np.tile(np.eye(4), (500, 1, 1))
        matrices[:, :3, :3] = rotations.matrices(turns)
        found = rotations.of_rigid(matrices)
        found *= np.sign((found * turns).sum(axis=1, keepdims=True))
        np.testing.assert_allclose(found, turns, atol=1e-12)

    def test_what_turns_and_moves_alone_stays_as_it_is(self):
        matrix = np.array(Euler((0.3, -2.0, 1.1)).to_matrix().to_4x4())[None]
        matrix[0, :3, 3] = 1.0, 2.0, 3.0
        np.testing.assert_allclose(rotations.rigid(matrix), matrix, atol=1e-6)
        np.testing.assert_allclose(rotations.rigid(matrix * (5.0, 5.0, 5.0, 1.0)), matrix, atol=1e-6)

    def test_scale_shear_and_mirrors_are_taken_out(self):
        numbers = np.random.default_rng(2)
        matrices = np.tile(np.eye(4), (100, 1, 1))
        matrices[:, :3] = numbers.normal(size=(100, 3, 4))
        matrices[0, :3, :3] = 0.0  # scaled to nothing
        matrices[1, :3, 0] = 0.0
        matrices[2, :3, 1] = 0.0
        matrices[3, :3, 1] = -2.0 * matrices[3, :3, 0]
        found = rotations.rigid(matrices)
        axes = found[:, :3, :3]
        np.testing.assert_allclose(axes @ np.swapaxes(axes, 1, 2), np.broadcast_to(np.eye(3), axes.shape), atol=1e-9)
        np.testing.assert_allclose(np.linalg.det(axes), 1.0, atol=1e-9)
        np.testing.assert_array_equal(found[:, :, 3], matrices[:, :, 3])
        along = matrices[4:, :3, 0] / np.linalg.norm(matrices[4:, :3, 0], axis=1, keepdims=True)
        np.testing.assert_allclose(axes[4:, :, 0], along, atol=1e-12)
