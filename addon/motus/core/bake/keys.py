"""Write baked keyframes into a separate action of a datablock, and restore what the datablock had before baking."""

import json
import re

import bpy

from ..animation import channel as animated
from ..blender import actions
from ..file import stored
from ..refusals import Refused
from . import state as states
from .sampling import NumberTrack

PARKED_KEY = "motus_parked"
"""Custom property that the drivers of baked channels are redirected to while the channels are baked."""
CHANNELS = {"location": 3, "rotation_euler": 3, "rotation_quaternion": 4, "rotation_axis_angle": 4, "scale": 3}
"""Transform properties that are baked, and restored by unbaking: {name: number of components}."""
LARGEST_CHANNEL = max(CHANNELS.values())
_STRING = r'"(?:[^"\\]|\\.)*"'
_BONE = rf"(?:pose\.bones\[{_STRING}\]\.)?"
_CHANNEL_PATH = re.compile(rf"{_BONE}(?P<channel>{'|'.join(CHANNELS)})")
_MUTE_PATH = re.compile(rf"{_BONE}constraints\[{_STRING}\]\.mute")


def write(id_data, tracks, frames):
    """Assign an action with the keyframes of tracks, and with the F-curves that its former action has for all other channels, to an object.

    tracks: sampled Tracks and NumberTracks. frames: of the keyframes, in the keys' time (after Time Stretching).
    """
    write_curves(actions.assign_copy(id_data, f"{id_data.name} Motus Bake"), tracks, frames)
    state = states.of(id_data)
    state.action, state.frame_start, state.frame_end = id_data.animation_data.action, frames[0], frames[-1]


def write_curves(bag, tracks, frames):
    """Write the samples of tracks as F-curves, in place of existing F-curves of these channels.

    bag: action or channelbag that actions.assign_copy() returned. frames: of the keyframes, one for each sample.
    """
    for track in tracks:
        for path, index, column in track.curves():
            for curve in [one for one in bag.fcurves if (one.data_path, one.array_index) == (path, index)]:
                bag.fcurves.remove(curve)
            _write_curve(actions.new_fcurve(bag, path, index, track.group), frames, column)


def _write_curve(curve, frames, values):
    import numpy as np

    count = len(frames)
    curve.keyframe_points.add(count)
    points = np.empty((count, 2), np.float32)
    points[:, 0], points[:, 1] = frames, values
    curve.keyframe_points.foreach_set("co", points.ravel())
    linear = bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items['LINEAR'].value
    curve.keyframe_points.foreach_set("interpolation", np.full(count, linear, np.int32))
    curve.update()


def remember(id_data, owner, tracks, muted):
    """Store on an object that is about to be baked what restore() needs: its action, its values, muted constraints and drivers.

    owner: object whose systems are baked. tracks: of this object. muted: what mute() returned.
    """
    state = states.of(id_data)
    animation = id_data.animation_data
    paths = [track.data_path(name) for track in tracks for name in track.values]
    state.is_baked = True
    state.owner = None if owner == id_data else owner
    state.previous_action = animation.action if animation else None
    state.previous_slot = actions.slot_identifier(id_data)
    kept = {"values": {path: list(id_data.path_resolve(path)) for path in paths}, "muted": muted}
    numbers = [track.own for track in tracks if isinstance(track, NumberTrack)]
    state.kept = json.dumps(kept | ({"numbers": numbers} if numbers else {}))


def restore(id_data):
    """Undo what write(), mute() and remember() did to an object. Returns False if the file lacks a part of what was stored."""
    state = states.of(id_data)
    values, constraints, drivers, is_whole = _kept(state.kept)
    baked, state.action = states.named(state, "action"), None
    own_numbers, has_all = _numbers(state.kept, baked)
    is_whole &= has_all
    # An action that the user has assigned since baking stays assigned.
    if id_data.animation_data and id_data.animation_data.action == baked:
        is_whole &= _assign_previous(id_data, state)
    if baked and baked.users == 0:
        bpy.data.actions.remove(baked)
    for path in constraints:
        _set_muted(id_data, path, False)
    is_whole &= _unpark(id_data, drivers)
    for path, numbers in values.items():
        _set_values(id_data, path, numbers)
    for path, index, number in own_numbers:
        _set_number(id_data, path, index, number)
    states.forget(id_data)
    id_data.update_tag()
    return is_whole


def _assign_previous(id_data, state):
    try:
        actions.assign(id_data, states.named(state, "previous_action"), state.previous_slot)
    except RuntimeError:  # the action animates a different type of datablock
        actions.assign(id_data, None)
        return False
    return True


