"""How the values of the tip are reached along a chain: by the power Tip Shape, or by a curve that the user draws."""

from ..core.lazy import numpy as np
from ..core.settings import drawn_curves

GROUP_NAME = ".Motus Chain Shape"
DRAWN = 0.0, 0.25, 0.5, 0.75, 1.0
"""Places of the points with which a curve begins, unless it is straight."""


def show(entry):
    """Bring the curve that an entry's settings name to its widget. Without one it begins as Tip Shape has it."""
    drawn_curves.show(entry, GROUP_NAME, _beginning(entry))


def take_over(owner):
    """Keep what the user has drawn in the curves of an owner's entries. This is the function System.take_over."""
    for entry in owner.motus.chains.entries:
        drawn_curves.take_over(entry, GROUP_NAME, _beginning(entry))


def shares(places, numbers):
    """Return how much of the tip's values is reached, (n,) from 0 to 1, at places (n,) along a chain, from 0 to 1.

    numbers: the entry, or what has its settings.
    """
    if not numbers.use_curve:
        return places**numbers.tip_shape
    values = np.clip(np.array(numbers.curve_values, float), 0.0, 1.0)
    return np.interp(places, np.linspace(0.0, 1.0, len(values)), values)


def _beginning(entry):
    if entry.tip_shape == 1.0:
        return drawn_curves.STRAIGHT
    return [(place, place**entry.tip_shape, "AUTO") for place in DRAWN]
