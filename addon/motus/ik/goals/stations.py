"""Stations of a Blend: the target (0) and the further ones (1, 2, ...), and what becomes of those that are missing."""

import itertools

from ...core.file import deleted
from ...core.file.pointers import pointed

STANDS = 1e-4
"""A Blend this near to a whole number stands on one target."""


class Further:
    """Tells which further targets of a group's evaluated entries exist; looks again only after something was deleted."""

    def __init__(self, entries):
        self._entries, self._changes, self._there = entries, None, {}

    def there(self):
        """{row of an entry: whether each of its further targets exists}, for the entries that have further targets.

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
    """(numbers of the stations on both sides of a Blend, share of the way from the first of them to the second).

    places: of all stations, None for a missing one, which is left out where the Blend stands on another.
    """
    blend = min(blend, len(places) - 1.0)
    first = min(int(blend), len(places) - 2)
    share = blend - first
    ends = (first, 1.0 - share), (first + 1, share)
    return [number for number, weight in ends if weight > STANDS or places[number] is not None], share


def nearest(number, places):
    """The place of a station, or of the nearest existing one before it; None if all of these are missing."""
    return next((place for place in places[number::-1] if place is not None), None)


def without(blend, number):
    """The value of Blend after a station was removed: a Blend that passed to the removed station stays at the one before it."""
    return min(blend, max(blend - 1.0, number - 1.0))
