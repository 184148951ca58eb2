"""Handles of pins: where they are in the viewport, and which of them lies under the mouse."""

from typing import Any, NamedTuple

from ...core import wiring
from ...core.lazy import numpy as np
from . import setup, solve, table

NEAR = 11.0
"""Pixels, at the interface's normal size: so near to a handle the mouse is on it."""


class Handles(NamedTuple):
    """Those of an object's pins that have a root, one a row.

    indices: of the pins. places: where the roots are seen, (n, 3) in the world. starts: where they would be without their own pin.
    acts: whether each pin pulls now. is_broken: whether it has lost its root.
    """

    indices: Any
    places: Any
    starts: Any
    acts: Any
    is_broken: Any


def read(obj, depsgraph):
    """The Handles of a mesh object as it is evaluated."""
    evaluated = obj.evaluated_get(depsgraph)
    settings = evaluated.motus.pull
    pins = settings.pins
    places = table.numbers(pins, "place", 3).astype(float)
    ways = table.numbers(pins, "displacement", 3) * _shares(settings)
    indices = np.flatnonzero(np.isfinite(places).all(axis=1) & np.isfinite(ways).all(axis=1) & np.array([not pin.shape for pin in pins], bool))
    places, ways = places[indices], ways[indices]
    broken = _broken(obj, depsgraph, indices.tolist())
    seen = _seen(obj, evaluated, table.numbers(pins, "vertex", 1, np.int32)[indices, 0].tolist())
    tips = places + ways if seen is None else seen
    tips[broken] = places[broken]
    ways[broken] = 0.0
    matrix = np.array(evaluated.matrix_world)
    tips, starts = (points @ matrix[:3, :3].T + matrix[:3, 3] for points in (tips, tips - ways))
    return Handles(indices, tips, starts, ways.any(axis=1), broken)


def share(obj, depsgraph, index):
    """How much of a pin's displacement acts now: its strength, if it is not muted, times the influence of all pins."""
    return float(_shares(obj.evaluated_get(depsgraph).motus.pull)[index, 0])


def pick(handles, region, matrix, mouse, near):
    """Row of the handle that is nearest to a place of the region, at most `near` pixels away; None without.

    matrix: the view's perspective matrix.
    """
    places, is_before = on_screen(handles.places, region, matrix)
    away = np.where(is_before, np.hypot(*(places - np.array(mouse[:2])).T), np.inf)
    return int(away.argmin()) if len(away) and away.min() <= near else None


def on_screen(points, region, matrix):
    """(places in the region, pixels (n, 2); whether each point lies before the viewer) of world points."""
    matrix = np.array(matrix)
    clipped = points @ matrix[:, :3].T + matrix[:, 3]
    is_before = clipped[:, 3] > 1e-6
    depths = np.where(is_before, clipped[:, 3], 1.0)[:, None]
    return (clipped[:, :2] / depths + 1.0) * (region.width / 2.0, region.height / 2.0), is_before


def _shares(settings):
    strengths = np.where(table.numbers(settings.pins, "is_muted", 1, bool), 0.0, table.numbers(settings.pins, "strength", 1))
    return strengths * settings.influence


def _seen(obj, evaluated, vertices):
    """Where vertices are seen, (m, 3) in the object; None where modifiers have made other vertices of these."""
    count = len(obj.data.vertices)
    mesh = evaluated.data
    if len(mesh.vertices) != count or not all(0 <= vertex < count for vertex in vertices):
        return None
    return np.array([mesh.vertices[vertex].co for vertex in vertices], float).reshape(-1, 3)


def _broken(obj, depsgraph, indices):
    """Which of these pins have lost their roots, bool (m,)."""
    found = np.zeros(len(indices), bool)
    if wiring.problem(setup.system(), obj, depsgraph) is None:
        return found
    for row, index in enumerate(indices):
        found[row] = wiring.output(setup.system(), obj, f"pin{index}", depsgraph) in (solve.LOST, solve.AMBIGUOUS)
    return found
