"""Repair the wiring of owners after changes that Blender does not report to add-ons; repairs.py has the table of these changes.

An owner is an object whose settings Motus solves; its wiring consists of drivers, constraints and hidden objects. Solvers and handlers
detect the changes (watch.py). Repairs are made when Blender has finished the evaluation; Blender then evaluates once more.
"""

import logging
from types import SimpleNamespace

import bpy
from bpy.app.handlers import persistent

from ...blender import handlers
from ...evaluated import read_keys
from ..attaching import overrides
from . import relations, remains, repairs
from .watch import noticed

log = logging.getLogger(__name__)

_now = SimpleNamespace(is_healing=False)
"""Whether repairs are going on."""


def heal(moment, depsgraph=None):
    """Make those repairs of repairs.TABLE that are due at a moment and for which a change that needs the repair is detected.

    moment: such as repairs.EDIT. depsgraph: dependency graph that Blender has passed to the handler, or None. An exception in a repair is
    logged, not raised. Nothing is repaired if a repair is going on: a repair may call an operator, after which Blender evaluates at once,
    and what is half wired then would be wired once more.
    """
    if _now.is_healing:
        return
    _now.is_healing = True
    try:
        event = repairs.Event(moment, depsgraph)
        for repair in repairs.AT[moment]:
            if noticed.in_use or not repair.needs_use:
                try:
                    found = repair.sign(event)
                    if found:
                        repair.repair(found, event)
                except Exception:
                    # An exception in a handler would be reported after every change.
                    log.exception("Motus: this could not be mended: %s", repair.change)
    finally:
        _now.is_healing = False


def reset():
    """Forget all stored states of the open file by which changes to repair are detected.

    This is done when a different file was loaded, and when the add-on is disabled.
    """
    noticed.reset()
    overrides.forget()
    relations.forget()


@persistent
def _after_edit(_scene=None, depsgraph=None):
    # Only this handler looks for overrides that lost their wiring and for changed parents: a change of the frame causes neither.
    if noticed.in_use or read_keys.readings or overrides.has_marks():
        _after_evaluation(repairs.EDIT, depsgraph)


@persistent
def _after_frame(_scene=None, depsgraph=None):
    if noticed.in_use:
        _after_evaluation(repairs.FRAME, depsgraph)


def _after_evaluation(moment, depsgraph):
    if noticed.in_use:
        noticed.evaluations += 1
    if not bpy.app.is_job_running('RENDER'):
        heal(moment, depsgraph)


@persistent
def loaded(*_):
    """Handler of load_post: make the repairs of a loaded file, before its first evaluation."""
    reset()
    heal(repairs.LOADED)


@persistent
def _arrived(*_):
    # Undo may restore a scene in which Blender had just put helpers into collections.
    heal(repairs.ARRIVED)


@persistent
def _saving(*_):
    heal(repairs.SAVING)


@persistent
def _saved(*_):
    heal(repairs.SAVED)


def _watched_handlers():
    found = bpy.app.handlers
    lists = (
        ("undo_post", _arrived),
        ("redo_post", _arrived),
        ("blend_import_post", _arrived),
        ("depsgraph_update_post", _after_edit),
        ("frame_change_post", _after_frame),
        ("load_post", loaded),
        ("save_pre", _saving),
        ("save_post", _saved),
        ("save_post_fail", _saved),
    )
    # Older versions of Blender lack some of these handler lists.
    return [(getattr(found, name), function) for name, function in lists if hasattr(found, name)]


def register():
    """Add the handlers that look for changes to repair."""
    handlers.add(_watched_handlers())


def unregister():
    """Remove the handlers that look for changes to repair, and forget everything that was detected."""
    handlers.remove(_watched_handlers())
    remains.stop()
    reset()
