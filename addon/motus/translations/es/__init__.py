"""Spanish, a file for each part of the add-on."""

from . import base, ik, look_at, wiring

_PARTS = (base, wiring, ik, look_at)

CONTEXTS = {
    "*": {text: translated for part in _PARTS for text, translated in part.INTERFACE.items()},
    "Operator": {text: translated for part in _PARTS for text, translated in part.OPERATORS.items()},
}
