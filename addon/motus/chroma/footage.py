"""Footage: films, image sequences and stills, all kept as image datablocks, and their scene-linear pixels."""

import contextlib
import os
import re
from pathlib import Path

import bpy

from ..core.blender import actions
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import group

MOST = 512
"""Most pixels across and down that are measured; of a larger picture evenly spread pixels are taken."""
LAST_FRAME = 1048574
"""Largest frame number in Blender."""
_LINEAR = {"Linear", "Linear Rec.709", "scene_linear", "Non-Color", "Raw"}


def find(name):
    """Image of this name, image of the movie clip of this name, or image from the file at this path. Raises Refused."""
    found = bpy.data.images.get(name)
    if found is None and name in bpy.data.movieclips:
        name = bpy.data.movieclips[name].filepath
    if found is None:
        found = _loaded(name)
    if not all(size(found)):
        raise Refused(tr("{object} cannot be read as a picture").format(object=name))
    return found


def find_chosen(folder, names):
    """Image from files that the user has chosen together: a sequence if several files are numbered. Raises Refused."""
    if len(names) == 1:
        return find(os.path.join(folder, names[0]))
    parts = [_numbered(name) for name in names]
    if None in parts or len({(before, after) for before, _, after in parts}) > 1:
        raise Refused(tr("Choose one file, or the pictures of one numbered sequence"))
    first = os.path.join(folder, min(zip(parts, names), key=lambda one: int(one[0][1]))[1])
    found = next((image for image in bpy.data.images if image.source == 'SEQUENCE' and bpy.path.abspath(image.filepath) == first), None)
    if found is None:
        found = _loaded(first, check_existing=False)  # an image of this file that is a still remains a still
        found.source = 'SEQUENCE'
    return found


def _loaded(name, check_existing=True):
    path = bpy.path.abspath(name)
    if not os.path.isfile(path):
        raise Refused(tr("There is no clip, no image and no file {object}").format(object=name))
    known = {image.name for image in bpy.data.images}
    try:
        image = bpy.data.images.load(name, check_existing=check_existing)
    except RuntimeError as error:
        raise Refused(str(error)) from error
    if image.name not in known:
        image[group.KEY] = True
        if not (image.size[0] and image.size[1]):  # type: ignore[index]
            bpy.data.images.remove(image)
            raise Refused(tr("{object} cannot be read as a picture").format(object=Path(path).name))
    return image


def drop_unused():
    """Remove unused images that were loaded for a key."""
    for image in [image for image in bpy.data.images if group.KEY in image and image.users == 0]:
        bpy.data.images.remove(image)


def size(image):
    """Width and height of an image in pixels; 0 if the file cannot be read."""
    with _first(image) as picture:
        return tuple(picture.size) if picture else (0, 0)


def duration(image):
    """Number of frames of a film or sequence; 1 for a still."""
    if image.source == 'SEQUENCE':
        numbers = _numbers(image)
        return numbers[-1] - numbers[0] + 1 if numbers else 1
    return max(1, image.frame_duration) if image.source == 'MOVIE' else 1


def play(image, user, scene):
    """Play footage from frame 1 of a scene on, in a node or image user: films at their own rate, sequences picture by picture.

    A picture that a sequence lacks is replaced by the previous one: Blender would make a black or empty frame, and 3.4 would hang.
    """
    path = f"{user.path_from_id()}.frame_offset"
    actions.remove(user.id_data, (path,))
    numbers = _numbers(image) if image.source == 'SEQUENCE' else []
    user.frame_duration, user.frame_start, user.use_auto_refresh = duration(image), 1, True
    for frame, offset in _holds(numbers):
        user.frame_offset = offset
        user.keyframe_insert("frame_offset", frame=frame)
    for key in getattr(actions.find(user.id_data, path), "keyframe_points", ()):
        key.interpolation = 'CONSTANT'
    user.frame_offset = numbers[0] - 1 if numbers else 0
    found = rate(image)
    if found is not None:
        user.frame_duration = LAST_FRAME
        _drive(user.driver_add("frame_offset"), scene, found, duration(image))


def _holds(numbers):
    """Yield (frame, picture number minus frame) at each frame where that difference changes; nothing for a sequence without gaps.

    At the frame of a missing picture the picture before it is shown.
    """
    if not numbers or len(numbers) == numbers[-1] - numbers[0] + 1:
        return
    shown, offset, there = numbers[0], None, set(numbers)
    for frame, number in enumerate(range(numbers[0], numbers[-1] + 1), 1):
        shown = number if number in there else shown
        if shown - frame != offset:
            offset = shown - frame
            yield frame, offset


