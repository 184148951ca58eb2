"""Wires an owner again when its settings have become driven.

A solver on its owner sees keyed and edited settings, but cannot wait for driven ones (see attaching). Nobody tells an add-on
that a driver was added, so the solver itself notices, and the owner is wired again as soon as Blender has finished the
evaluation; Blender then evaluates once more. This happens once, and its result is the same whoever evaluates first.
"""

import bpy
from bpy.app.handlers import persistent

from ..system import of_owner, registered

_asked = set()

CONSTRAINT_DRIVERS = 7  # of a Limit sink: six limits and the influence


def check(system, owner):
    """Called by the solver with the evaluated owner that carries it."""
    all_drivers = owner.animation_data.drivers
    if len(all_drivers) <= 1 + 2 * CONSTRAINT_DRIVERS:
        return
    if has_driven_settings(owner, of_owner(system, owner)) and not any(
            curve.driver.expression.startswith("motus_direct(") for curve in all_drivers):
        _asked.add((system.name, owner.name))


def has_driven_settings(owner, settings):
    """Whether a driver of the owner sets one of the settings."""
    prefix = settings.path_from_id() + "."
    return any(curve.data_path.startswith(prefix) for curve in owner.animation_data.drivers)


@persistent
def _heal(*_):
    from .attaching import refresh
    while _asked:
        name, owner_name = _asked.pop()
        owner = bpy.data.objects.get(owner_name)
        if owner and owner.library is None and name in registered:
            refresh(registered[name], owner)


_HANDLERS = (bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.frame_change_post)


def register():
    """Watch for what the solvers noticed."""
    for handlers in _HANDLERS:
        handlers.append(_heal)


def unregister():
    """Stop watching."""
    for handlers in _HANDLERS:
        handlers.remove(_heal)
    _asked.clear()
