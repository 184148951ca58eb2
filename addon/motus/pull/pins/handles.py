"""Handles of pins: their positions in the viewport, and the handle under the mouse."""

from typing import Any, NamedTuple

from ...core import wiring
from ...core.lazy import numpy as np
from . import setup, solve, table

NEAR = 11.0
"""Largest distance of the mouse from a handle that it picks, in pixels at the interface's normal size."""


class Handles(NamedTuple):
    """Handles of the pins of an object, as arrays with one row for each pin that pulls at a vertex (its root).

    indices: of the pins in the list. places: world positions at which the user sees the roots, (n, 3). starts: world positions of the roots
    without their own pin, (n, 3). acts: whether each pin moves its root at present. is_broken: whether each pin has lost its root.
    """

    indices: Any
    places: Any
    starts: Any
    acts: Any
    is_broken: Any


def read(obj, depsgraph):
    """Return the Handles of a mesh object, as evaluated by the depsgraph."""
    evaluated = obj.evaluated_get(depsgraph)
    settings = evaluated.motus.pull
    pins = settings.pins
    places = table.numbers(pins, "place", 3).astype(float)
    ways = table.numbers(pins, "displacement", 3) * _shares(settings)
    indices = np.flatnonzero(
        np.isfinite(places).all(axis=1) & np.isfinite(ways).all(axis=1) & np.array([not pin.shape for pin in pins], bool)
    )
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
    """Factor on a pin's displacement at present: its strength, or 0 if it is muted, times the influence of all pins."""
    return float(_shares(obj.evaluated_get(depsgraph).motus.pull)[index, 0])


def pick(handles, region, matrix, mouse, near):
    """Row of the handle nearest to the mouse, if it is within `near` pixels; None if there is none.

    matrix: perspective matrix of the view. mouse: position in the region.
    """
    places, is_before = on_screen(handles.places, region, matrix)
    away = np.where(is_before, np.hypot(*(places - np.array(mouse[:2])).T), np.inf)
    return int(away.argmin()) if len(away) and away.min() <= near else None


def on_screen(points, region, matrix):
    """Project world positions (n, 3): returns (pixels in the region (n, 2), whether each position is in front of the viewer).

    matrix: perspective matrix of the view.
    """
    matrix = np.array(matrix)
    clipped = points @ matrix[:, :3].T + matrix[:, 3]
    is_before = clipped[:, 3] > 1e-6
    depths = np.where(is_before, clipped[:, 3], 1.0)[:, None]
    return (clipped[:, :2] / depths + 1.0) * (region.width / 2.0, region.height / 2.0), is_before


def _shares(settings):
    strengths = np.where(table.numbers(settings.pins, "is_muted", 1, bool), 0.0, table.numbers(settings.pins, "strength", 1))
    return strengths * settings.influence


def _seen(obj, evaluated, vertices):
    """Local positions at which the user sees vertices, (m, 3); None if modifiers change the number of vertices."""
    count = len(obj.data.vertices)
    mesh = evaluated.data
    if len(mesh.vertices) != count or not all(0 <= vertex < count for vertex in vertices):
        return None
    return np.array([mesh.vertices[vertex].co for vertex in vertices], float).reshape(-1, 3)


def _broken(obj, depsgraph, indices):
    """Whether each of these pins has lost its root, bool (m,). indices: of the pins."""
    found = np.zeros(len(indices), bool)
    if wiring.problem(setup.system(), obj, depsgraph) is None:
        return found
    for row, index in enumerate(indices):
        found[row] = wiring.output(setup.system(), obj, f"pin{index}", depsgraph) in (solve.LOST, solve.AMBIGUOUS)
    return found
