"""Write a setting of a stereo rig over a range of frames as few keys."""

import bpy

from ..core.animation import fitted_keys
from ..core.blender import actions
from ..core.lazy import numpy as np
from .rig import PREFIX


def ahead_keyword(description):
    """Declare the keyword that says how far ahead of their cause keyed settings change."""
    return bpy.props.IntProperty(name="Look Ahead", description=description, default=12, min=0, max=10000, soft_max=100)


def write(camera, name, times, values, tolerance, side):
    """Replace the keys of a setting from the first time to the last by few ones; returns their number.

    times: of the samples, as keys have them, rising. values: (n,). tolerance, side: as of fitted_keys.keys().
    """
    path, times = PREFIX + name, np.array(times)
    camera.keyframe_insert(path, frame=times[0])
    curve = actions.find(camera, path)
    for point in reversed([point for point in curve.keyframe_points if times[0] <= point.co.x <= times[-1]]):
        curve.keyframe_points.remove(point)
    others = len(curve.keyframe_points)
    fitted_keys.write(curve, times, np.array(values), tolerance, side)
    return len(curve.keyframe_points) - others


def show(scene):
    """Evaluate the scene's frame again, so that settings have the values of their new keys."""
    scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)
