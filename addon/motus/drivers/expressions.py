"""Compose driver expressions that call Motus functions from keywords of an operator, and parse such expressions back into keywords."""

import ast
import re
from dataclasses import dataclass

LONGEST = 255  # most characters that Blender accepts in an expression


@dataclass(frozen=True)
class Function:
    """Description of a function that driver expressions can call.

    identifier: value of the keyword `function` of motus.driver_add. name: name of the function in expressions.
    arguments: keywords of the operator that follow the argument `frame`, in their order.
    defaults: default values of the last arguments, which an expression leaves out if they have these values.
    has_start: whether the function counts frames from a start frame.
    follows: whether the function follows a property (keywords `source`, `source_index`); such a function has no base value.
    """

    identifier: str
    name: str
    label: str
    description: str
    arguments: tuple
    defaults: tuple = ()
    has_start: bool = True
    follows: bool = False


FUNCTIONS = (
    Function('SINE', "motus_sine", "Sine", "Swing up and down evenly and softly", ("frequency", "phase"), (1.0, 0.0)),
    Function('TRIANGLE', "motus_triangle", "Triangle", "Go straight up and straight down again", ("frequency", "phase"), (1.0, 0.0)),
    Function('SAW', "motus_saw", "Saw", "Go straight up, and jump back", ("frequency", "phase"), (1.0, 0.0)),
    Function(
        'SQUARE',
        "motus_square",
        "Square",
        "Jump between two values, on and off",
        ("frequency", "phase", "share"),
        (1.0, 0.0, 0.5),
    ),
    Function(
        'STEPS',
        "motus_steps",
        "Random Steps",
        "Hold a random value between -1 and 1, then another one",
        ("frequency", "seed", "blend"),
        (1.0, 0, 0.0),
    ),
    Function('NOISE', "motus_noise", "Noise", "Wander smoothly between -1 and 1", ("speed", "seed", "loop"), (1.0, 0, 0)),
    Function(
        'EASE',
        "motus_ease",
        "Ease",
        "Go from 0 to 1 with a soft start and a soft stop",
        ("frame_start", "frame_end", "ease_in", "ease_out"),
        (0.3, 0.3),
        has_start=False,
    ),
    Function(
        'PENDULUM',
        "motus_pendulum",
        "Pendulum",
        "Swing like a bob on a rod; the value is its angle",
        ("theta", "length", "omega", "gravity", "damping", "speed"),
        (0.0, 9.81, 0.0, 1.0),
    ),
    Function(
        'DOUBLE_PENDULUM',
        "motus_double_pendulum",
        "Double Pendulum",
        "Swing like one of two bobs, the second of which hangs on the first: chaotic, and the same every time",
        ("which", "theta1", "theta2", "omega1", "omega2", "mass1", "mass2", "length1", "length2", "gravity", "damping", "speed"),
        (0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 9.81, 0.0, 1.0),
    ),
    Function(
        'SECOND_ORDER',
        "motus_second_order",
        "Follow Keys",
        "Follow the keys of a property like a mass on a spring: late, with a swing, or ahead of them",
        ("frequency", "damping_ratio", "response"),
        (1.0, 0.5, 0.0),
        has_start=False,
        follows=True,
    ),
)
BY_IDENTIFIER = {one.identifier: one for one in FUNCTIONS}
BY_NAME = {one.name: one for one in FUNCTIONS}
_CALL = re.compile(r"motus_\w+\(")
_ENUMS = {"which": ('THETA1', 'THETA2', 'OMEGA1', 'OMEGA2')}
"""Items of the enum keywords that an expression writes as a number: the index of the item."""
_WHOLE = {"seed", "loop"}
"""Keywords that are whole numbers."""


def names_ours(expression):
    """Whether a driver expression calls one of the Motus functions."""
    return any(found.group()[:-1] in BY_NAME for found in _CALL.finditer(expression))


