"""What is recorded of the scene frame by frame, and written as F-curves: transforms of objects and bones, and driven numbers."""

from ..core.animation import channel, fitted_keys
from ..core.bake import keys as bake_keys
from ..core.bake.sampling import Track, basis
from ..core.blender import actions
from ..core.lazy import numpy as np
from ..core.measures.handedness import scale_is_mirrored
from ..core.refusals import Refused


class Moved(Track):
    """Samples of the transform of one Object or PoseBone, recorded in any order of frames."""

    def __init__(self, thing, channels):
        super().__init__(thing, channels)
        self._at = {}

    def record(self, depsgraph, frame):
        """Note the thing's evaluated transform relative to its parent at a frame of the time line."""
        self._at[frame] = basis(self.thing, self.id_data.evaluated_get(depsgraph)).copy()

    def rows(self):
        """The recorded numbers (n, 16), in the order of the frames."""
        return np.array([np.array(self._at[frame]).ravel() for frame in sorted(self._at)])

    def finish(self):
        """Turn what was noted into values of properties; returns the frames, rising. Must be called once, when all has been recorded."""
        for frame in sorted(self._at):
            self.record_basis(self._at[frame])
        return sorted(self._at)


class Driven:
    """Samples of one property whose driver reads Motus; it has the interface of Moved.

    id_data: datablock with the driver. curve: F-curve of the driver.
    """

    group = "Properties"

    def __init__(self, id_data, curve):
        self.id_data, self.path, self.index = id_data, curve.data_path, curve.array_index
        self._at = {}
        self.is_smooth = self._number().type == 'FLOAT'

    def record(self, _depsgraph, frame):
        """Note the property's value at a frame; Blender writes what a driver gives to the original too."""
        self._at[frame] = self._number().present

    def rows(self):
        """The recorded numbers (n, 1), in the order of the frames."""
        return np.array([[self._at[frame]] for frame in sorted(self._at)], float)

    def finish(self):
        """The frames, rising."""
        return sorted(self._at)

    def curves(self):
        """Yield (data path, index, samples) for the property's F-curve."""
        yield self.path, self.index, self.rows()[:, 0]

    def _number(self):
        try:
            return channel.number(self.id_data, self.path)
        except Refused:
            return channel.number(self.id_data, self.path, self.index)


def bent(recorded, most):
    """Numbers of the samples after which something does not go on smoothly to the next one, so that a finer step is needed there.

    most: largest number of them; those where the motion is least smooth come first.
    """
    worst = {}
    for track in recorded:
        rows = track.rows()
        if len(rows) < 4:
            continue
        steps = np.diff(rows, axis=0)
        off = np.abs(steps[1:-1] - (steps[:-2] + steps[2:]) / 2.0)
        shares = (off / np.maximum(BEND * np.ptp(rows, axis=0), LEAST_BEND)).max(axis=1)
        for place in np.flatnonzero(shares > 1.0).tolist():
            worst[place + 1] = max(worst.get(place + 1, 0.0), shares[place])
    return sorted(sorted(worst, key=worst.__getitem__, reverse=True)[:most])


BEND, LEAST_BEND = 4e-4, 1e-4
"""How far a step from one sample to the next may be from the mean of its neighbours: as a share of the whole motion, and at least."""


def write(id_data, tracks, time_of):
    """Give a datablock an action of its own with the recorded curves in place of its former ones of the same properties.

    tracks: of this datablock. time_of: function from frames of the time line to the keys' time.
    """
    bag = actions.assign_copy(id_data, id_data.name)
    for track in tracks:
        times = np.array([time_of(frame) for frame in track.finish()])
        for path, index, samples in track.curves():
            for curve in [one for one in bag.fcurves if (one.data_path, one.array_index) == (path, index)]:
                bag.fcurves.remove(curve)
            curve = actions.new_fcurve(bag, path, index, track.group)
            if isinstance(track, Driven) and not track.is_smooth:
                fitted_keys.write_steps(curve, times, samples)
            else:
                fitted_keys.write(curve, times, samples)
    # Drivers go before keys: Blender ignores keys of a driven property.
    written = {path for track in tracks for path, *_ in track.curves()}
    animation = id_data.animation_data
    for driver in [one for one in animation.drivers if one.data_path in written]:
        animation.drivers.remove(driver)


def transforms(channels, sinks):
    """Tracks of driven objects and bones. channels: {Object or PoseBone: names of its driven channels}. sinks: constraints of Motus.

    All channels are recorded of what has constraints of the user's too, which act before or after the result, and of what is mirrored, since
    the constraints of Motus lose a negative scale.
    """
    found = []
    for thing, names in channels.items():
        is_whole = bake_keys.others(thing, sinks) or scale_is_mirrored(thing.scale)
        found.append(Moved(thing, frozenset(("location", "rotation", "scale") if is_whole else names)))
    return found


def muted(track, sinks):
    """The user's constraints on what a track has recorded, whose effect is in the samples. sinks: constraints of Motus."""
    return bake_keys.others(track.thing, sinks) if isinstance(track, Moved) else ()
