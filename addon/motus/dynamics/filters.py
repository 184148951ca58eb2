"""The second-order filter of dynamics, and three sets of numbers that describe it.

The sets are frequency, damping and response; overshoot and settling time; mass, stiffness and resistance of a spring.
"""

import math

from ..core import native

LEAST_FREQUENCY, GREATEST_FREQUENCY = 1e-3, 1e3  # Hz
GREATEST_DAMPING = 100.0
GREATEST_RESPONSE = 100.0
LEAST_SETTLING, GREATEST_SETTLING = 1e-3, 1e4  # s
LEAST_OVERSHOOT = 1e-3
"""Smallest overshoot as a fraction of a step: a smaller one stands for critical damping, which does not overshoot."""
NUMBERS = ("frequency", "damping", "response")


def numbers(entry):
    """Return (frequency in Hz, damping, response) of an entry of the dynamics list or of an operator."""
    return entry.frequency, entry.damping, entry.response


FORGOTTEN = 20.0
"""Number of time constants of a filter's slowest part after which its oscillation has decayed below single precision."""


def memory(found):
    """Return the seconds after which an input no longer affects a filter's output; infinite if the damping is 0.

    found: (frequency, damping, response) of the filter.
    """
    frequency, damping, _ = found
    slowest = damping if damping <= 1.0 else 1.0 / (damping + math.sqrt(damping * damping - 1.0))
    rate = math.tau * frequency * slowest
    return FORGOTTEN / rate if rate > 0.0 else math.inf


def second_order(found):
    """Make a native SecondOrder filter. found: (frequency, damping, response). Raises ValueError for numbers out of range."""
    return native.module.SecondOrder(*found)


def seen(entry, key):
    """Compute a derived number of an entry from its frequency, damping and response; 0.0 if it cannot be computed.

    key: "overshoot", "settling", "stiffness" or "resistance".
    """
    try:
        return _SEEN[key](entry)
    except (AttributeError, ValueError):  # AttributeError: the native module could not be loaded
        return 0.0


def put(entry, key, value):
    """Set an entry's frequency, damping and response such that one of the derived numbers, `key`, becomes `value`.

    The derived numbers of the same group (overshoot and settling; mass, stiffness and resistance) keep their values.
    Nothing is changed if no filter has such numbers.
    """
    try:
        found = _PUT[key](entry, value)
    except (AttributeError, ValueError):  # ValueError: no filter with this response has so small an overshoot
        return
    for name, number in zip(NUMBERS, found):
        setattr(entry, name, number)


def from_overshoot(overshoot, settling, response):
    """Return (frequency, damping, response) of the filter with an overshoot and settling time (s). Raises ValueError if there is none."""
    if overshoot < LEAST_OVERSHOOT:
        return _scaled((1.0, 1.0, response), settling)
    made = native.module.SecondOrder.from_overshoot(overshoot, settling, response)
    return made.frequency, made.damping, response


def from_spring(mass, stiffness, resistance):
    """Return (frequency, damping, response) of a mass (kg) on a spring (N/m) with a damper (N s/m).

    Raises ValueError for numbers out of range.
    """
    made = native.module.SecondOrder.from_mass_spring(mass, stiffness, resistance)
    return made.frequency, made.damping, 2.0


def seconds_shown(found):
    """Return the duration of a graph of a filter's step response, in s: until it rests, but at most 12 periods.

    found: (frequency, damping, response) of the filter.
    """
    settling = second_order(found).settling_time()
    longest = 12.0 / found[0]
    return min(1.25 * settling, longest) if math.isfinite(settling) and settling > 0.0 else longest


def _scaled(found, settling):
    """Return a filter's (frequency, damping, response) with the frequency changed so that it settles within `settling` seconds.

    Raises ValueError if `settling` is not above 0.
    """
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
