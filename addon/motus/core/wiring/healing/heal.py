"""Wires owners again after changes that Blender does not report to add-ons: repairs.py has the table of these.

Solvers and Blender's handlers notice (watch.py). What is to be repaired is repaired when Blender has finished the evaluation, which
it then does once more.
"""

import logging

import bpy
from bpy.app.handlers import persistent

from ...blender import handlers
from ...evaluated import read_keys
from ..attaching import overrides
from . import relations, remains, repairs
from .watch import noticed

log = logging.getLogger(__name__)


def heal(moment, depsgraph=None):
    """Make the repairs of a moment whose signs are there."""
    event = repairs.Event(moment, depsgraph)
    for repair in repairs.at(moment):
        if noticed.in_use or not repair.needs_use:
            _try(repair, event)


def _try(repair, event):
    try:
        found = repair.sign(event)
        if found:
            repair.repair(found, event)
    except Exception:
        # A handler that raises would say so after every change.
        log.exception("Motus: this could not be mended: %s", repair.change)


def reset():
    """Forget all that was noticed in the file."""
    noticed.reset()
    overrides.forget()
    relations.forget()


@persistent
def _after_edit(_scene=None, depsgraph=None):
    # Neither what Blender keeps of an override nor what an object hangs on changes with the frame: these are looked for here alone.
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
    """Before the first evaluation of a file."""
    reset()
    heal(repairs.LOADED)


@persistent
def _arrived(*_):
    # After undo the scene may be as it was when Blender had just put helpers there.
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
    # Older Blenders lack some of the lists.
    return [(getattr(found, name), function) for name, function in lists if hasattr(found, name)]


def register():
    """Look for what is to be repaired from now on."""
    handlers.add(_watched_handlers())


def unregister():
    """Look for no repairs any more, and forget what was noticed."""
    handlers.remove(_watched_handlers())
    remains.stop()
    reset()
