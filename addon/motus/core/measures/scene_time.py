"""The scene's time: frames of the time line, the keys' time that the scene is evaluated in, and seconds.

With Time Stretching (Format > Time Stretching) Blender evaluates F-curves, strips and drivers at the frame of the time line,
fraction included, times Old / New. That is the keys' time: all frames in settings and in Context.frame are of it. Blender's frame range,
the current frame and scene.frame_set() are of the time line.
"""

from __future__ import annotations

from typing import Any

import bpy


def fps(scene: bpy.types.Scene) -> float:
    """Frames in a second of the keys' time."""
    return scene.render.fps / scene.render.fps_base


def seconds(scene: bpy.types.Scene, times: Any) -> Any:
    """Seconds of the keys' time, a number or an array."""
    return times * (scene.render.fps_base / scene.render.fps)


def keys_time(scene: bpy.types.Scene, frame: float) -> float:
    """The keys' time of a frame of the time line."""
    return frame * scene.render.frame_map_old / scene.render.frame_map_new


def time_line(scene: bpy.types.Scene, time: float) -> float:
    """The frame of the time line that shows this keys' time."""
    return time * scene.render.frame_map_new / scene.render.frame_map_old


def present(scene: bpy.types.Scene) -> float:
    """The keys' time that is shown."""
    return scene.frame_current_final


def first(scene: bpy.types.Scene) -> float:
    """The keys' time of the scene's first frame."""
    return keys_time(scene, scene.frame_start)


def beginning(scene: bpy.types.Scene) -> float:
    """The keys' time at which a motion begins that is set up newly: frame 1, or where the scene begins instead."""
    return 1.0 if scene.frame_start == 1 else first(scene)


def last(scene: bpy.types.Scene) -> float:
    """The keys' time of the scene's last frame."""
    return keys_time(scene, scene.frame_end)


def stamp(scene: bpy.types.Scene) -> tuple[float, float, float]:
    """Changes when seconds do, or the scene's first frame in the keys' time."""
    return scene.render.fps, scene.render.fps_base, first(scene)
