"""Stations of a Blend: the target (0) and the further ones (1, 2, ...), and what becomes of those that are missing."""

import itertools

from ...core.file import deleted
from ...core.file.pointers import pointed

STANDS = 1e-4
"""A Blend this near to a whole number stands on one target."""


class Further:
    """Which further targets of a group's evaluated entries are there: looked up again only where that may be otherwise."""

    def __init__(self, entries):
        self._entries, self._changes, self._there = entries, None, {}

    def there(self):
        """{row: whether each further target is there} of those entries that have some.

        It is asked before any Blend needs them: what was never seen in a collection would not count as deleted.
        """
        # Pointers are no settings that animation could set.
        changes = deleted.changes()
        if changes != self._changes:
            self._changes, self._there = changes, _there(self._entries)
        return self._there


def _there(entries):
    objects = [(row, pointed(extra, "object")) for row, entry in enumerate(entries) for extra in entry.extra_targets]
    gone = set(deleted.which([one for _, one in objects if one]))
    found, numbers = {}, itertools.count()
    for row, one in objects:
        found.setdefault(row, []).append(one is not None and next(numbers) not in gone)
    return found


def needed(blend, places):
    """(Numbers of the stations that a Blend is between, share of the way from the first to the last of them).

    places: of all stations, None for a missing one, which is left out where the Blend stands on another.
    """
    blend = min(blend, len(places) - 1.0)
    first = min(int(blend), len(places) - 2)
    share = blend - first
    ends = (first, 1.0 - share), (first + 1, share)
    return [number for number, weight in ends if weight > STANDS or places[number] is not None], share


def nearest(number, places):
    """The place of a station, or of the nearest before it; None where all of these are missing."""
    return next((place for place in places[number::-1] if place is not None), None)


def without(blend, number):
    """A value of Blend when a station is removed: what passed to that one stays at the one before it."""
    return min(blend, max(blend - 1.0, number - 1.0))
