"""Lets Blender evaluate again what it has given up while the add-on was not there.

Blender marks a driver as invalid if its function or a property that it reads is missing, and leaves it out from then on. The
order of evaluation knows nothing of properties that were missing when it was built. Editors that list an F-curve of a missing
property switch the F-curve off. All of this outlasts the moment at which the add-on is enabled; only loading a file ends it.
"""

import itertools

import bpy
from bpy.app.handlers import persistent

from ...blender import actions, datablocks, handlers
from . import heal

_NAME = "motus"
"""What all our driver functions, properties and custom properties have in their names."""


class _Revival:
    """is_due: whether Blender has evaluated the open file without the add-on."""

    is_due = False


_revival = _Revival()


def revive():
    """Switch the drivers and F-curves on again that need Motus, those of linked data too, which costs in memory only."""
    for holder in datablocks.everything():
        animation = getattr(holder, "animation_data", None)
        for curve in animation.drivers if animation else ():
            if _needs_motus(curve):
                curve.is_valid = True
                # Has Blender compile it, clear the mark, and build the order of evaluation anew.
                curve.driver.expression = curve.driver.expression
    for action in bpy.data.actions:
        for curve in itertools.chain.from_iterable(actions.all_fcurves(action)):
            if not curve.is_valid and curve.data_path.startswith(_NAME):
                curve.is_valid = True
                action.update_tag()


def _needs_motus(curve):
    if _NAME in curve.data_path or _NAME in curve.driver.expression:
        return True
    return any(_NAME in target.data_path for variable in curve.driver.variables for target in variable.targets)


@persistent
def _catch_up(*_):
    """Before the first evaluation that the add-on sees, of a file that was there before it."""
    if _revival.is_due:
        _revival.is_due = False
        revive()
        heal.loaded()


@persistent
def _forget(*_):
    _revival.is_due = False


def _watched():
    found = bpy.app.handlers
    return [(functions, _catch_up) for functions in (found.depsgraph_update_pre, found.frame_change_pre, found.render_init)] + [
        (found.load_post, _forget)
    ]


def register():
    """Revive as soon as Blender lets add-ons see the file, which it does not while they are enabled."""
    _revival.is_due = True
    handlers.add(_watched())
    bpy.app.timers.register(_catch_up, first_interval=0.0)


def unregister():
    """Wait no more for Blender to let add-ons see the file."""
    if bpy.app.timers.is_registered(_catch_up):
        bpy.app.timers.unregister(_catch_up)
    handlers.remove(_watched())
    _revival.is_due = False
