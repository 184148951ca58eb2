"""Writing baked keyframes into an action of their own, and taking them away again."""

import json
import math
import re

import bpy

from .. import actions

PARKED_KEY = "motus_parked"
"""Custom property that the drivers of baked channels are aimed at until they are wanted again."""
CHANNELS = {"location": 3, "rotation_euler": 3, "rotation_quaternion": 4, "rotation_axis_angle": 4, "scale": 3}
"""What is baked, and put back: sizes of the transform channels."""
LARGEST_CHANNEL = max(CHANNELS.values())
_STRING = r'"(?:[^"\\]|\\.)*"'
_BONE = rf"(?:pose\.bones\[{_STRING}\]\.)?"
_CHANNEL_PATH = re.compile(rf"{_BONE}(?P<channel>{'|'.join(CHANNELS)})")
_MUTE_PATH = re.compile(rf"{_BONE}constraints\[{_STRING}\]\.mute")


def write(id_data, tracks, frames):
    """Give an object an action with the tracks' keyframes beside its own other F-curves."""
    bag = actions.assign_copy(id_data, f"{id_data.name} Motus Bake")
    for track in tracks:
        group = track.thing.name if isinstance(track.thing, bpy.types.PoseBone) else "Object Transforms"
        for name, rows in track.values.items():
            path = track.data_path(name)
            for curve in [one for one in bag.fcurves if one.data_path == path]:
                bag.fcurves.remove(curve)
            for index, column in enumerate(zip(*rows)):
                _write_curve(actions.new_fcurve(bag, path, index, group), frames, column)
    state = id_data.motus.bake
    state.action, state.frame_start, state.frame_end = id_data.animation_data.action, frames[0], frames[-1]


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
    """Note on an object that is about to be baked what restore() needs. muted: what mute() returned."""
    state = id_data.motus.bake
    animation = id_data.animation_data
    paths = [track.data_path(name) for track in tracks for name in track.values]
    state.is_baked = True
    state.owner = None if owner == id_data else owner
    state.previous_action = animation.action if animation else None
    state.previous_slot = actions.slot_identifier(id_data)
    state.kept = json.dumps({"values": {path: list(id_data.path_resolve(path)) for path in paths}, "muted": muted})


def restore(id_data):
    """Undo what write(), mute() and remember() did to an object; False where the file does not say all of it any more."""
    state = id_data.motus.bake
    values, constraints, drivers, is_whole = _kept(state.kept)
    baked, state.action = state.action, None
    # Where the user has chosen yet another action since, it stays.
    if id_data.animation_data and id_data.animation_data.action == baked:
        is_whole &= _assign_previous(id_data, state)
    if baked and baked.users == 0:
        bpy.data.actions.remove(baked)
    for path in constraints:
        _set_muted(id_data, path, False)
    is_whole &= _unpark(id_data, drivers)
    for path, numbers in values.items():
        _set_values(id_data, path, numbers)
    id_data.motus.property_unset("bake")
    id_data.update_tag()
    return is_whole


def _assign_previous(id_data, state):
    try:
        actions.assign(id_data, state.previous_action, state.previous_slot)
    except RuntimeError:  # it animates another type of datablock
        actions.assign(id_data, None)
        return False
    return True


def _kept(text):
    """(values by path, paths of constraints, [(data path, index, was muted)] of drivers, whether that is all).

    Of what the file says only that is taken which baking can have changed.
    """
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        found = None
    muted = _get(found, "muted", dict)
    values, constraints, drivers = (
        _get(found, "values", dict), _get(muted, "constraints", list), _get(muted, "drivers", list))
    parts = [
        {path: numbers for path, numbers in (values or {}).items() if _is_channel(path, numbers)},
        [path for path in constraints or () if isinstance(path, str) and _MUTE_PATH.fullmatch(path)],
        [tuple(place) for place in drivers or () if _is_driver(place)]]
    return *parts, all(one is not None and len(one) == len(part) for one, part in zip((values, constraints, drivers), parts))


def _get(holder, key, kind):
    found = holder.get(key) if isinstance(holder, dict) else None
    return found if isinstance(found, kind) else None


def _is_channel(path, numbers):
    match = _CHANNEL_PATH.fullmatch(path)
    if not match or not isinstance(numbers, list) or len(numbers) != CHANNELS[match["channel"]]:
        return False
    return all(isinstance(one, float) and math.isfinite(one) for one in numbers)


def _is_driver(place):
    if not isinstance(place, list) or [type(part) for part in place] != [str, int, bool]:
        return False
    return bool(_CHANNEL_PATH.fullmatch(place[0]))


def mute(id_data, tracks, sinks):
    """Switch off whatever would still act on baked channels, but for the sinks; returns what it was, for restore().

    A driver is not only muted but aimed at another property: in Blender 5.2 the value of a key for a property that has a
    muted driver sometimes arrives after the transform was computed (seen in about one frame of a hundred).
    """
    constraints = [f"{constraint.path_from_id()}.mute" for track in tracks for constraint in others(track.thing, sinks)]
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
    """Aim parked drivers at their channels again; False where it is not known at which."""
    parked = [curve for curve in _drivers(id_data) if curve.data_path == f'["{PARKED_KEY}"]']
    for curve in parked:
        # In the order of the datablock's drivers, but for those that the user has removed since.
        place = next((place for place in waiting if place[1] == curve.array_index), None)
        if place is None:
            return False
        waiting.remove(place)
        curve.data_path, curve.mute = place[0], place[2]
    if PARKED_KEY in id_data:
        del id_data[PARKED_KEY]
    return True


def others(thing, sinks):
    """Constraints in effect on an Object or PoseBone that are not the sinks."""
    return [constraint for constraint in thing.constraints if not constraint.mute and constraint not in sinks]


def _drivers(id_data):
    return id_data.animation_data.drivers if id_data.animation_data else ()


def _set_muted(id_data, path, muted):
    """path: of a constraint's `mute`."""
    try:
        constraint = id_data.path_resolve(path.removesuffix(".mute"))
    except ValueError:
        return  # removed or renamed by the user since
    constraint.mute = muted


def _set_values(id_data, path, values):
    holder, _, name = path.rpartition(".")
    try:
        setattr(id_data.path_resolve(holder) if holder else id_data, name, values)
    except ValueError:
        pass  # a bone that the user has removed or renamed since
