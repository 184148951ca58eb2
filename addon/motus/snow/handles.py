"""Handles of an emitter in the viewport: the setting of each handle, its place, and the setting's value after a drag."""

import math
from typing import Any, NamedTuple

from mathutils import Vector

from ..core.lazy import numpy as np

RADIUS, ANGLE, SPEED = "emitter_radius", "cone_angle", "start_speed"
"""Names of the settings that handles set."""
SECONDS = 0.5
"""Time, in seconds: the arrow of an emitter is as long as the way of a flake, at Speed, in this time."""
LEAST_RAY = 0.5
"""Smallest length, in metres, of the line that shows the direction of flakes at the edge of a cone."""
NEAR = 11.0
"""Distance, in pixels at a Resolution Scale of 1, within which the mouse picks a handle."""


class Handle(NamedTuple):
    """A handle of an emitter. setting: name of the setting that it sets. place: (3,), in the emitter's space."""

    setting: str
    place: Any


def leans(settings):
    """Whether the setting Cone Angle has an effect: the shape is a cone, or Random Orientation is on."""
    return settings.shape == 'CONE' or settings.random_orientation


def ray(settings):
    """Return (start, end) of the line that shows in which direction flakes leave the edge on the +X side, in the emitter's space."""
    angle, start = settings.cone_angle, np.array((settings.emitter_radius, 0.0, 0.0))
    return start, start + max(settings.emitter_radius, LEAST_RAY) * np.array((math.sin(angle), 0.0, math.cos(angle)))


def of(settings):
    """List the Handles of an emitter; [] if a mesh or a camera's view emits the flakes. settings: of the emitter."""
    if settings.shape in {'SURFACE', 'CAMERA'}:
        return []
    # The handle of the radius is on the -X side, as the handle of the angle is on the +X side.
    found = [
        Handle(RADIUS, np.array((-settings.emitter_radius, 0.0, 0.0))),
        Handle(SPEED, np.array((0.0, 0.0, SECONDS * settings.start_speed))),
    ]
    if leans(settings):
        found.append(Handle(ANGLE, ray(settings)[1]))
    return found


def value(settings, setting, place):
    """Value of a setting after its handle was dragged to a place in the emitter's space."""
    place = Vector(place)
    if setting == RADIUS:
        if settings.shape in {'SQUARE', 'DISC', 'CONE'}:  # flat shapes
            place.z = 0.0
        return max(map(abs, place)) if settings.shape in {'SQUARE', 'BOX'} else place.length
    if setting == SPEED:
        return max(0.0, place.z) / SECONDS
    along = place - Vector(ray(settings)[0])
    return min(max(math.atan2(along.x, along.z), 0.0), math.pi) if along.length > 1e-9 else settings.cone_angle
