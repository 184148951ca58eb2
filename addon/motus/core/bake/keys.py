"""Writing baked keyframes into an action of their own, and taking them away again."""

import json

import bpy

from .. import actions

PARKED_KEY = "motus_parked"
"""Custom property that the drivers of baked channels are aimed at until they are wanted again."""
LARGEST_CHANNEL = 4


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
    id_data.motus.bake.action = id_data.animation_data.action


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
    """Undo what write(), mute() and remember() did to an object."""
    state = id_data.motus.bake
    kept = json.loads(state.kept)
    baked, state.action = state.action, None
    # Where the user has chosen yet another action since, it stays.
    if id_data.animation_data and id_data.animation_data.action == baked:
        actions.assign(id_data, state.previous_action, state.previous_slot)
    if baked and baked.users == 0:
        bpy.data.actions.remove(baked)
    _unmute(id_data, kept["muted"])
    for path, values in kept["values"].items():
        _set_values(id_data, path, values)
    id_data.motus.property_unset("bake")
    id_data.update_tag()


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


def _unmute(id_data, kept):
    for path in kept["constraints"]:
        _set_muted(id_data, path, False)
    waiting = list(kept["drivers"])
    for curve in _drivers(id_data):
        if curve.data_path == f'["{PARKED_KEY}"]':
            # In the order of the datablock's drivers, but for those that the user has removed since.
            place = next(place for place in waiting if place[1] == curve.array_index)
            waiting.remove(place)
            curve.data_path, curve.mute = place[0], place[2]
    if PARKED_KEY in id_data:
        del id_data[PARKED_KEY]


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
