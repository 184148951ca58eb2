"""Footage (films, image sequences and stills, all kept as Image datablocks) and its scene-linear pixels."""

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
"""Largest number of pixels across and down that are measured; a larger picture is thinned out evenly."""
LAST_FRAME = 1048574
"""Blender's largest frame number."""
_LINEAR = {"Linear", "Linear Rec.709", "scene_linear", "Non-Color", "Raw"}


def find(name):
    """Return the image of this name, the image of the movie clip of this name, or an image loaded from the file at this path.

    Raises Refused if nothing is found or the picture cannot be read.
    """
    found = bpy.data.images.get(name)
    if found is None and name in bpy.data.movieclips:
        name = bpy.data.movieclips[name].filepath
    if found is None:
        found = _loaded(name)
    if not all(size(found)):
        raise Refused(tr("{object} cannot be read as a picture").format(object=name))
    return found


def find_chosen(folder, names):
    """Return an image for the files that a user has chosen in a folder; several numbered files give an image sequence.

    Raises Refused if several files are no numbered sequence.
    """
    if len(names) == 1:
        return find(os.path.join(folder, names[0]))
    parts = [_numbered(name) for name in names]
    if None in parts or len({(before, after) for before, _, after in parts}) > 1:
        raise Refused(tr("Choose one file, or the pictures of one numbered sequence"))
    first = os.path.join(folder, min(zip(parts, names), key=lambda one: int(one[0][1]))[1])
    found = next((image for image in bpy.data.images if image.source == 'SEQUENCE' and bpy.path.abspath(image.filepath) == first), None)
    if found is None:
        found = _loaded(first, check_existing=False)  # do not turn an existing still of this file into a sequence
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
    """Remove the unused images that were loaded for a chroma key."""
    for image in [image for image in bpy.data.images if group.KEY in image and image.users == 0]:
        bpy.data.images.remove(image)


def size(image):
    """Width and height of an image in pixels; (0, 0) if the file cannot be read."""
    with _first(image) as picture:
        return tuple(picture.size) if picture else (0, 0)


def duration(image):
    """Number of frames of a film or an image sequence; 1 for a still."""
    if image.source == 'SEQUENCE':
        numbers = _numbers(image)
        return numbers[-1] - numbers[0] + 1 if numbers else 1
    return max(1, image.frame_duration) if image.source == 'MOVIE' else 1


def play(image, user, scene):
    """Let an Image node or ImageUser play footage from frame 1 of a scene on.

    A film plays at its own rate, by a driver; a sequence shows one picture for each frame. If a picture of a sequence is missing, keys hold
    the previous one: Blender would show a black or empty picture, and Blender 3.4 would hang.
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
    """Add an expression for the frame offset of a film to its driver: the film's frame at the scene's time minus the scene's frame.

    curve: F-curve of the driver. film_rate: frames per second of the film. frames: its number of frames. Blender evaluates the simple
    expression without Python.
    """
    # Blender 5 adds keyframes to new drivers, which would map the driver's value.
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
    """Describe the missing pictures of an image sequence as texts: (numbers of pictures, frames that show a previous picture).

    Returns None if no picture is missing.
    """
    numbers = _numbers(image) if image.source == 'SEQUENCE' else []
    missing = sorted(set(range(numbers[0], numbers[-1] + 1)) - set(numbers)) if numbers else []
    return (_ranges(missing), _ranges([number - numbers[0] + 1 for number in missing])) if missing else None


def _ranges(numbers, most=8):
    """Text of rising whole numbers, with ranges such as "3, 7-9"; ends with "..." after `most` ranges."""
    parts = []
    for number in numbers:
        if parts and number == parts[-1][1] + 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    texts = [str(first) if first == last else f"{first}-{last}" for first, last in parts]
    return ", ".join(texts[:most] + ["..."] * (len(texts) > most))


def _numbered(name):
    """Split a file name at its last number: (text before, digits, text behind).

    Returns None if there is no number, or the number exceeds LAST_FRAME.
    """
    stem, ending = os.path.splitext(name)
    found = re.fullmatch(r"(.*?)(\d+)(\D*)", stem)
    return (found[1], found[2], found[3] + ending) if found and int(found[2]) <= LAST_FRAME else None


def _numbers(image):
    """Rising numbers of the files of an image sequence; [] if the image's file name has no number.

    The files are those in the folder whose names differ from the name of the image's file only by the number.
    """
    path = Path(bpy.path.abspath(image.filepath, library=image.library))
    own = _numbered(path.name)
    if own is None or not path.parent.is_dir():
        return []
    found = (_numbered(other.name) for other in path.parent.iterdir())
    return sorted(int(parts[1]) for parts in found if parts and (parts[0], parts[2]) == (own[0], own[2]))


@contextlib.contextmanager
def _first(image):
    """Context manager that yields an image with the pixels of the first frame; None if the file cannot be read.

    Blender knows the size and pixels of a sequence only while something shows one of its frames. So a sequence gives a temporary still,
    which is removed at the end.
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
    """Frame rate of a film; None if the image is no film or its rate is unknown."""
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
    """Scene-linear pixels of an image's first frame, (rows, columns, 4) float32; a large picture is thinned out evenly.

    Raises Refused if the picture cannot be read or has no colours.
    """
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
    # 8-bit images keep the encoding of the file; float images are scene-linear.
    if not image.is_float and image.colorspace_settings.name not in _LINEAR:
        found[..., :3] = linear(found[..., :3])
    return np.clip(found, -1e6, 1e6)


def linear(encoded):
    """Convert sRGB-encoded values to linear values (Rec. 709 primaries), in double precision: powers of others differ from system to system."""
    encoded = np.maximum(np.asarray(encoded, float), 0.0)
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
