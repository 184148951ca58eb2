"""Make Blender evaluate drivers and F-curves again that Blender has switched off while the add-on was disabled.

Blender marks a driver as invalid if its function or a property that the driver reads is missing, and no longer evaluates the driver. The
dependency graph lacks relations to properties that were missing when the graph was built. Editors that list an F-curve of a missing
property switch the F-curve off. All of this remains after the add-on is enabled; without this module only loading a file would end it.
"""

import itertools

import bpy
from bpy.app.handlers import persistent

from ...blender import actions, datablocks, handlers
from . import heal

_NAME = "motus"
"""Text that the names of all driver functions, properties and custom properties of Motus contain."""


class _Revival:
    """State of this module. is_due: whether Blender has evaluated the open file without the add-on."""

    is_due = False


_revival = _Revival()


def revive():
    """Switch on again all drivers and F-curves that need Motus and that Blender has switched off while the add-on was disabled.

    Those of linked data are included, and are changed in memory only.
    """
    for holder in datablocks.everything():
        animation = getattr(holder, "animation_data", None)
        for curve in animation.drivers if animation else ():
            if _needs_motus(curve):
                curve.is_valid = True
                # Assigning the expression makes Blender compile it, clear the invalid mark and rebuild the dependency graph.
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
    """Handler that revives drivers and repairs the wiring before the first evaluation of a file since the add-on was enabled.

    Nothing happens if the file was loaded while the add-on was enabled.
    """
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
    """Revive drivers as soon as Blender gives the add-on access to the file. Blender gives no access while it enables add-ons."""
    _revival.is_due = True
    handlers.add(_watched())
    bpy.app.timers.register(_catch_up, first_interval=0.0)


def unregister():
    """Remove the timer and handlers that wait for access to the file."""
    if bpy.app.timers.is_registered(_catch_up):
        bpy.app.timers.unregister(_catch_up)
    handlers.remove(_watched())
    _revival.is_due = False
