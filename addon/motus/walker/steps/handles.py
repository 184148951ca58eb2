"""Handles of a walker's steps in the viewport: where they are, and which one is under the mouse."""

from typing import Any, NamedTuple

from mathutils import Quaternion, Vector

from ...core.interface.view import drawing
from ...core.lazy import numpy as np
from ...core.measures import axes, scene_time
from ...core.refusals import Refused
from . import chosen

SECONDS = 2.0
"""Seconds before and after the present frame within which steps have handles."""
ARM = 0.5
"""Distance of the handle that turns a foot from the handle that moves it, as a share of the stride."""
NEAR = 11.0
"""Distance, in pixels at a Resolution Scale of 1, within which the mouse picks a handle."""


class Handle(NamedTuple):
    """A handle of a step. step: chosen.Step. turns: whether it turns the foot; else it moves the foot. place: (3,), in the world."""

    step: Any
    turns: bool
    place: Any


def of(context, owner):
    """List the Handles of a walker's steps about the present frame; [] if it does not walk. owner: original object that walks."""
    try:
        now = scene_time.seconds(context.scene, scene_time.present(context.scene))
        found = chosen.near(context, owner, now, SECONDS)
    except Refused:
        return []
    space, settings = chosen.space(context, owner), owner.motus.walker
    arm = ARM * settings.stride * abs(owner.matrix_world.median_scale)
    ahead = Vector(axes.vector(settings.forward_axis))
    handles = []
    for step in found:
        end = Vector(step.end)
        handles.append(Handle(step, False, space @ end))
        if settings.use_soles:
            handles.append(Handle(step, True, space @ (end + arm * (Quaternion(step.turn) @ ahead))))
    return handles


def seen(region, matrix, handles):
    """List (Handle, its place in the region in pixels) of the handles in front of the viewer. matrix: perspective matrix of the view."""
    found = []
    for handle in handles:
        place = drawing.project(matrix, np.array(handle.place)[None])
        if place is not None:
            found.append((handle, (place[0] + 1.0) * (region.width / 2.0, region.height / 2.0)))
    return found


def pick(context, owner, region, matrix, mouse):
    """Return (Handle, its place in the region) of the handle nearest to the mouse; None if the mouse is near none.

    mouse: place in the region, pixels. matrix: perspective matrix of the view.
    """
    near = NEAR * context.preferences.system.ui_scale
    distances = [
        (float(np.hypot(*(place - np.array(mouse[:2])))), handle, place) for handle, place in seen(region, matrix, of(context, owner))
    ]
    best = min(distances, key=lambda one: one[0], default=None)
    return best[1:] if best is not None and best[0] <= near else None


def angle(step, settings, place):
    """Angle by which a foot turns if the handle of a step that turns it is dragged to a place, in the plan's space.

    It is measured about the ground's normal, from the turn of the step, rad.
    """
    back = Quaternion(step.turn).inverted() @ (Vector(place) - Vector(step.end))
    ahead, up = Vector(axes.vector(settings.forward_axis)), Vector(axes.vector(settings.up_axis))
    return float(np.arctan2(back.dot(up.cross(ahead)), back.dot(ahead)))
