"""The wind that chains feel beside their own: that of an emitter of snow, so that flakes and chains are blown alike."""

from typing import NamedTuple

from ..core.declare import offered
from ..core.file.pointers import pointed


class SnowWind(NamedTuple):
    """Declared input of a solver, by which it waits for the wind of the emitter that the pointer setting `of` names.

    The solver runs again whenever the emitter's settings are edited.
    """

    name: str
    of: str

    def variable(self, _owner, settings):
        """Return the variable of the solver's driver; None without an emitter."""
        obj = pointed(settings, self.of)
        return offered("snow").variable(obj) if obj is not None and blows(obj) else None

    @staticmethod
    def read(value, _settings):
        """Return the argument of solve()."""
        return value or None


def blows(obj):
    """Whether an object emits snow."""
    return offered("snow").blows(obj)


def of(settings):
    """Return the air (snow/air.py: Air) of the emitter that the settings of chains name, original or evaluated; None if there is none."""
    obj = pointed(settings, "wind_from")
    return offered("snow").air_of(obj) if obj is not None and blows(obj) else None


def is_missing(settings):
    """Whether the settings of chains name an object that emits no snow, or was deleted."""
    return pointed(settings, "wind_from") is not None and of(settings) is None
