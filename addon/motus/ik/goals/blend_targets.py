"""Targets between which the setting Blend of a chain passes, by their numbers: its target (0) and its further targets (1, 2, ...).

A target that is missing counts as the nearest existing target before it.
"""

import itertools

from ...core.file import deleted
from ...core.file.pointers import pointed

STANDS = 1e-4
"""Largest distance of Blend from a whole number at which the chain counts as at one target, not between two."""


class Further:
    """Finds which further targets of a group's evaluated entries exist. The result is kept until objects are deleted or restored."""

    def __init__(self, entries):
        self._entries, self._changes, self._there = entries, None, {}

    def there(self):
        """{row of an entry: whether each of its further targets exists, a list}, for the entries that have further targets.

        Call this also if no Blend needs these targets yet: an object counts as deleted only if it was seen in a collection before.
        """
        # Animation cannot change pointers, so the result holds until something is deleted.
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
    """(numbers of the targets on both sides of a value of Blend, share of the way from the first of them to the second).

    places: world matrices of all targets, None for a missing one. A missing target is left out of the numbers if Blend is so
    near to a different target that the missing one is not needed.
    """
    blend = min(blend, len(places) - 1.0)
    first = min(int(blend), len(places) - 2)
    share = blend - first
    ends = (first, 1.0 - share), (first + 1, share)
    return [number for number, weight in ends if weight > STANDS or places[number] is not None], share


def nearest(number, places):
    """World matrix of the target of a number, or of the last existing target before it; None if all of these are missing."""
    return next((place for place in places[number::-1] if place is not None), None)


def without(blend, number):
    """Value of Blend after the target of a number was removed, so that the numbers of later targets have become lower by 1.

    A Blend that had passed on towards the removed target stays at the target before it.
    """
    return min(blend, max(blend - 1.0, number - 1.0))
