"""A system that makes a surface, for the tests of the wiring: a square at a target, divided otherwise on each frame."""

import dataclasses

import numpy as np

import support
import toy_points_system as sparks

core = support.addon("core.declare")


def sheet(frame, origin):
    """Positions, edges, triangles and their sides of a square that has other cells on each frame."""
    cells = 2 + int(frame) % 4
    x, y = (places.ravel() / cells for places in np.meshgrid(np.arange(cells + 1), np.arange(cells + 1)))
    positions = origin + np.stack((x, y, 0.1 * frame * x * y), axis=1)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    triangles = np.concatenate(
        (np.stack((corner, corner + 1, corner + cells + 2), axis=1), np.stack((corner, corner + cells + 2, corner + cells + 1), axis=1))
    )
    ends = np.sort(np.stack((triangles, np.roll(triangles, -1, axis=1)), axis=2).reshape(-1, 2), axis=1)
    edges, sides = np.unique(ends, axis=0, return_inverse=True)
    return positions.astype(np.float32), edges, triangles, sides.reshape(-1, 3)


def solve_sheet(context, target, rate, lifetime):
    if rate <= 0.0:
        return sparks.NO_RATE
    found = sheet(context.frame, np.array(target.translation) if target else np.zeros(3))
    room = context.points(int(rate) if rate > 1e5 else len(found[0]), len(found[1]), len(found[2]))
    for name, array in zip(("position", "edges", "triangles", "sides"), found):
        room[name][:] = array[: len(room[name])]
    room["age"][:] = lifetime
    return core.OK


SHEET = dataclasses.replace(
    sparks.TRAILS,
    name="sheet",
    label="Sheet",
    solve=solve_sheet,
    makes_points=core.Points(attributes=(("age", 'FLOAT'),), shape='FACES', capacity=100_000),
)
