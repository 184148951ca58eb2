"""The numbers of a filter in the three ways to set it: frequency, damping, response; overshoot, settling; mass, spring."""

import math

from ..core import native

LEAST_FREQUENCY, GREATEST_FREQUENCY = 1e-3, 1e3  # Hz
GREATEST_DAMPING = 100.0
GREATEST_RESPONSE = 100.0
LEAST_SETTLING, GREATEST_SETTLING = 1e-3, 1e4  # s
LEAST_OVERSHOOT = 1e-3
"""Below it the critical damping is meant, which does not overshoot."""
NUMBERS = ("frequency", "damping", "response")


def numbers(entry):
    """(frequency, damping, response) of an entry or operator."""
    return tuple(getattr(entry, name) for name in NUMBERS)


FORGOTTEN = 20.0
"""Time constants of its slowest part after which a filter has forgotten how it swung: less is left than single precision tells."""


def memory(found):
    """Seconds after which the filter of (frequency, damping, response) has forgotten what was; infinite without damping."""
    frequency, damping, _ = found
    slowest = damping if damping <= 1.0 else 1.0 / (damping + math.sqrt(damping * damping - 1.0))
    rate = math.tau * frequency * slowest
    return FORGOTTEN / rate if rate > 0.0 else math.inf


def second_order(found):
    """The native filter of (frequency, damping, response). Raises ValueError."""
    return native.module.SecondOrder(*found)


def seen(entry, key):
    """What frequency, damping and response make of another number of an entry."""
    try:
        return _SEEN[key](entry)
    except (AttributeError, ValueError):  # without the native module
        return 0.0


def put(entry, key, value):
    """Set an entry's frequency, damping and response such that one of the derived numbers, `key`, becomes `value`.

    The derived numbers of the same group (overshoot and settling; mass, stiffness and resistance) keep their values.
    Nothing is changed if no filter has such numbers.
    """
    try:
        found = _PUT[key](entry, value)
    except (AttributeError, ValueError):  # no filter overshoots so little with that response
        return
    for name, number in zip(NUMBERS, found):
        setattr(entry, name, number)


def from_overshoot(overshoot, settling, response):
    """(frequency, damping, response) of what overshoots and settles so. Raises ValueError where nothing does."""
    if overshoot < LEAST_OVERSHOOT:
        return _scaled((1.0, 1.0, response), settling)
    made = native.module.SecondOrder.from_overshoot(overshoot, settling, response)
    return made.frequency, made.damping, response


def from_spring(mass, stiffness, resistance):
    """(frequency, damping, response) of a mass (kg) on a spring (N/m) and a damper (N s/m). Raises ValueError."""
    made = native.module.SecondOrder.from_mass_spring(mass, stiffness, resistance)
    return made.frequency, made.damping, 2.0


def seconds_shown(found):
    """How long a graph of the step response is, in s: until it has come to rest, or for some swings."""
    settling = second_order(found).settling_time()
    longest = 12.0 / found[0]
    return min(1.25 * settling, longest) if math.isfinite(settling) and settling > 0.0 else longest


def _scaled(found, settling):
    """The filter with a frequency such that it settles within `settling` seconds. Raises ValueError if `settling` is not above 0."""
    if not settling > 0.0:
        raise ValueError("settling")
    return found[0] * second_order(found).settling_time() / settling, *found[1:]


def _overshoot(entry):
    return min(second_order(numbers(entry)).overshoot, 1.0)


def _settling(entry):
    return min(second_order(numbers(entry)).settling_time(), GREATEST_SETTLING)


def _stiffness(entry):
    return entry.mass * (math.tau * entry.frequency) ** 2


def _resistance(entry):
    return 2.0 * entry.damping * entry.mass * math.tau * entry.frequency


_SEEN = {"overshoot": _overshoot, "settling": _settling, "stiffness": _stiffness, "resistance": _resistance}
_PUT = {
    "overshoot": lambda entry, value: from_overshoot(value, _settling(entry), entry.response),
    "settling": lambda entry, value: _scaled(numbers(entry), value),
    "stiffness": lambda entry, value: from_spring(entry.mass, value, _resistance(entry)),
    "resistance": lambda entry, value: from_spring(entry.mass, _stiffness(entry), value),
}
