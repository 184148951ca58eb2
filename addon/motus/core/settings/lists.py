"""Add, remove, move and replace items of lists in settings, so that library overrides keep what they are given.

A list is a collection property. Blender finds the items that an override has added by their names when it loads a file: of several items
without a name only the first would be there again. So each item is given a name that the list does not have yet. The items that an override
has from its library come first. Blender neither removes nor moves them, and clear() leaves them in the list without a word.
"""

from ..file import libraries
from ..refusals import Refused
from ..translations import tr


def count_from_library(items):
    """Number of items of a list that a library override has from its library; these items come first."""
    return libraries.count_from_library(items.id_data, items.path_from_id())


def add(items, name):
    """Add an item to a list; returns the item. name: of the item, which no other item of the list has."""
    item = items.add()
    item.name = name
    return item


def add_numbered(items, word):
    """Add an item to a list whose items need no name of their own; returns the item, which is called by a word and a free number."""
    number, taken = len(items) + 1, set(items.keys())
    while f"{word} {number}" in taken:
        number += 1
    return add(items, f"{word} {number}")


def check_own(items, indices):
    """Raise Refused if an override has an item at one of these indices from its library, so that it can be neither removed nor moved."""
    first = min(indices, default=len(items))
    if first >= count_from_library(items):
        return
    item, owner = items[first], items.id_data
    label = item.name or f"{tr(_property(items).name)} {first + 1}"
    if "is_muted" in item.bl_rna.properties:
        sentence = tr("{item} of {object} is from its library and cannot be removed or moved here: mute it")
    else:
        sentence = tr("{item} of {object} is from its library and cannot be removed or moved here")
    raise Refused(sentence.format(item=label, object=owner.name))


def remove(items, index):
    """Remove the item at an index from a list. Raises Refused if an override has the item from its library."""
    check_own(items, [index])
    items.remove(index)


def move(items, index, place):
    """Move the item at an index of a list to the index `place`. Raises Refused if an override has an item on the way from its library."""
    check_own(items, [index, place])
    items.move(index, place)


def library_first(items, rows, is_same):
    """Sort rows for replace(): first those of the items that an override has from its library, in the order of the items.

    is_same(item, row): whether a row is of an item.
    """
    kept = [items[index] for index in range(count_from_library(items))]
    return sorted(rows, key=lambda row: next((index for index, item in enumerate(kept) if is_same(item, row)), len(kept)))


def same_name(item, row):
    """Whether a row of replace() has the name of an item."""
    return item.name == row["name"]


def check_replaceable(items, rows, is_same=lambda _item, _row: True):
    """Raise Refused if replace() could not replace the items of a list by these rows."""
    lost = [index for index in range(count_from_library(items)) if index >= len(rows) or not is_same(items[index], rows[index])]
    check_own(items, lost)


def replace(items, rows, word="", is_same=lambda _item, _row: True):
    """Replace the items of a list by rows, {setting: value}, of which the first go into the items that an override has from its library.

    word: by which items are called if the rows have no "name", as in add_numbered(). is_same(item, row): whether an item of the library may
    take a row. Raises Refused, before anything is changed, if an item of the library would be left over, or may not take its row.
    """
    check_replaceable(items, rows, is_same)
    kept = count_from_library(items)
    for index in range(len(items) - 1, kept - 1, -1):
        items.remove(index)
    for index, row in enumerate(rows):
        if index < kept:
            item = items[index]
        else:
            item = add(items, row["name"]) if "name" in row else add_numbered(items, word)
        for setting, value in row.items():
            if setting != "name":  # an override whose item has another name than the library's would have both after loading
                _set(item, setting, value)


def _set(item, setting, value):
    """Set a setting if its value differs: each setting that was ever set makes the file larger."""
    present = getattr(item, setting)
    if (tuple(present) if isinstance(value, tuple) else present) != value:
        setattr(item, setting, value)


def _property(items):
    """The RNA property of a list."""
    return items.data.bl_rna.properties[items.path_from_id().rpartition(".")[2]]
