"""Solver of a stereo rig: declares its inputs, and computes the distances of the camera's eyes."""

import math

from ..core import native
from ..core.declare import Matrix, OwnMatrix, Problem
from . import around, lens, rig

NOT_PERSPECTIVE = Problem("The rig needs a perspective camera: with this one the camera's own values count")
NO_LENS = Problem("Focal length and sensor must be greater than 0")
NO_FOCUS = Problem("Choose the object that lies on the screen")
BEHIND = Problem("The object that shall lie on the screen is at the camera or behind it")
BAD_RANGE = Problem("Near must be greater than 0, and far greater than near")
NO_BUDGET = Problem("Near and far parallax are both 0: there is no depth to spend")
NOT_FINITE = Problem("A setting is not a finite number")
NOT_CENTRED = Problem("The camera's pivot is not the centre: one eye stands where the camera does", blocking=False)
PROBLEMS = (NOT_PERSPECTIVE, NO_LENS, NO_FOCUS, BEHIND, BAD_RANGE, NO_BUDGET, NOT_FINITE, NOT_CENTRED)
INPUTS = (OwnMatrix("matrix"), Matrix("focus", of="focus"))
PERCENT = 0.01


def solve(context, matrix, focus):
    """Compute the interocular and convergence distance at the context's frame, and write them into context.outputs.

    matrix: world matrix of the camera. focus: world matrix of the focus object, or None. Returns a Problem or None; a user's error never
    raises an exception.
    """
    settings, camera = context.settings, context.owner.data
    if around.is_used(camera):
        return _around(context, matrix, focus)
    if camera.type != 'PERSP':
        return NOT_PERSPECTIVE
    seen = lens.of(camera, context.depsgraph.scene.render, context.frame)
    if not (math.isfinite(seen.focal_length) and seen.focal_length > 0.0 and seen.sensor_width > 0.0):
        return NO_LENS
    mode = camera.stereo.convergence_mode
    if settings.convergence == 'BUDGET':
        found = _by_budget(settings, seen, mode)
    else:
        found = _by_distance(settings, matrix, focus)
    if isinstance(found, Problem):
        return found
    interocular, distance = found
    factor = seen.off_axis if mode == 'OFFAXIS' else 1.0
    context.outputs[:] = interocular, distance * factor
    return None if camera.stereo.pivot == rig.CENTRE else NOT_CENTRED


def _around(context, matrix, focus):
    """Compute the eye distances of a panoramic camera that renders spherical stereo; returns a Problem or None.

    Its image has no width that parallax could be a fraction of. So a depth budget is a Problem.
    """
    if context.settings.convergence == 'BUDGET':
        return NOT_PERSPECTIVE
    found = _by_distance(context.settings, matrix, focus)
    if isinstance(found, Problem):
        return found
    context.outputs[:] = found
    return None


def _by_distance(settings, matrix, focus):
    """Return (interocular, convergence) distance by a fixed distance or the focus object; a Problem if the values are invalid."""
    if settings.convergence == 'OBJECT':
        if focus is None or matrix is None:
            return NO_FOCUS
        distance = depth_of(matrix, focus.translation)
    else:
        distance = settings.distance
    if not (math.isfinite(distance) and math.isfinite(settings.interocular)):
        return NOT_FINITE
    return (settings.interocular, distance) if distance > 0.0 else BEHIND


def _by_budget(settings, seen, mode):
    """Return (interocular, convergence) distance by the depths near and far and their parallax; a Problem if these are invalid."""
    near, far = settings.near, settings.far
    limits = PERCENT * settings.near_parallax, PERCENT * settings.far_parallax
    if not all(map(math.isfinite, (near, far, *limits))):
        return NOT_FINITE
    if not 0.0 < near < far:
        return BAD_RANGE
    if mode == 'PARALLEL':
        # Everything is in front of the screen, so that only the near limit counts.
        return (limits[0] * near * seen.sensor_width / seen.focal_length, far) if limits[0] > 0.0 else NO_BUDGET
    if not sum(limits) > 0.0:
        return NO_BUDGET
    return native.module.solve_depth_budget(near, far, *limits, seen.focal_length, seen.sensor_width)


def depth_of(matrix, place):
    """Depth of a world position in front of a camera with this world matrix, along the view axis; negative behind the camera."""
    return -(rig.axis_matrix(matrix).to_3x3() @ (place - matrix.translation)).z
