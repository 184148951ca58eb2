"""Settings of pins as tuples, read with foreach_get() for all pins at once: this takes a fifth of the time of reading pin by pin."""

from typing import Any, NamedTuple

from ...core.file.choices import chosen
from ...core.lazy import numpy as np
from ..brush import mirror_bits
from ..properties import is_finite

FLOATS = {"strength": 1, "radius": 1, "scale_factor": 1, "weld": 1, "minimum": 1, "maximum": 1, "displacement": 3, "place": 3, "metric": 9}
FLAGS = ("is_muted", "use_minimum", "use_maximum")
AXES = ('X', 'Y', 'Z')


class Row(NamedTuple):
    """Settings of one pin, as the solver reads them.

    limits: (axis, minimum or None, maximum or None); None for no limits. mirror: letters of "xyz", the mirrored axes. curve: forces of the
    drawn falloff, or None. shape: name of the attribute of a pin made of a stroke, or "".
    """

    strength: float
    is_muted: bool
    radius: float
    falloff: str
    scale_factor: float
    curve: Any
    distance: str
    weld: float
    displacement: tuple
    place: tuple
    anchor: int
    vertex: int
    metric: tuple
    mirror: str
    limits: Any
    vertex_group: str
    shape: str

    @property
    def way(self):
        """Displacement of the vertex that the pin pulls, in the object's space."""
        return tuple(self.strength * along for along in self.displacement)

    @property
    def reach(self):
        """Distance from the pulled vertex at and beyond which the pin moves nothing."""
        return self.radius**0.5 if self.falloff == "classic" else self.radius

    @property
    def profile(self):
        """Keyword arguments of native functions that say how the force of the pin fades with the distance from the pulled vertex."""
        curve = {"curve": np.array(self.curve, np.float32)} if self.falloff == "curve" else {}
        return {"falloff": self.falloff, "scale_factor": self.scale_factor, **curve}

    @property
    def where(self):
        """Tuple of the settings on which the set of reached vertices depends, as a key for a cache."""
        return self.place, self.anchor, self.vertex, self.distance, self.reach, self.weld, self.metric, self.mirror

    @property
    def mirror_bits(self):
        """One integer for the pin itself (0) and for each of its mirror images; its bits are the axes that the image reverses."""
        return mirror_bits(self.mirror.upper())

    @property
    def is_usable(self):
        """Whether all numbers of the pin are finite, its radius is above 0, and its minimum does not exceed its maximum."""
        numbers = (
            self.strength,
            self.radius,
            self.scale_factor,
            self.weld,
            *self.displacement,
            *self.place,
            *self.metric,
            *(self.curve or ()),
            *(end for end in (self.limits or ())[1:] if end is not None),
        )
        ends = [end for end in (self.limits or ())[1:] if end is not None]
        is_number = bool(np.isfinite(numbers).all()) and is_finite(self.way)
        return is_number and self.radius > 0.0 and ends == sorted(ends)


def read(pins):
    """Read the settings of a collection of pins; returns a list of Row."""
    count = len(pins)
    columns = {name: _floats(pins, name, size, count) for name, size in FLOATS.items()}
    columns |= {name: _column(pins, name, np.empty(count, bool)) for name in FLAGS}
    columns |= {name: _column(pins, name, np.empty(count, np.int32)) for name in ("anchor", "vertex")}
    rows = []
    for index, pin in enumerate(pins):
        own = {name: values[index] for name, values in columns.items()}
        ends = [own.pop(name) for name in ("minimum", "maximum")]
        low, high = (end if own.pop(f"use_{name}") else None for name, end in zip(("minimum", "maximum"), ends))
        falloff = chosen(pin, "falloff").lower()
        rows.append(
            Row(
                falloff=falloff,
                distance=chosen(pin, "distance").lower(),
                mirror="".join(sorted(pin.mirror)).lower(),
                curve=tuple(pin.curve) if falloff == "curve" else None,
                vertex_group=pin.vertex_group,
                shape=pin.shape,
                limits=None if low is None and high is None else (AXES.index(chosen(pin, "clamp_axis")), low, high),
                **own,
            )
        )
    return rows


def numbers(pins, name, size, dtype=None):
    """Values of the setting `name` of all pins, (n, size). dtype: float32 if None."""
    values = np.empty(len(pins) * size, dtype or np.float32)
    pins.foreach_get(name, values)
    return values.reshape(len(pins), size)


def _floats(pins, name, size, count):
    values = _column(pins, name, np.empty(count * size, np.float32))
    return values if size == 1 else [tuple(values[size * row : size * (row + 1)]) for row in range(count)]


def _column(pins, name, values):
    pins.foreach_get(name, values)
    return values.tolist()
