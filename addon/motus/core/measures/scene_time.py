"""The scene's time: frames of the time line, the keys' time in which Blender evaluates F-curves, and seconds.

With Time Stretching (Format > Time Stretching) Blender evaluates F-curves, strips and drivers at the frame of the time line, fraction
included, times Old / New. The result of this product is the keys' time. All frames in settings and in Context.frame are in the keys' time.
Blender's frame range, the current frame and scene.frame_set() are in frames of the time line.
"""

from __future__ import annotations

from typing import Any

import bpy


def fps(scene: bpy.types.Scene) -> float:
    """Frames per second of the scene, in the keys' time: the frames after Time Stretching, at which Blender evaluates F-curves."""
    return scene.render.fps / scene.render.fps_base


def seconds(scene: bpy.types.Scene, times: Any) -> Any:
    """Convert frames of the keys' time (after Time Stretching) to seconds. times: a number or an array."""
    return times * (scene.render.fps_base / scene.render.fps)


def keys_time(scene: bpy.types.Scene, frame: float) -> float:
    """Convert a frame of the time line to the keys' time: the frame after Time Stretching, at which Blender evaluates F-curves."""
    return frame * scene.render.frame_map_old / scene.render.frame_map_new


def time_line(scene: bpy.types.Scene, time: float) -> float:
    """Convert a frame of the keys' time (after Time Stretching) to the frame of the time line that shows it."""
    return time * scene.render.frame_map_new / scene.render.frame_map_old


def present(scene: bpy.types.Scene) -> float:
    """The scene's current frame in the keys' time: after Time Stretching, at which Blender evaluates F-curves."""
    return scene.frame_current_final


def first(scene: bpy.types.Scene) -> float:
    """The scene's first frame in the keys' time: after Time Stretching, at which Blender evaluates F-curves."""
    return keys_time(scene, scene.frame_start)


def beginning(scene: bpy.types.Scene) -> float:
    """The frame, in the keys' time (after Time Stretching), at which a new motion begins: the scene's first frame.

    If the scene begins at frame 1 of the time line, the motion begins at 1 whatever the Time Stretching is.
    """
    return 1.0 if scene.frame_start == 1 else first(scene)


def last(scene: bpy.types.Scene) -> float:
    """The scene's last frame in the keys' time: after Time Stretching, at which Blender evaluates F-curves."""
    return keys_time(scene, scene.frame_end)


def stamp(scene: bpy.types.Scene) -> tuple[float, float, float]:
    """A tuple that changes with the scene's frame rate and with its first frame in the keys' time (after Time Stretching)."""
    return scene.render.fps, scene.render.fps_base, first(scene)
