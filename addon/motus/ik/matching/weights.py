"""Switch chains between their animated pose and the solution over a range of frames, by keys of their weights."""

from ...core.blender import actions
from ...core.measures import scene_time
from ...core.refusals import Refused
from ...core.translations import tr
from .. import chains


def check(rig, entries):
    """Refuse entries with a driver on their position weight or rotation weight."""
    driven = {curve.data_path for curve in rig.animation_data.drivers} if rig.animation_data else ()
    for entry in entries:
        for prefix in _prefixes(rig, entry):
            if any(prefix + name in driven for name in ("position_weight", "rotation_weight")):
                raise Refused(tr("The weights of {bone} are driven: switch them there").format(bone=entry.name))


def switch(scene, rig, entries, times, writer, values):
    """Give weights of entries new values over a range of times, and leave the weights as they are at all different times.

    times: rising frames of F-curves. values: {name of a weight: value}. writer: the KeyWriter that writes the keys. If the range
    covers all frames of the scene, a weight without keys is set without being keyed.
    """
    is_all = times[0] <= scene_time.first(scene) and times[-1] >= scene_time.last(scene)
    for entry in entries:
        for name, value in values.items():
            paths = [prefix + name for prefix in _prefixes(rig, entry)]
            path = next((path for path in paths if actions.find(rig, path)), "")
            if not path and is_all:
                writer.set(entry, name, value)
            else:
                _hold(rig, entry, name, path, times, value, writer)


def _prefixes(rig, entry):
    return chains.prefixes(rig, rig.motus.ik.entries.find(entry.name))


def _hold(rig, entry, name, path, frames, value, writer):
    """Key a weight to a value over the frames, and to the values that it had on the frame before and the frame after them."""
    first, last = frames[0], frames[-1]
    if path:
        writer.cut(rig, path, last + 1)
        writer.cut(rig, path, first - 1).interpolation = 'CONSTANT'
    else:
        for frame, interpolation in ((first - 1, 'CONSTANT'), (last + 1, 'BEZIER')):
            writer.write(entry, name, [frame], [getattr(entry, name)], interpolation)
    held = [first] if first == last else [first, last]
    writer.write(entry, name, held, [value] * len(held), interpolation='CONSTANT', instead_of=path)
