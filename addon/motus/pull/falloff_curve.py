"""The brush's falloff curve, as the user has drawn it (core/settings/drawn_curves.py)."""

from ..core.lazy import numpy as np
from ..core.settings import drawn_curves

CURVE_SAMPLES = 32
"""Number of forces that are sampled from the falloff curve, at equal steps from the radius to the pulled vertex."""

GROUP_NAME = ".Motus Falloff"
_BEGINNING = 0.0, 0.25, 0.5, 0.75, 1.0

node = drawn_curves.node


def ensure(brush):
    """Give the brush a curve with the falloff Smooth if it has none. Must not be called from draw()."""
    if node(brush) is None:
        drawn_curves.make(brush, GROUP_NAME, [(place, _smooth(place), "AUTO") for place in _BEGINNING])


def samples(brush, count=CURVE_SAMPLES):
    """Forces of the falloff curve at equal steps from the radius to the pulled vertex, float32 (count,).

    If no curve was created yet, the forces are those of the falloff Smooth, with which ensure() begins.
    """
    steps = np.linspace(0.0, 1.0, count)
    found = node(brush)
    return _smooth(steps).astype(np.float32) if found is None else drawn_curves.samples(found, steps)


def _smooth(t):
    return t * t * (3.0 - 2.0 * t)
