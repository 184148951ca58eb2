"""Depth budget: how much parallax (horizontal offset between the two images) is comfortable on a screen."""

import math

from ..core import native

MOST = 0.01, 0.02
"""Parallax (in front of the screen, behind it) that is large on any screen, as fractions of the image width."""
SHOWN = 1e-4
"""Resolution of the parallax settings, as a fraction of the image width: the settings are percents with two decimals."""


def parallaxes(near, far, lens, screen):
    """Parallax limits (in front of the screen, behind it) for depths from near to far, in percent of the image width.

    The limits are comfortable for viewers, and small enough that depth looks no rounder than it is.
    lens: a lens.Lens. screen: keyword arguments of the native functions, from screens.of().
    """
    call = native.module
    limits = [min(most, limit) for most, limit in zip(MOST, call.comfortable_parallax(**screen))]
    behind = {"focal_length": lens.focal_length, "sensor_width": lens.sensor_width}
    interaxial, convergence = call.solve_depth_budget(near, far, *limits, **behind)
    deep = max(1.0, call.roundness(convergence, interaxial=interaxial, convergence=convergence, **behind, **screen))
    return [100.0 * SHOWN * max(1, math.floor(limit / deep / SHOWN)) for limit in limits]
