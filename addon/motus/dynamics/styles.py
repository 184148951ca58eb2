"""Styles: filters with names, such as "Bouncy"."""

import bpy

from . import filters

CUSTOM = 'CUSTOM'
STYLES = (  # identifier, label, description, (frequency, damping, response)
    ('CRITICAL', "Critical", "Follows smoothly and never overshoots", (2.0, 1.0, 0.0)),
    ('BOUNCY', "Bouncy", "Overshoots, and swings some times before it rests", (2.0, 0.3, 0.0)),
    ('JELLY', "Jelly", "Trembles for long", (3.5, 0.1, 0.5)),
    ('HEAVY', "Sluggish", "Is slow to start and slow to stop", (0.8, 0.9, 0.0)),
    ('SNAPPY', "Snappy", "Is there at once, with a short overshoot", (4.0, 0.6, 1.5)),
    ('ANTICIPATING', "Anticipating", "Winds up to the other side before it starts", (2.0, 0.6, -1.5)),
    ('FLOPPY', "Floppy", "Trails behind and swings wide: tails, hair, antennae", (1.4, 0.25, 0.0)),
    ('SMOOTH', "Smooth", "Takes the jerks out of a motion", (3.0, 1.6, 1.0)),
)
NUMBERS = {identifier: numbers for identifier, _, _, numbers in STYLES}
ITEMS = ((CUSTOM, "Custom", "Numbers that no style has"), *((name, label, told) for name, label, told, _ in STYLES))
SAME = 1e-5


def of(entry):
    """Return the index in ITEMS of the style that has an entry's numbers; 0, for Custom, if no style has them."""
    present = filters.numbers(entry)
    for index, (_, _, _, numbers) in enumerate(STYLES):
        if all(abs(one - other) < SAME for one, other in zip(present, numbers)):
            return index + 1
    return 0


def label_of(entry):
    """Return the label of an entry's style in the user's language."""
    return bpy.app.translations.pgettext_iface(ITEMS[of(entry)][1])


def put(entry, index):
    """Give an entry the numbers of a style. index: in ITEMS; 0, for Custom, changes nothing."""
    if index > 0:
        for name, number in zip(filters.NUMBERS, STYLES[index - 1][3]):
            setattr(entry, name, number)
