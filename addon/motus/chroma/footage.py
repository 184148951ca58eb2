"""Footage: films, image sequences and stills, all of them image datablocks; and their pixels, scene-linear."""

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
"""Pixels across and down that are looked at, of a larger picture evenly spread ones."""
LAST_FRAME = 1048574
"""The greatest frame that Blender counts to."""
_LINEAR = {"Linear", "Linear Rec.709", "scene_linear", "Non-Color", "Raw"}


def find(name):
    """The image of a name, of a movie clip of that name, or of the file at a path. Raises Refused."""
    found = bpy.data.images.get(name)
    if found is None and name in bpy.data.movieclips:
        name = bpy.data.movieclips[name].filepath
    if found is None:
        found = _loaded(name)
    if not all(size(found)):
        raise Refused(tr("{object} cannot be read as a picture").format(object=name))
    return found


def find_chosen(folder, names):
    """The image of files that were chosen together: a sequence, if there are several that are numbered. Raises Refused."""
    if len(names) == 1:
        return find(os.path.join(folder, names[0]))
    parts = [_numbered(name) for name in names]
    if None in parts or len({(before, after) for before, _, after in parts}) > 1:
        raise Refused(tr("Choose one file, or the pictures of one numbered sequence"))
    first = os.path.join(folder, min(zip(parts, names), key=lambda one: int(one[0][1]))[1])
    found = next((image for image in bpy.data.images if image.source == 'SEQUENCE' and bpy.path.abspath(image.filepath) == first), None)
    if found is None:
        found = _loaded(first, check_existing=False)  # a still of this file stays one
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
    """Remove images that were loaded for a key and are not used."""
    for image in [image for image in bpy.data.images if group.KEY in image and image.users == 0]:
        bpy.data.images.remove(image)


def size(image):
    """Width and height in pixels; 0 of what cannot be read."""
    with _first(image) as picture:
        return tuple(picture.size) if picture else (0, 0)


def duration(image):
    """Frames of a film or sequence, 1 of a still."""
    if image.source == 'SEQUENCE':
        numbers = _numbers(image)
        return numbers[-1] - numbers[0] + 1 if numbers else 1
    return max(1, image.frame_duration) if image.source == 'MOVIE' else 1


def play(image, user, scene):
    """Let a node or image user show footage from frame 1 of a scene on: a film at its own frame rate, a sequence picture by picture.

    For a picture that a sequence lacks it shows the one before: of none Blender makes a black or empty frame, and in 3.4 it hangs.
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
    """(frame, picture that is shown less the frame) where this difference changes; nothing for a sequence without a gap."""
    if not numbers or len(numbers) == numbers[-1] - numbers[0] + 1:
        return
    shown, offset, there = numbers[0], None, set(numbers)
    for frame, number in enumerate(range(numbers[0], numbers[-1] + 1), 1):
        shown = number if number in there else shown
        if shown - frame != offset:
            offset = shown - frame
            yield frame, offset


def _drive(curve, scene, film_rate, frames):
    """Give a driver the film's frame at the scene's time, less the scene's frame.

    A simple expression, which Blender evaluates without Python.
    """
    # Blender 5 gives a new driver keys, through which its value would go.
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
    """(pictures that a sequence lacks, frames that show the ones before), as texts; None without a gap."""
    numbers = _numbers(image) if image.source == 'SEQUENCE' else []
    missing = sorted(set(range(numbers[0], numbers[-1] + 1)) - set(numbers)) if numbers else []
    return (_ranges(missing), _ranges([number - numbers[0] + 1 for number in missing])) if missing else None


def _ranges(numbers, most=8):
    """Whole numbers in their order, as "3, 7-9"; of many parts the first ones."""
    parts = []
    for number in numbers:
        if parts and number == parts[-1][1] + 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    texts = [str(first) if first == last else f"{first}-{last}" for first, last in parts]
    return ", ".join(texts[:most] + ["..."] * (len(texts) > most))


def _numbered(name):
    """(what is before, the digits, what is behind) the last number of a file's name; None without one that Blender counts to."""
    stem, ending = os.path.splitext(name)
    found = re.fullmatch(r"(.*?)(\d+)(\D*)", stem)
    return (found[1], found[2], found[3] + ending) if found and int(found[2]) <= LAST_FRAME else None


def _numbers(image):
    """Of the files of a sequence, in their order: all that have the name of its first one, but for the number."""
    path = Path(bpy.path.abspath(image.filepath, library=image.library))
    own = _numbered(path.name)
    if own is None or not path.parent.is_dir():
        return []
    found = (_numbered(other.name) for other in path.parent.iterdir())
    return sorted(int(parts[1]) for parts in found if parts and (parts[0], parts[2]) == (own[0], own[2]))


@contextlib.contextmanager
def _first(image):
    """What has the pixels of the first frame: the image, or of a sequence a still that is there meanwhile; None without.

    A sequence has a size and pixels only while something shows a frame of it.
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
    """Frames a second of a film, or None."""
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
    """(rows, columns, 4) float32 of its first frame, scene-linear, thinned out where it is large."""
    with _first(image) as picture:
        if picture is None or not all(picture.size):
            raise Refused(tr("{object} cannot be read as a picture").format(object=image.name))
        return _pixels(picture)


def _pixels(image):
    width, height = image.size
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    step = max(1, -(-max(width, height) // MOST))
    values = values.reshape(height, width, -1)[::step, ::step]
    if values.shape[2] < 3:
        raise Refused(tr("{object} has no colours").format(object=image.name))
    found = np.ones((*values.shape[:2], 4), np.float32)
    found[..., :values.shape[2]] = np.nan_to_num(values, posinf=0.0, neginf=0.0)
    # Blender holds pixels of 8 bits as the file has them, and others scene-linear.
    if not image.is_float and image.colorspace_settings.name not in _LINEAR:
        found[..., :3] = linear(found[..., :3])
    return np.clip(found, -1e6, 1e6)


def linear(encoded):
    """Scene-linear values of sRGB's."""
    encoded = np.maximum(encoded, 0.0)
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