def compose(keywords):
    """Return the driver expression for the operator's keywords: `base` plus `amplitude` times the function's value."""
    function = BY_IDENTIFIER[keywords["function"]]
    if function.follows:
        numbers = ", ".join(_text(keywords[name]) for name in function.arguments)
        return f"{function.name}(self, {keywords['source']!r}, {keywords['source_index']}, frame, {numbers})"
    values = [_number(name, keywords[name]) for name in function.arguments]
    first_default = len(values) - len(function.defaults)
    while len(values) > first_default and values[-1] == _text(function.defaults[len(values) - 1 - first_default]):
        values.pop()
    start = keywords["start"] if function.has_start else 0.0
    return scaled(f"{function.name}({', '.join([frame_since(start), *values])})", keywords)


def frame_since(start):
    """Expression of the number of frames since the frame `start`."""
    return "frame" if start == 0.0 else f"frame - {_text(start)}" if start > 0.0 else f"frame + {_text(-start)}"


def scaled(call, keywords):
    """Expression of `base` plus `amplitude` times an expression. keywords: with these two."""
    if keywords["amplitude"] != 1.0:
        call = f"{_text(keywords['amplitude'])} * {call}"
    return call if keywords["base"] == 0.0 else f"{_text(keywords['base'])} + {call}"


def _number(name, value):
    return str(_ENUMS[name].index(value)) if name in _ENUMS else _text(value)


def _text(value):
    # Operators keep single precision: write 0.1, not 0.10000000149.
    return f"{value:.7g}"


def read(expression):
    """Parse a driver expression that compose() has made; returns the operator's keywords, or None for all different expressions."""
    try:
        tree = ast.parse(expression, mode='eval').body
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        return None
    base, call = _split(tree, ast.Add, 0.0)
    amplitude, call = _split(call, ast.Mult, 1.0)
    if not isinstance(call, ast.Call) or call.keywords or not isinstance(call.func, ast.Name):
        return None
    function = BY_NAME.get(call.func.id)
    if function is None or base is None or amplitude is None or not call.args:
        return None
    if function.follows:
        return _read_follower(function, call.args) if call is tree else None
    start = _start(call.args[0])
    given = [_constant(one) for one in call.args[1:]]
    least = len(function.arguments) - len(function.defaults)
    if start is None or None in given or not least <= len(given) <= len(function.arguments):
        return None
    given += function.defaults[len(given) - least :]
    keywords = {"function": function.identifier, "base": base, "amplitude": amplitude, "start": start}
    for name, value in zip(function.arguments, given):
        if name in _ENUMS:
            if value not in range(len(_ENUMS[name])):
                return None
            value = _ENUMS[name][int(value)]
        elif name in _WHOLE and not (isinstance(value, int) and 0 <= value < 2**31):
            return None
        keywords[name] = value
    return keywords


def _read_follower(function, given):
    if len(given) != 4 + len(function.arguments) or [getattr(given[at], "id", "") for at in (0, 3)] != ["self", "frame"]:
        return None
    source, index = getattr(given[1], "value", None), _constant(given[2])
    numbers = [_constant(one) for one in given[4:]]
    if not isinstance(source, str) or not isinstance(index, int) or None in numbers:
        return None
    return {"function": function.identifier, "source": source, "source_index": index, **dict(zip(function.arguments, numbers))}


def _split(tree, operator, neutral):
    """Split the syntax tree of `number + x` or `number * x` into (number, x); the number is None if the left side is no number.

    All different trees give (neutral, tree).
    """
    if isinstance(tree, ast.BinOp) and isinstance(tree.op, operator):
        return _constant(tree.left), tree.right
    return neutral, tree


def _start(tree):
    if isinstance(tree, ast.Name) and tree.id == "frame":
        return 0.0
    is_moved = isinstance(tree, ast.BinOp) and isinstance(tree.left, ast.Name) and tree.left.id == "frame"
    start = _constant(tree.right) if is_moved else None
    if start is None or not isinstance(tree.op, (ast.Add, ast.Sub)):
        return None
    return start if isinstance(tree.op, ast.Sub) else -start


def _constant(tree):
    if isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.USub):
        value = _constant(tree.operand)
        return None if value is None else -value
    is_number = isinstance(tree, ast.Constant) and type(tree.value) in (int, float)
    return tree.value if is_number else None