def _kept(text):
    """Parse the JSON text in which a baked object stores its state before baking, without entries that baking cannot have written.

    Returns (values by data path, data paths of `mute` of constraints, (data path, index, was muted) of each driver, whether nothing was
    left out).
    """
    try:
        found = stored.parse(text, _is_anything)
    except stored.Damaged:
        found = None
    muted = _get(found, "muted", dict)
    values, constraints, drivers = (_get(found, "values", dict), _get(muted, "constraints", list), _get(muted, "drivers", list))
    parts = [
        {path: numbers for path, numbers in (values or {}).items() if _is_channel(path, numbers)},
        [path for path in constraints or () if isinstance(path, str) and _MUTE_PATH.fullmatch(path)],
        [tuple(place) for place in drivers or () if _is_driver(place)],
    ]
    return *parts, all(one is not None and len(one) == len(part) for one, part in zip((values, constraints, drivers), parts))


def _is_anything(_value):
    """Form of JSON texts that are read part by part: what does not fit is left out, and the rest is restored."""
    return True


def _numbers(text, baked):
    """Read the values of properties before baking from the JSON text of a baked object.

    Returns ([(data path, index, value)], whether nothing was dropped). Properties that the baked action does not animate are dropped:
    baking cannot have written them. baked: the action with the baked keyframes, or None. Text that is no JSON gives ([], True).
    """
    try:
        said = stored.parse(text, _is_anything)
    except stored.Damaged:
        return [], True  # _kept() reports unreadable text
    found = said.get("numbers", []) if isinstance(said, dict) else []
    if not stored.fits(found, [(str, lambda value: type(value) is int and value >= -1, float)]):
        return [], False
    animated_ones = {(curve.data_path, curve.array_index) for curves in (actions.all_fcurves(baked) if baked else ()) for curve in curves}
    kept = [tuple(one) for one in found if (one[0], max(one[1], 0)) in animated_ones]
    return kept, len(kept) == len(found)


def _set_number(id_data, path, index, value):
    try:
        animated.number(id_data, path, index).write(value)
    except Refused:
        pass  # the user has removed the property since baking


def _get(holder, key, kind):
    found = holder.get(key) if isinstance(holder, dict) else None
    return found if isinstance(found, kind) else None


def _is_channel(path, numbers):
    match = _CHANNEL_PATH.fullmatch(path)
    return match is not None and stored.fits(numbers, (float,) * CHANNELS[match["channel"]])


def _is_driver(place):
    return stored.fits(place, (str, int, bool)) and bool(_CHANNEL_PATH.fullmatch(place[0]))


def mute(id_data, tracks, sinks):
    """Mute the constraints and drivers that would still act on baked channels. Returns their states before, for restore().

    tracks: of the baked channels. sinks: the constraints that apply the solvers' results; they stay as they are. A driver is not only muted
    but redirected to a custom property: in Blender 5.2 the value of a key for a property that has a muted driver sometimes arrives after
    the transform was computed (seen in about one frame of a hundred).
    """
    constraints = [f"{constraint.path_from_id()}.mute" for track in tracks if track.values for constraint in others(track.thing, sinks)]
    baked = {track.data_path(name) for track in tracks for name in track.values}
    parked = [curve for curve in _drivers(id_data) if curve.data_path in baked]
    for path in constraints:
        _set_muted(id_data, path, True)
    kept = [(curve.data_path, curve.array_index, curve.mute) for curve in parked]
    if parked:
        id_data[PARKED_KEY] = [0.0] * LARGEST_CHANNEL
    for curve in parked:
        curve.mute = True
        curve.data_path = f'["{PARKED_KEY}"]'
    return {"constraints": constraints, "drivers": kept}


def _unpark(id_data, waiting):
    """Redirect parked drivers to their channels again. Returns False if the channel of a driver is unknown.

    waiting: [(data path, index, was muted)] of the drivers that mute() has parked, in their order; entries are removed when used.
    """
    parked = [curve for curve in _drivers(id_data) if curve.data_path == f'["{PARKED_KEY}"]']
    for curve in parked:
        # Drivers keep their order in the datablock; the user may have removed some since baking.
        place = next((place for place in waiting if place[1] == curve.array_index), None)
        if place is None:
            return False
        waiting.remove(place)
        curve.data_path, curve.mute = place[0], place[2]
    if PARKED_KEY in id_data:
        del id_data[PARKED_KEY]
    return True


def others(thing, sinks):
    """List of the constraints of an Object or PoseBone that are not muted and not among `sinks`.

    sinks: the constraints that apply the solvers' results.
    """
    return [constraint for constraint in thing.constraints if not constraint.mute and constraint not in sinks]


def _drivers(id_data):
    return id_data.animation_data.drivers if id_data.animation_data else ()


def _set_muted(id_data, path, muted):
    """Mute or unmute a constraint of an object, unless the user has removed or renamed the constraint.

    path: data path of the constraint's property `mute`, from the object.
    """
    try:
        constraint = id_data.path_resolve(path.removesuffix(".mute"))
    except ValueError:
        return  # the user has removed or renamed the constraint since baking
    constraint.mute = muted


def _set_values(id_data, path, values):
    holder, _, name = path.rpartition(".")
    try:
        setattr(id_data.path_resolve(holder) if holder else id_data, name, values)
    except ValueError:
        pass  # the user has removed or renamed the bone since baking
