"""Going to frames, and back to how everything stood before."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable
from contextlib import suppress
from typing import Any

import bpy

from ..translations import tr
from . import actions


def ranges(frames: Iterable[float], step: float) -> str:
    """Frames as text: those that follow one another by a step make a range."""
    runs: list[list[float]] = []
    for frame in frames:
        if runs and abs(frame - runs[-1][1] - step) < 1e-6:
            runs[-1][1] = frame
        else:
            runs.append([frame, frame])
    return ", ".join(as_text(first) if first == last else f"{as_text(first)}-{as_text(last)}" for first, last in runs)


def spoken(text: str) -> str:
    """The text of ranges() in a sentence, in the user's language."""
    is_one = "," not in text and "-" not in text[1:]
    return (tr("frame {frames}") if is_one else tr("frames {frames}")).format(frames=text)


def as_text(frame: float) -> str:
    """A frame to a thousandth, without an exponent."""
    return f"{round(frame, 3):.12g}"


class Kept:
    """The frame, the scene's camera, and what animated properties of some objects stand at, keyed or not."""

    def __init__(self, scene: Any, objects: Iterable[Any] = ()) -> None:
        self._scene = scene
        self._frame = scene.frame_current, scene.frame_subframe
        self._camera = scene.camera
        self._values = {(obj, path): value for obj in objects for path, value in _animated(obj).items()}

    def restore(self, written: Container[tuple[Any, str]] = ()) -> None:
        """Go back to the frame, and to values that were changed there without a key.

        written: (object, path) of what has new keys, which count instead.
        """
        whole, part = self._frame
        self._scene.frame_set(whole, subframe=part)
        # Markers choose cameras on the way, and the scene may have had another one on this frame.
        if self._scene.camera != self._camera:
            with suppress(ReferenceError):  # if the camera was removed meanwhile
                self._scene.camera = self._camera
        for obj in dict.fromkeys(obj for obj, _ in self._values):
            for path, now in _animated(obj).items():
                kept = self._values.get((obj, path), now)
                if kept != now and (obj, path) not in written:
                    assign(obj, path, kept)


def _animated(obj: Any) -> dict[str, Any]:
    """{data path: value} of what F-curves of the object animate, as far as it is there."""
    found = {}
    for path in {curve.data_path for curve in actions.fcurves(obj)}:
        try:
            value = obj.path_resolve(path)
        except ValueError:
            continue  # of a bone that was removed or renamed
        found[path] = tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value
    return found


def assign(obj: Any, path: str, value: Any) -> None:
    """Set the property at a data path."""
    if path.endswith('"]'):
        holder, _, key = path[:-2].rpartition('["')
        (obj.path_resolve(holder) if holder else obj)[bpy.utils.unescape_identifier(key)] = value
    else:
        # Whole vectors: an item of rotation_euler would set the rotation mode back.
        holder, _, name = path.rpartition(".")
        setattr(obj.path_resolve(holder) if holder else obj, name, value)


def go_to(scene: bpy.types.Scene, frame: float) -> None:
    """Evaluate a frame, which may be a fraction."""
    whole = math.floor(frame)
    scene.frame_set(whole, subframe=frame - whole)


def depsgraph_of(scene: bpy.types.Scene, layer: str) -> bpy.types.Depsgraph:
    """The depsgraph of a view layer of a scene, by its name: a reference to one that a script removes would be to freed memory.

    Raises ReferenceError.
    """
    found = scene.view_layers.get(layer)
    if found is None:
        raise ReferenceError(f"{scene.name} has no view layer {layer} any more")
    return found.depsgraph
