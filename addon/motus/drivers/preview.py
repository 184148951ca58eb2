"""Graph of a driver function's motion, drawn in the dialog of motus.driver_add."""

from ..core import native
from ..core.interface import ui
from ..core.interface.view import graph
from ..core.lazy import numpy as np
from . import expressions

SECONDS = 6.0
COUNT = 256


def sample(keywords, times):
    """Values (n,) of a driver function at times in seconds, without base and amplitude.

    keywords: the function and its arguments. Raises ValueError with the name of the wrong argument.
    """
    call = getattr(native.module, _NATIVE[keywords["function"]][0])
    return _NATIVE[keywords["function"]][1](call, keywords, np.asarray(times, dtype=float))


def _pendulum(call, k, times):
    return call(times * k["speed"], k["theta"], k["omega"], k["length"], k["gravity"], k["damping"])[:, 0]


def _double_pendulum(call, k, times):
    states = call(
        times * k["speed"],
        k["theta1"],
        k["theta2"],
        k["omega1"],
        k["omega2"],
        k["mass1"],
        k["mass2"],
        k["length1"],
        k["length2"],
        k["gravity"],
        k["damping"],
    )
    return states[:, ('THETA1', 'THETA2', 'OMEGA1', 'OMEGA2').index(k["which"])]


def _ease(call, k, times):
    return call(times / SECONDS, k["ease_in"], k["ease_out"])


def _noise(call, k, times):
    return call(np.float32(times * k["speed"]), k["seed"])


def _second_order(call, k, times):
    return call(times, k["frequency"], k["damping_ratio"], k["response"])


_NATIVE = {
    'PENDULUM': ("single_pendulum", _pendulum),
    'DOUBLE_PENDULUM': ("double_pendulum", _double_pendulum),
    'EASE': ("ease", _ease),
    'NOISE': ("noise1", _noise),
    'SECOND_ORDER': ("step_response", _second_order),
}


def draw(layout, operator):
    """Draw the graph of the first SECONDS of the operator's motion; if its arguments are invalid, draw the reason instead."""
    if not ui.draw_native_status(layout):
        return
    function = expressions.BY_IDENTIFIER[operator.function]
    try:
        values = sample({name: getattr(operator, name) for name in (*function.arguments, "function")}, np.linspace(0.0, SECONDS, COUNT))
    except ValueError as error:
        ui.draw_message(layout, str(error), 'ERROR')
        return
    levels = (0.0, 1.0) if function.follows else (0.0,)
    layout.template_icon(graph.icon("drivers", values, levels), scale=8.0)
