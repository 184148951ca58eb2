"""Meshes for the tests."""

import numpy as np


def grid(count=21, size=2.0):
    """(positions, triangles, edges) of a flat square of count x count vertices around the origin."""
    axis = np.linspace(-size / 2, size / 2, count)
    x, y = np.meshgrid(axis, axis)
    positions = np.stack([x.ravel(), y.ravel(), np.zeros(count * count)], axis=1).astype(np.float32)
    numbers = np.arange(count * count).reshape(count, count)
    a, b, c, d = (n.ravel() for n in (numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, :-1], numbers[1:, 1:]))
    triangles = np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)]).astype(np.int32)
    rows = np.stack([numbers[:, :-1].ravel(), numbers[:, 1:].ravel()], 1)
    columns = np.stack([numbers[:-1].ravel(), numbers[1:].ravel()], 1)
    return positions, triangles, np.concatenate([rows, columns]).astype(np.int32)


def folded_sheet():
    """(positions, triangles) of a sheet folded in two: 0.05 apart in space, far apart along the surface."""
    positions, triangles, _ = grid(41)
    folded = positions.copy()
    over = positions[:, 0] > 0.0
    folded[over, 0] = -positions[over, 0]
    folded[over, 2] = 0.05
    return folded, triangles
