"""Handing a file over, and comparing what a Blender without the add-on shows of the result with what this one shows of the original."""

import bpy
import numpy as np

import support
from hand_over import plain_state

LAST = 25
"""Last frame that is handed over: a second of the motions, each of whose frames takes four evaluations of the scene or more."""
WHOLE = (1, 4, 9, 13, 18, 22, LAST)
PARTS = (2.5, 10.3, 11.9, 15.5, 20.7)
FRAMES = WHOLE + PARTS
EXACT = 1e-5
"""Largest difference on whole frames, in metres."""
SHARE = 1e-3
"""Largest difference between frames, as a share of how far the thing moves."""
MOST, SIDES = 300, 8
READS = """
import bpy
from hand_over import plain_state
bpy.ops.wm.open_mainfile(filepath={path!r})
plain_state.store({out!r}, {frames!r})
if {picture!r}:
    plain_state.picture({picture!r}, {shown!r})
"""
SHOWN = 20
"""Frame that is rendered."""


def states_without(folder, path, picture=""):
    """(states, leftovers) of a file that a fresh Blender opens without the add-on, as plain_state finds them. picture: file to render into."""
    out = str(folder / "states.pickle")
    status, output = support.run_beside(READS.format(path=str(path), out=out, frames=FRAMES, picture=picture, shown=SHOWN), enabled=False)
    if status:
        raise AssertionError(output)
    return plain_state.stored(out)


def differences(expected, found):
    """Sentences about what differs by more than it may; of FRAMES the first are whole ones."""
    said = [f"{name} is gone" for name in expected if name not in found]
    for name, rows in expected.items():
        motion, measure = _extent(rows), _error_of_points if name.startswith("points") else _error
        for index, (row, other) in enumerate(zip(rows, found.get(name, ()))):
            error = measure(row, other)
            if error > (EXACT if index < len(WHOLE) else max(EXACT, SHARE * motion)):
                said.append(f"{name} is {error:.2g} off in state {index}, of {motion:.3g}")
    return said


def _extent(rows):
    """How far something moves: the largest distance of a number from its value at the first frame; of changing points their extent."""
    if len({row.shape for row in rows}) == 1:
        return max(np.abs(row - rows[0]).max(initial=0.0) for row in rows)
    return np.ptp(np.concatenate(rows), axis=0).max(initial=0.0)


def _error(row, other):
    if row.shape == other.shape:
        return np.abs(row - other).max(initial=0.0)
    return _error_of_tubes(row, other)


def _error_of_points(row, other):
    """Largest distance of a point from the nearest one, since handed-over points have another order."""
    if len(row) and len(other) == 0:
        return np.inf
    return max((np.linalg.norm(other[:, :3] - point[:3], axis=1).min() for point in row[:: max(1, len(row) // MOST)]), default=0.0)


def _error_of_tubes(row, other):
    """Largest distance of a vertex from the tubes with the other vertices, which may have another number of rings of SIDES each."""
    first, along = other[:-SIDES], other[SIDES:] - other[:-SIDES]
    lengths = np.maximum((along * along).sum(axis=1), 1e-30)
    away = row[:: max(1, len(row) // MOST), None] - first
    at = np.clip(np.einsum("psk,sk->ps", away, along) / lengths, 0.0, 1.0)
    away -= at[..., None] * along
    return np.sqrt(np.einsum("psk,psk->ps", away, away)).min(axis=1).max(initial=0.0)


def handed_over(test, start=1, end=LAST, **keywords):
    """Hands the open file over into a test's folder; returns the path."""
    path = test.folder / "out.blend"
    test.assertEqual(bpy.ops.motus.hand_over(filepath=str(path), start=start, end=end, **keywords), {'FINISHED'})
    return path
