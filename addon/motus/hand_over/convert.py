"""Make plain Blender of everything that Motus drives in the open file: it runs in a second Blender, on a copy of the file."""

import bpy

from ..core import wiring
from ..core.blender import actions, datablocks, helpers
from ..core.blender.frames import Kept, depsgraph_of, go_to
from ..core.measures import scene_time
from ..core.refusals import Refused
from ..core.translations import tr
from . import faces, found, points, tracks

PREFIX = "Motus "
"""With this the names of materials and node groups begin that Motus makes; with a dot before it those of hidden shapes, such as flakes."""

FINER = 8
"""How many times finer the step is where something does not move smoothly: after at most every eighth sample, so that it takes no longer
than twice the time."""

_MOVING = {found.POINTS: points.Points, found.FACES: faces.Faces}


def convert(scene, view_layer, frames, folder):
    """Record everything at these frames of the time line, and write it: a generator of the number of frames done, which returns a list of exchange.Handed.

    folder: caches.Folder of the file.
    """
    shown = _show(view_layer)
    wired = found.owners()
    constraints = found.sinks(wired)
    recorded = [
        *tracks.transforms(found.driven_channels(wired), constraints),
        *(tracks.Driven(*one) for one in found.drivers(constraints)),
    ]
    moving = [_MOVING[system.hand_over](system, owner) for system, owner in wired if system.hand_over in _MOVING]
    kept, layer = Kept(scene), view_layer.name
    for index, frame in enumerate(frames):
        go_to(scene, frame)
        depsgraph = depsgraph_of(scene, layer)
        for one in (*recorded, *moving):
            one.record(depsgraph, frame)
        yield index + 1
    for frame in _between(frames, tracks.bent(recorded, len(frames) // FINER)):
        go_to(scene, frame)
        for one in recorded:
            one.record(depsgraph_of(scene, layer), frame)
        yield len(frames)
    kept.restore()
    times = [scene_time.keys_time(scene, frame) for frame in frames]
    handed = [one.convert(folder, times, round(1.0 / (frames[1] - frames[0]))) for one in moving]
    _remove(wired, recorded)
    _write(recorded, lambda frame: scene_time.keys_time(scene, frame))
    _clean()
    kept.restore()
    for obj, is_hidden, is_off in shown:
        obj.hide_viewport = is_off
        obj.hide_set(is_hidden, view_layer=view_layer)
    _check_clean()
    return [one for one in handed if one is not None]


def _between(frames, places):
    """Frames between a frame and the next one, after the frames at these places of the list."""
    return [frames[place] + (frames[place + 1] - frames[place]) * part / FINER for place in places for part in range(1, FINER)]


def _show(view_layer):
    """Show all objects of a view layer, since Blender evaluates no hidden ones. Returns (object, was hidden, was off) of those hidden."""
    hidden = [(obj, obj.hide_get(view_layer=view_layer), obj.hide_viewport) for obj in view_layer.objects]
    hidden = [one for one in hidden if one[1] or one[2]]
    for obj, *_ in hidden:
        obj.hide_viewport = False
        obj.hide_set(False, view_layer=view_layer)
    return hidden


def _remove(wired, recorded):
    """Take the systems' wiring away, and mute users' constraints whose effect has been recorded."""
    constraints = found.sinks(wired)
    for track in recorded:
        for constraint in tracks.muted(track, constraints):
            constraint.mute = True
    for system, owner in wired:
        wiring.detach(system, owner)


def _write(recorded, time_of):
    by_datablock = {}
    for track in recorded:
        if _is_there(track.id_data):  # hidden objects of the wiring, which have drivers too, are gone with it
            by_datablock.setdefault(track.id_data, []).append(track)
    for id_data, own in by_datablock.items():
        if isinstance(id_data, bpy.types.Object) and helpers.is_helper(id_data):
            id_data.use_fake_user = True  # what it moves, such as a curve with hooks, does not count as its user
        tracks.write(id_data, own, time_of)
        id_data.update_tag()


def _is_there(id_data):
    try:
        return bool(id_data.name)
    except ReferenceError:
        return False


def _clean():
    """Remove settings, custom properties, keys and drivers of Motus from all datablocks of the file."""
    for action in bpy.data.actions:
        for curves in actions.all_fcurves(action) if not action.library else ():
            for curve in [one for one in curves if found.OURS.search(one.data_path)]:
                curves.remove(curve)
    for id_data in datablocks.everything():
        if id_data.library:
            continue
        _drop_drivers(id_data)
        if isinstance(id_data, (bpy.types.Object, bpy.types.Scene)):
            id_data.property_unset("motus")
        _rename(id_data)
        for key in [key for key in id_data.keys() if found.OURS.search(key)]:
            del id_data[key]


def _rename(id_data):
    """Take the add-on's name out of a datablock's; a number is added by Blender where the rest is taken."""
    if id_data.name.startswith(PREFIX) and isinstance(id_data, (bpy.types.Material, bpy.types.NodeTree)):
        id_data.name = id_data.name.removeprefix(PREFIX)
    elif id_data.name.startswith(f".{PREFIX}"):
        id_data.name = f".{id_data.name.removeprefix(f'.{PREFIX}')}"


def _drop_drivers(id_data):
    animation = getattr(id_data, "animation_data", None)
    for curve in [one for one in (animation.drivers if animation else ()) if found.reads_motus(one) or found.OURS.search(one.data_path)]:
        animation.drivers.remove(curve)


def _check_clean():
    """Raise Refused if something of Motus is still in the file, so that no file is handed over that would need the add-on."""
    for id_data in datablocks.everything():
        if id_data.library:
            continue
        names = [name for name in id_data.keys() if found.OURS.search(name)]
        animation = getattr(id_data, "animation_data", None)
        names += [one.data_path for one in (animation.drivers if animation else ()) if found.reads_motus(one)]
        if names:
            raise Refused(tr("{object} still has {name} of Motus: report this").format(object=id_data.name, name=names[0]))
