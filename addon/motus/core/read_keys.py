"""Which actions solvers and drivers read keys of, at other frames than the present one: when these are edited they are called again.

Blender alone does not see to that. A key that is inserted or taken away by a script or by most operators has the action evaluated,
but not what it animates, so that what an artist has moved and not keyed as yet stays; and of what hangs on keys of
other frames Blender knows nothing.
"""

import threading

import bpy
from bpy.app.handlers import persistent

from . import copies, handlers
from .latest import Latest, is_gone

_readings = Latest()
"""The Readings, by where their evaluated datablocks lie."""
_at_work = {}
"""Thread -> numbers of the Readings at work, the inmost last."""


class Reading:
    """What was read while an evaluated datablock's driver was called: as a context manager it notes what this thread reads.

    numbers: of the copies of evaluated actions, by where these lie.
    """

    def __init__(self, datablock):
        self.datablock = datablock
        self.numbers = {}

    def __enter__(self):
        _at_work.setdefault(threading.get_ident(), []).append(self.numbers)

    def __exit__(self, *_):
        thread = threading.get_ident()
        waiting = _at_work[thread]
        waiting.pop()
        if not waiting:
            del _at_work[thread]

    def is_outdated(self, edited):
        """Whether another copy was read of an action than it has now. edited: {where it lies: number of its copy}."""
        return any(self.numbers.get(place, number) != number for place, number in edited.items())


def reading_of(datablock):
    """The Reading of an evaluated datablock."""
    place = datablock.as_pointer()
    found = _readings.known.get(place)
    if found is None or is_gone(found.datablock):
        found = _readings.add(datablock, place, Reading(datablock))
    return found


def number_of(action):
    """copies.number_of_action() of an action whose keys are read."""
    number = copies.number_of_action(action)
    if number is not None:
        note({action.as_pointer(): number})
    return number


def noted():
    """What this thread has read, for note() where somebody else is given what was made of it."""
    waiting = _at_work.get(threading.get_ident())
    return dict(waiting[-1]) if waiting else {}


def note(numbers):
    """Let these count as read by this thread."""
    waiting = _at_work.get(threading.get_ident())
    if waiting:
        waiting[-1].update(numbers)


@persistent
def _call_again(_scene=None, depsgraph=None):
    """After an edit: have those evaluated once more that have read keys as they were before."""
    if not _readings.known or depsgraph is None or not depsgraph.id_type_updated('ACTION') or bpy.app.is_job_running('RENDER'):
        return
    edited = [update.id for update in depsgraph.updates if isinstance(update.id, bpy.types.Action)]
    numbers = {action.as_pointer(): copies.number_of_action(action) for action in edited}
    for reading in list(_readings.known.values()):
        if reading.is_outdated(numbers) and not is_gone(reading.datablock):
            reading.numbers.clear()
            reading.datablock.original.update_tag()


def _watched():
    return ((bpy.app.handlers.depsgraph_update_post, _call_again),)


def forget():
    """Let nothing count as read: another file is opened."""
    _readings.clear()


def register():
    """Watch for edits of keys."""
    handlers.add(_watched())


def unregister():
    """Stop watching."""
    handlers.remove(_watched())
    forget()
