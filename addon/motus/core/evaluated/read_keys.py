"""Which actions solvers and drivers read keys of, at other frames than the present one: when these are edited they are called again.

Blender alone does not see to that. When a script or an operator inserts or removes a key, Blender evaluates the action, but not
what it animates, so that what an artist has moved and not keyed as yet stays. Of a datablock that reads keys of other frames
Blender knows nothing.

What is read is noted while somebody edits, not while frames go by, so that it costs playback nothing. Who was called on a frame
that has only been gone to is called once more at the first edit of keys.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

import bpy
from bpy.app.handlers import persistent

from ..blender import handlers
from . import copies

FEW = 64
"""Up to so many Readings are kept without a look at which of them are of datablocks that Blender has freed."""

readings: dict[tuple[int, str, int], Reading] = {}
"""(where an evaluated datablock lies, name, index) -> its Reading."""
_most = [FEW]
_at_work: dict[int, list[dict[int, int]]] = {}
"""Thread -> {where an evaluated action lies: number of the copy of it that was read} of each Reading at work, the inmost last."""


class Reading:
    """Actions that a solver or driver of an evaluated datablock has read; as a context manager it notes what its thread reads.

    among: gives, of the datablock, the actions that it may read at all; None: any.
    """

    def __init__(self, datablock: Any, among: Callable[[Any], Iterable[Any]] | None) -> None:
        self.datablock, self._among = datablock, among
        self.original: Any = None
        self._numbers: dict[int, int] | None = None  # nobody knows
        self._frame: float | None = None

    def is_edit(self, frame: float) -> bool:
        """Called with the frame before anything is read: whether to note what is."""
        # Not when it is wanted: once Blender has removed the original, what a copy points to in its place is freed memory.
        self.original = self.datablock.original
        if frame == self._frame:
            return True
        self._frame, self._numbers = frame, None
        return False

    def __enter__(self) -> None:
        self._numbers = {}
        _at_work.setdefault(threading.get_ident(), []).append(self._numbers)

    def __exit__(self, *_: object) -> None:
        thread = threading.get_ident()
        waiting = _at_work[thread]
        waiting.pop()
        if not waiting:
            del _at_work[thread]

    def is_of(self, depsgraph: bpy.types.Depsgraph) -> bool:
        """Whether the datablock still exists and belongs to this depsgraph, not to another scene's or to a render that has ended."""
        if self.original is None or copies.is_gone(self.original) or copies.is_gone(self.datablock):
            return False
        return self.original.evaluated_get(depsgraph) == self.datablock

    def is_outdated(self, edited: dict[int, int | None]) -> bool:
        """Whether the solver may have read keys that have been edited since. edited: {where an evaluated action lies: number of its copy}."""
        numbers = self._numbers
        if numbers is None:
            return self._among is None or any(action.as_pointer() in edited for action in self._among(self.datablock))
        return any(numbers.get(place, number) != number for place, number in edited.items())


def reading_of(datablock: Any, name: str, index: int = 0, among: Callable[[Any], Iterable[Any]] | None = None) -> Reading:
    """The Reading of a solver or driver on an evaluated datablock; a new one if Blender has copied the datablock anew.

    name: of the solver's system, or of the driven property. index: of an array's element. among: see Reading.
    """
    place = datablock.as_pointer(), name, index
    found = readings.get(place)
    if found is None or found.datablock is not datablock:
        found = readings[place] = Reading(datablock, among)
        if len(readings) > _most[0]:
            for gone in [place for place, one in list(readings.items()) if copies.is_gone(one.datablock)]:
                readings.pop(gone, None)
            _most[0] = 2 * max(len(readings), FEW)
    return found


def number_of(action: Any) -> int | None:
    """copies.number_of_action() of an action whose keys are read."""
    number = copies.number_of_action(action)
    if _at_work and number is not None:
        note({action.as_pointer(): number})
    return number


def is_noting() -> bool:
    """Whether some thread is recording which actions a solver or driver reads."""
    return bool(_at_work)


def noted() -> dict[int, int] | None:
    """The actions that the solver at work in this thread has read so far; None if no solver in this thread records them.

    Returns {address of an evaluated action: number of its copy}. Another solver that reuses the result passes them to note().
    """
    waiting = _at_work.get(threading.get_ident())
    return dict(waiting[-1]) if waiting else None


def note(numbers: dict[int, int] | None) -> bool:
    """Let these count as read by this thread. Returns whether that is known, as far as it has to be: it is not where they are None."""
    waiting = _at_work.get(threading.get_ident())
    if waiting and numbers is not None:
        waiting[-1].update(numbers)
    return not waiting or numbers is not None


def call_again(depsgraph: bpy.types.Depsgraph) -> None:
    """After an edit: have those evaluated once more that may have read keys as they were before."""
    if not depsgraph.id_type_updated('ACTION'):
        return
    edited = [update.id for update in depsgraph.updates if isinstance(update.id, bpy.types.Action)]
    numbers = {action.as_pointer(): copies.number_of_action(action) for action in edited}
    for original in {reading.original for reading in list(readings.values()) if reading.is_of(depsgraph) and reading.is_outdated(numbers)}:
        original.update_tag()


def _watched() -> tuple[handlers.Pair, ...]:
    return ((bpy.app.handlers.load_pre, _forget),)


@persistent
def _forget(*_: Any) -> None:
    readings.clear()
    _most[0] = FEW


def register() -> None:
    """Know when another file is opened. Edits are told by core/wiring/healing/heal.py."""
    handlers.add(_watched())


def unregister() -> None:
    """Stop watching."""
    handlers.remove(_watched())
    _forget()
