"""Keymap of the tool Pick & Pull."""

from typing import Any


def _stroke(button, **options):
    """Keymap item that begins a stroke when a mouse button is pressed.

    options: the modifiers `ctrl` and `shift`, and properties of the operator.
    """
    modifiers = {name: options.pop(name) for name in ("ctrl", "shift") if name in options}
    properties: list[tuple[str, Any]] = [("is_stroke", True), *options.items()]
    return "motus.pick_pull", {"type": button, "value": 'PRESS', **modifiers}, {"properties": properties}  # type: ignore[misc]


def _adjust(key, number, steps=0, **modifiers):
    properties = [("number", number)] + ([("steps", steps)] if steps else [])
    return "motus.pull_adjust", {"type": key, "value": 'PRESS', **modifiers}, {"properties": properties}


TOOL_KEYMAP = (
    _stroke('LEFTMOUSE'),
    _stroke('LEFTMOUSE', ctrl=True, is_down=True),
    _stroke('LEFTMOUSE', shift=True, is_smooth=True),
    # If the right button selects in the keymap of the user, the operator passes the event on.
    _stroke('RIGHTMOUSE', is_down=True),
    _adjust('F', 'RADIUS'),
    _adjust('F', 'STRENGTH', shift=True),
    _adjust('LEFT_BRACKET', 'RADIUS', steps=-1),
    _adjust('RIGHT_BRACKET', 'RADIUS', steps=1),
)
