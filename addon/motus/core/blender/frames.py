"""Go to frames of the scene, restore the scene and changed values afterwards, and write frames as text."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable
from contextlib import suppress
from typing import Any

import bpy

from ..translations import tr
from . import actions


def ranges(frames: Iterable[float], step: float) -> str:
    """Frames as text, such as "1-5, 8": frames that follow one another at a distance of `step` are written as a range."""
    runs: list[list[float]] = []
    for frame in frames:
        if runs and abs(frame - runs[-1][1] - step) < 1e-6:
            runs[-1][1] = frame
        else:
            runs.append([frame, frame])
    return ", ".join(as_text(first) if first == last else f"{as_text(first)}-{as_text(last)}" for first, last in runs)


def spoken(text: str) -> str:
    """Text of ranges() with the word "frame" or "frames" before it, in the user's language."""
    is_one = "," not in text and "-" not in text[1:]
    return (tr("frame {frames}") if is_one else tr("frames {frames}")).format(frames=text)


def as_text(frame: float) -> str:
    """A frame as text: rounded to a thousandth, and without an exponent."""
    return f"{round(frame, 3):.12g}"


class Kept:
    """Stored state of a scene: its frame, its camera, and values of animated properties of some objects.

    The state is stored when Kept is created. The values include changes that the user has not keyed.
    """

    def __init__(self, scene: Any, objects: Iterable[Any] = ()) -> None:
        self._scene = scene
        self._frame = scene.frame_current, scene.frame_subframe
        self._camera = scene.camera
        self._values = {(obj, path): value for obj in objects for path, value in _animated(obj).items()}

    def restore(self, written: Container[tuple[Any, str]] = ()) -> None:
        """Go back to the stored frame; set the camera and the animated properties to the stored values.

        written: (object, data path) of properties that have new keys since then. They keep the values of their keys.
        """
        whole, part = self._frame
        self._scene.frame_set(whole, subframe=part)
        # Markers choose the camera at each frame. The scene may have had a different camera than the marker's at the kept frame.
        if self._scene.camera != self._camera:
            with suppress(ReferenceError):  # if the camera was removed meanwhile
                self._scene.camera = self._camera
        for obj in dict.fromkeys(obj for obj, _ in self._values):
            for path, now in _animated(obj).items():
                kept = self._values.get((obj, path), now)
                if kept != now and (obj, path) not in written:
                    assign(obj, path, kept)


def _animated(obj: Any) -> dict[str, Any]:
    """{data path: value} of the properties that F-curves of an object animate, except properties that do not exist."""
    found = {}
    for path in {curve.data_path for curve in actions.fcurves(obj)}:
        try:
            value = obj.path_resolve(path)
        except ValueError:
            continue  # the bone was removed or renamed
        found[path] = tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value
    return found


def assign(obj: Any, path: str, value: Any) -> None:
    """Set the property at a data path of an object to a value, an array property to all its components at once."""
    if path.endswith('"]'):
        holder, _, key = path[:-2].rpartition('["')
        (obj.path_resolve(holder) if holder else obj)[bpy.utils.unescape_identifier(key)] = value
    else:
        # A vector is set as a whole: setting an item of rotation_euler would reset the rotation mode.
        holder, _, name = path.rpartition(".")
        setattr(obj.path_resolve(holder) if holder else obj, name, value)


_reading = [0]


def is_read() -> bool:
    """Whether the evaluation that goes on is one of go_to(): its results are read, and must not be those of an unfinished solver."""
    return _reading[0] > 0


def go_to(scene: bpy.types.Scene, frame: float) -> None:
    """Set the scene to a frame, which may be a fraction, and evaluate the scene; returns when all is solved, however long that takes."""
    whole = math.floor(frame)
    _reading[0] += 1
    try:
        scene.frame_set(whole, subframe=frame - whole)
    finally:
        _reading[0] -= 1


def depsgraph_of(scene: bpy.types.Scene, layer: str) -> bpy.types.Depsgraph:
    """The depsgraph of a view layer of a scene. Raises ReferenceError if the scene has no such view layer.

    layer: name of the view layer. A Python reference to a view layer that a script has removed would point to freed memory.
    """
    found = scene.view_layers.get(layer)
    if found is None:
        raise ReferenceError(f"{scene.name} has no view layer {layer} any more")
    return found.depsgraph
