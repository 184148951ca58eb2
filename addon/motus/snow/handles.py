"""Handles of an emitter in the viewport: what each of them sets, where it stands, and what taking it elsewhere means."""

import math
from typing import Any, NamedTuple

from mathutils import Vector

from ..core.lazy import numpy as np

RADIUS, ANGLE, SPEED = "cone_radius", "cone_angle", "start_speed"
"""The settings."""
SECONDS = 0.5
"""The arrow is as long as a flake's way in so much time."""
LEAST_RAY = 0.5
"""m, of the line by which flakes leave a cone's edge."""
NEAR = 11.0
"""Pixels, at the interface's normal size: so near to a handle the mouse is on it."""


class Handle(NamedTuple):
    """setting: its name. place: in the emitter's space."""

    setting: str
    place: Any


def leans(settings):
    """Whether the setting Cone Angle has an effect: the shape is a cone, or Random Orientation is on."""
    return settings.shape == 'CONE' or settings.random_orientation


def ray(settings):
    """(start, end) of the line by which flakes leave at the edge, on the emitter's +X side."""
    angle, start = settings.cone_angle, np.array((settings.cone_radius, 0.0, 0.0))
    return start, start + max(settings.cone_radius, LEAST_RAY) * np.array((math.sin(angle), 0.0, math.cos(angle)))


def of(settings):
    """The handles of an emitter."""
    if settings.shape in {'SURFACE', 'CAMERA'}:
        return []
    # On the other side of the middle than the ray.
    found = [
        Handle(RADIUS, np.array((-settings.cone_radius, 0.0, 0.0))),
        Handle(SPEED, np.array((0.0, 0.0, SECONDS * settings.start_speed))),
    ]
    if leans(settings):
        found.append(Handle(ANGLE, ray(settings)[1]))
    return found


def value(settings, setting, place):
    """Value of a setting after its handle was dragged to a place in the emitter's space."""
    place = Vector(place)
    if setting == RADIUS:
        if settings.shape in {'SQUARE', 'DISC', 'CONE'}:  # which are flat
            place.z = 0.0
        return max(map(abs, place)) if settings.shape in {'SQUARE', 'BOX'} else place.length
    if setting == SPEED:
        return max(0.0, place.z) / SECONDS
    along = place - Vector(ray(settings)[0])
    return min(max(math.atan2(along.x, along.z), 0.0), math.pi) if along.length > 1e-9 else settings.cone_angle
