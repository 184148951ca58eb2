"""The air in which flakes fly, which snow offers to systems whose things are blown by it too (Feature.offers)."""

from typing import NamedTuple

from ..core import native
from ..core.animation.strips import together
from ..core.declare import Variable, is_owner, registered
from ..core.file import deleted
from ..core.lazy import numpy as np
from ..core.tracks.inputs import stamp_of_known
from . import births


class Air(NamedTuple):
    """Wind of an emitter over time, with gusts and without eddies.

    along: Tracks of the wind along X, Y and Z. gusts, frequency, start: settings of the emitter, which cannot be keyed.
    """

    along: list
    gusts: float
    frequency: float
    start: float

    @property
    def is_known(self):
        """Whether the wind is known at all times."""
        return all(track.is_known for track in self.along)

    @property
    def stamp(self):
        """Hashable value that changes whenever the air may at any time; None if changes cannot be detected."""
        return together((*map(stamp_of_known, self.along), *self[1:]))

    def velocities(self, frames, fps, period=0.0):
        """Return the velocities (n, 3) of the air at frames (n,), m/s, world space. It has to be known.

        period: time after which the gusts shall begin again, s, for which their frequencies are changed a little; 0 for none.
        """
        wind = np.stack([track.values(frames) for track in self.along], axis=1)
        if self.gusts <= 0.0:
            return wind
        gusts = native.module.gusts((frames - self.start) / fps, self.frequency, period)
        return wind * (1.0 + self.gusts * gusts[:, None])


def blows(obj):
    """Whether an object emits snow, and was not deleted."""
    return is_owner(registered["snow"], obj) and not deleted.is_deleted(obj)


def air_of(emitter):
    """Return the Air of an emitter, original or evaluated, as its Tracks are then."""
    settings = emitter.motus.snow
    return Air(births.wind_tracks(emitter), settings.gusts, settings.gust_frequency, settings.start_frame)


def variable(emitter):
    """Return the driver variable by which a solver runs after the emitter's wind, and again after an edit of its settings."""
    return Variable('OBJECT', emitter, births.WIND)
