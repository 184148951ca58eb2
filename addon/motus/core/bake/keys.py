"""Writing baked keyframes into an action of their own, and taking them away again."""

import json

import bpy

from .. import actions


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
    for path, index in kept["muted"]:
        _set_muted(id_data, path, index, False)
    for path, values in kept["values"].items():
        _set_values(id_data, path, values)
    id_data.motus.property_unset("bake")
    id_data.update_tag()


def mute(id_data, tracks, sinks):
    """Switch off whatever would still act on baked channels, but for the sinks; returns what it was, for restore()."""
    muted = []
    for track in tracks:
        muted += [(f"{constraint.path_from_id()}.mute", -1) for constraint in others(track.thing, sinks)]
        paths = {track.data_path(name) for name in track.values}
        muted += [(curve.data_path, curve.array_index)
                  for curve in _drivers(id_data) if curve.data_path in paths and not curve.mute]
    for path, index in muted:
        _set_muted(id_data, path, index, True)
    return muted


def others(thing, sinks):
    """Constraints in effect on an Object or PoseBone that are not the sinks."""
    return [constraint for constraint in thing.constraints if not constraint.mute and constraint not in sinks]


def _drivers(id_data):
    return id_data.animation_data.drivers if id_data.animation_data else ()


def _set_muted(id_data, path, index, muted):
    """path: of a constraint's `mute` (index -1), or of a property whose driver is meant."""
    if index >= 0:
        for curve in _drivers(id_data):
            if (curve.data_path, curve.array_index) == (path, index):
                curve.mute = muted
        return
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
