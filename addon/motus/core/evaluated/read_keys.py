"""Which actions solvers and drivers have read at frames other than the present one: after an edit of such an action they run again.

Blender alone does not do that. If a script or an operator inserts or removes a key, Blender evaluates the action, but not the
datablock that the action animates, so that a pose that an artist has changed but not keyed yet is not lost. And Blender does not know
which datablocks read keys of other frames.

What is read is noted only while somebody edits, so that playback gets no slower. A solver that has run only on a change of the frame
runs once more at the first edit of keys.
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
"""Up to this many Readings are kept without a search for Readings of datablocks that Blender has freed."""

readings: dict[tuple[int, str, int], Reading] = {}
"""(address of an evaluated datablock, name, index) -> Reading of a solver or driver on the datablock."""
_most = [FEW]
_at_work: dict[int, list[dict[int, int]]] = {}
"""Thread -> for each Reading at work, the innermost last: {address of an evaluated action: number of the action's copy that was read}."""


class Reading:
    """Record of the actions that a solver or driver on an evaluated datablock has read. Within `with`, it records what its thread reads.

    among(datablock): gives the actions that the solver or driver can read at all; None if it can read any action.
    """

    def __init__(self, datablock: Any, among: Callable[[Any], Iterable[Any]] | None) -> None:
        self.datablock, self._among = datablock, among
        self.original: Any = None
        self._numbers: dict[int, int] | None = None  # None: not known
        self._frame: float | None = None

    def is_edit(self, frame: float) -> bool:
        """Whether the solver or driver runs again on the same frame, because somebody edits: its reads are to be noted then.

        Called with the present frame before anything is read.
        """
        # Stored here: after Blender has removed the original, `datablock.original` would point to freed memory.
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
        """Whether the datablock still exists and belongs to a depsgraph, not to that of a different scene or of a render that has ended."""
        if self.original is None or copies.is_gone(self.original) or copies.is_gone(self.datablock):
            return False
        return self.original.evaluated_get(depsgraph) == self.datablock

    def is_outdated(self, edited: dict[int, int | None]) -> bool:
        """Whether the solver or driver may have read keys that have been edited since.

        edited: {address of an evaluated action that was edited: number of its present copy}. If it is not known what was read, every
        edited action counts that the solver or driver can read at all.
        """
        numbers = self._numbers
        if numbers is None:
            return self._among is None or any(action.as_pointer() in edited for action in self._among(self.datablock))
        return any(numbers.get(place, number) != number for place, number in edited.items())


def reading_of(datablock: Any, name: str, index: int = 0, among: Callable[[Any], Iterable[Any]] | None = None) -> Reading:
    """The Reading of a solver or driver on an evaluated datablock; a new Reading if Blender has copied the datablock anew.

    name: name of the solver's system, or of the driven property. index: index of an array's element. among(datablock): gives the
    actions that the solver or driver can read at all; None if it can read any action.
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
    """Number of an evaluated copy of an action, for code that is about to read its keys; None for an original action.

    The Reading that is entered in this thread, if any, records that its solver or driver has read the action.
    """
    number = copies.number_of_action(action)
    if _at_work and number is not None:
        note({action.as_pointer(): number})
    return number


def is_noting() -> bool:
    """Whether a solver or driver that has its reads of actions recorded is running, in any thread. If not, nobody has to call number_of()."""
    return bool(_at_work)


def noted() -> dict[int, int] | None:
    """Actions that the solver or driver which runs in this thread has read so far; None if its reads are not recorded.

    Returns {address of an evaluated action: number of its copy}. A second solver that reuses the first one's result passes it to note().
    """
    waiting = _at_work.get(threading.get_ident())
    return dict(waiting[-1]) if waiting else None


def note(numbers: dict[int, int] | None) -> bool:
    """Let the Reading at work in this thread note actions as read.

    numbers: {address of an evaluated action: number of its copy} as noted() returns it; None if it is not known what was read.
    Returns False if a Reading is at work and `numbers` is None, so that the Reading is incomplete; True otherwise.
    """
    waiting = _at_work.get(threading.get_ident())
    if waiting and numbers is not None:
        waiting[-1].update(numbers)
    return not waiting or numbers is not None


def call_again(depsgraph: bpy.types.Depsgraph) -> None:
    """After an edit of actions, tag for evaluation the originals whose solvers or drivers may have read keys as they were before."""
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
    """Add the handler that forgets all Readings when another file is opened. core/wiring/healing/heal.py reports edits to call_again()."""
    handlers.add(_watched())


def unregister() -> None:
    """Remove the handler, and forget all Readings."""
    handlers.remove(_watched())
    _forget()
