"""Footage: films, image sequences and stills, all of them image datablocks; and their pixels, scene-linear."""

import os
from pathlib import Path

import bpy

from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import group

MOST = 512
"""Pixels across and down that are looked at, of a larger picture evenly spread ones."""
_LINEAR = {"Linear", "Linear Rec.709", "scene_linear", "Non-Color", "Raw"}


def find(name):
    """The image of a name, of a movie clip of that name, or of the file at a path. Raises Refused."""
    found = bpy.data.images.get(name)
    if found is None and name in bpy.data.movieclips:
        name = bpy.data.movieclips[name].filepath
    if found is None:
        found = _loaded(name)
    if not (found.size[0] and found.size[1]):
        raise Refused(tr("{object} cannot be read as a picture").format(object=name))
    return found


def _loaded(name):
    path = bpy.path.abspath(name)
    if not os.path.isfile(path):
        raise Refused(tr("There is no clip, no image and no file {object}").format(object=name))
    known = {image.name for image in bpy.data.images}
    try:
        image = bpy.data.images.load(name, check_existing=True)
    except RuntimeError as error:
        raise Refused(str(error)) from error
    if image.name not in known:
        image[group.KEY] = True
        if not (image.size[0] and image.size[1]):
            bpy.data.images.remove(image)
            raise Refused(tr("{object} cannot be read as a picture").format(object=Path(path).name))
    return image


def drop_unused():
    """Remove images that were loaded for a key and are not used."""
    for image in [image for image in bpy.data.images if group.KEY in image and image.users == 0]:
        bpy.data.images.remove(image)


def duration(image):
    """Frames of a film, 1 of a still."""
    return max(1, image.frame_duration) if image.source in {'MOVIE', 'SEQUENCE'} else 1


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