def _drive(curve, scene, film_rate, frames):
    """Drive a property by the film's frame at the scene's time, minus the scene's frame.

    The driver is a simple expression, which Blender evaluates without Python.
    """
    # Blender 5 gives new drivers keys, which would map the driver's value.
    for key in reversed(curve.keyframe_points):
        curve.keyframe_points.remove(key)
    for modifier in reversed(curve.modifiers):
        curve.modifiers.remove(modifier)
    curve.driver.type = 'SCRIPTED'
    for name, path in (("fps", "render.fps"), ("base", "render.fps_base")):
        variable = curve.driver.variables.new()
        variable.name = name
        target = variable.targets[0]
        target.id_type, target.id, target.data_path = 'SCENE', scene, path
    curve.driver.expression = f"floor(min(max(frame-1,0)*{film_rate!r}*base/fps+0.001,{frames - 1}))-max(frame-1,0)"


def gap(image):
    """Gap of a sequence as texts: (missing pictures, frames that show the previous picture); None without a gap."""
    numbers = _numbers(image) if image.source == 'SEQUENCE' else []
    missing = sorted(set(range(numbers[0], numbers[-1] + 1)) - set(numbers)) if numbers else []
    return (_ranges(missing), _ranges([number - numbers[0] + 1 for number in missing])) if missing else None


def _ranges(numbers, most=8):
    """Text of sorted whole numbers with ranges, such as "3, 7-9", cut off after `most` ranges."""
    parts = []
    for number in numbers:
        if parts and number == parts[-1][1] + 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    texts = [str(first) if first == last else f"{first}-{last}" for first, last in parts]
    return ", ".join(texts[:most] + ["..."] * (len(texts) > most))


def _numbered(name):
    """Split a file's name at its last number: (before, digits, behind); None without a number that fits into Blender's frames."""
    stem, ending = os.path.splitext(name)
    found = re.fullmatch(r"(.*?)(\d+)(\D*)", stem)
    return (found[1], found[2], found[3] + ending) if found and int(found[2]) <= LAST_FRAME else None


def _numbers(image):
    """Numbers of a sequence's files, sorted: all files in the folder whose names differ from the first one's only by the number."""
    path = Path(bpy.path.abspath(image.filepath, library=image.library))
    own = _numbered(path.name)
    if own is None or not path.parent.is_dir():
        return []
    found = (_numbered(other.name) for other in path.parent.iterdir())
    return sorted(int(parts[1]) for parts in found if parts and (parts[0], parts[2]) == (own[0], own[2]))


@contextlib.contextmanager
def _first(image):
    """Image with the pixels of the first frame, removed afterwards if it is a temporary still; None if there are no pixels.

    Blender knows size and pixels of a sequence only while something shows one of its frames.
    """
    if image.source != 'SEQUENCE':
        yield image
        return
    try:
        still = bpy.data.images.load(bpy.path.abspath(image.filepath, library=image.library))
    except RuntimeError:
        yield None
        return
    still.colorspace_settings.name = image.colorspace_settings.name
    try:
        yield still
    finally:
        bpy.data.images.remove(still)


def rate(image):
    """Frame rate of a film, or None."""
    if image.source != 'MOVIE':
        return None
    try:
        clip = bpy.data.movieclips.load(bpy.path.abspath(image.filepath))
    except RuntimeError:
        return None
    found = clip.fps
    bpy.data.movieclips.remove(clip)
    return found if found > 0.0 else None


def pixels(image):
    """Scene-linear pixels of the first frame, (rows, columns, 4) float32, thinned out if the picture is large."""
    with _first(image) as picture:
        if picture is None or not all(picture.size):
            raise Refused(tr("{object} cannot be read as a picture").format(object=image.name))
        return _pixels(picture)


def _pixels(image):
    width, height = image.size
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    step = max(1, -(-max(width, height) // MOST))
    values = values.reshape(height, width, -1)[::step, ::step]  # type: ignore[assignment]
    if values.shape[2] < 3:  # type: ignore[misc]
        raise Refused(tr("{object} has no colours").format(object=image.name))
    found = np.ones((*values.shape[:2], 4), np.float32)
    found[..., : values.shape[2]] = np.nan_to_num(values, posinf=0.0, neginf=0.0)  # type: ignore[misc]
    # Pixels of 8 bits are stored as in the file, others scene-linear.
    if not image.is_float and image.colorspace_settings.name not in _LINEAR:
        found[..., :3] = linear(found[..., :3])
    return np.clip(found, -1e6, 1e6)


def linear(encoded):
    """Convert sRGB-encoded values to scene-linear ones."""
    encoded = np.maximum(encoded, 0.0)
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
