"""Spanish, a file for each part of the add-on."""

from ...core.translations import OWN_SENSE
from . import (
    base,
    chains,
    chroma,
    drivers,
    dynamics,
    hand_over,
    ik,
    lattice,
    layers,
    look_at,
    pendulum,
    pins,
    pull,
    snow,
    snow_cover,
    stereo,
    tracks,
    walker,
    wiring,
)

_PARTS = (
    base,
    wiring,
    tracks,
    layers,
    ik,
    look_at,
    walker,
    dynamics,
    chains,
    hand_over,
    pull,
    pins,
    lattice,
    pendulum,
    snow,
    snow_cover,
    stereo,
    chroma,
    drivers,
)

CONTEXTS = {
    "*": {text: translated for part in _PARTS for text, translated in part.INTERFACE.items()},
    OWN_SENSE: base.OWN_SENSE,
    "Operator": {text: translated for part in _PARTS for text, translated in part.OPERATORS.items()},
}
