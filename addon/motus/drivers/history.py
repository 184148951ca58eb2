"""Second-order dynamics that follow the keys of a property, computed from the scene's first frame up to any frame."""

from ..core import native, tracks
from ..core.blender import actions
from ..core.evaluated import read_keys
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.translations import tr

PARTS = 8
"""Samples of the followed property per frame; between samples its value is taken as linear."""
PIECE = 1024  # frames of the shortest sampled range, which is doubled until it reaches the frame
MOST = 65536  # most frames after the first; later frames have the last value


def track_of(owner, data_path, index):
    """Track (values at any frame) of a property of the owner's datablock. Raises Refused if the property is no number."""
    id_data = owner.id_data
    value = id_data.path_resolve(data_path)
    return tracks.property_track(id_data, data_path, max(index, 0) if hasattr(value, "__len__") else -1, is_beneath_driver=True)


def check(id_data, data_path, index):
    """Raise Refused if a property does not exist, has no keys, or has no known value at every frame."""
    try:
        track = track_of(id_data, data_path, index)
    except ValueError as error:
        raise Refused(tr("{object} has no property {path}").format(object=id_data.name, path=data_path)) from error
    if track.is_constant:
        raise Refused(tr("{path} has no keys that could be followed").format(path=data_path))
    if not track.is_known:
        raise Refused(track.sentence)


def followed(owner, data_path, index, frame, scene, numbers):
    """Value at a frame of second-order motion that follows a property; the present value if nothing animates the property.

    numbers: (frequency in Hz, damping ratio, response). Raises ValueError if the numbers are invalid or the values at all frames are
    unknown, and Refused if the property is no number.
    """
    first, length = scene_time.first(scene), scene_time.seconds(scene, 1)
    pieces = 1
    while first + pieces * PIECE < frame and pieces * PIECE < MOST:
        pieces *= 2
    id_data, what = owner.id_data, (numbers, first, pieces, length)
    reading = read_keys.reading_of(id_data, data_path, index, _own_actions)
    if reading.is_edit(frame):
        with reading:
            made = _kept(id_data, data_path, index, what)
    else:
        made = _kept(id_data, data_path, index, what)
    if not made:
        return track_of(owner, data_path, index).present()[0]
    return made.value((frame - first) * length)


def _own_actions(id_data):
    return [player.action for player in actions.players(id_data) if player.action]


def _kept(id_data, data_path, index, what):
    """Native Track from _made(), cached until the keys of the property change. what: arguments of _made() behind the track."""
    stamp = tracks.keys_stamp(id_data)
    if stamp is None:
        track = track_of(id_data, data_path, index)
        return tracks.kept(track, ("second_order", what), lambda: _made(track, *what))
    # Compared without a Track, since making one takes longer than the rest.
    return tracks.kept_by(stamp, ("second_order", data_path, index, what), lambda: _made(track_of(id_data, data_path, index), *what))


def _made(track, *what):
    """Native Track of the second-order motion that follows an animated property; False if nothing animates the property.

    what: (coefficients of the native SecondOrder, first frame, number of pieces that are sampled, length of a frame in seconds).
    Raises ValueError if the property's values at other frames are unknown.
    """
    if track.is_constant:
        return False
    if not track.is_known:
        raise ValueError(track.sentence)
    return _followed(track, *what)


def _followed(track, numbers, first, pieces, length):
    # Samples stand at the same times in pieces of any length, so that a later frame does not change what earlier frames gave.
    frames = first + np.arange(pieces * PIECE * PARTS + 1) / PARTS
    return native.module.Track(native.module.SecondOrder(*numbers), (frames - first) * length, track.values(frames))


def present(owner, data_path, index):
    """Present value of a property of the owner; 0.0 if the property does not exist or is no number."""
    try:
        value = owner.id_data.path_resolve(data_path)
        return float(value[max(index, 0)] if hasattr(value, "__len__") else value)
    except Exception:
        return 0.0
