"""Texts for the viewport's header and the status bar: the state of the brush, and the keys of the tool."""

import bpy

from ...core.interface.dragging.number_entry import NumberEntry
from ...core.translations import tr

RADIUS, STRENGTH = "radius", "strength"
LABELS = {RADIUS: "Radius", STRENGTH: "Strength"}


def length(context, value):
    """Text of a length in the scene's unit. value: in Blender units."""
    units = context.scene.unit_settings
    system = 'METRIC' if units.system == 'NONE' else units.system
    return bpy.utils.units.to_string(system, 'LENGTH', value * units.scale_length, precision=3)


def label(text):
    """Translate a label of Blender's interface into the user's language."""
    return bpy.app.translations.pgettext_iface(text)


def value(context, brush, name):
    """Text of the brush's radius or strength with its unit. name: of the property."""
    number = getattr(brush, name)
    if name == RADIUS and brush.distance == 'EDGES':
        return tr("{count} edges").format(count=round(number))
    return length(context, number)


def pair(context, brush, name, entry: NumberEntry | None = None):
    """Text of the brush's radius or strength with its label.

    entry: characters that the user is typing, which are shown in place of the value; or None.
    """
    shown = f"{entry.text}|" if entry is not None and entry.is_open else value(context, brush, name)
    return f"{label(LABELS[name])} {shown}"


def item_label(settings, brush, name):
    """Translated label of the item that is set in an enum property of the brush."""
    return label(settings.bl_rna.properties[name].enum_items[getattr(brush, name)].name)


def numbers(brush, adjusted=None):
    """Names of the numbers of the brush that the header shows.

    adjusted: name of the number that the user is typing or dragging, or None.
    """
    return (RADIUS,) if brush.direction == 'CURSOR' and adjusted != STRENGTH else (RADIUS, STRENGTH)


def drag_header(context, settings, session, drag):
    """Text for the viewport's header during a drag: length and axis of the displacement."""
    return drag.header(context, item_label(settings, session.brush, "unit"), length)


def header(context, settings, brush, entry, adjusted):
    """Text for the viewport's header with the state of the brush.

    entry: characters that the user is typing. adjusted: name of the number that the user is typing or dragging, or None.
    """
    parts = [pair(context, brush, name, entry if adjusted == name else None) for name in numbers(brush, adjusted)]
    parts += [item_label(settings, brush, name) for name in ("falloff", "distance", "direction")]
    if brush.accumulate and brush.direction != 'CURSOR':
        parts.append(label("Accumulate"))
    if brush.mirror:
        parts.append(f"{label('Mirror')} {' '.join(sorted(brush.mirror))}")
    return "    ".join(parts)


class Key:
    """Description of what a group of keys does, with the icons of the keys for the status bar."""

    def __init__(self, text, *icons):
        self.text, self.icons = text, icons


RADIUS_KEY = Key("Radius", 'EVENT_F')
PRECISION_KEY = Key("Precision Mode", 'EVENT_SHIFT')
SHAPE_KEYS = (Key("Direction", 'EVENT_D'), Key("Falloff", 'EVENT_O'))
LAST_KEYS = (
    Key("Mirror", 'EVENT_X', 'EVENT_Y', 'EVENT_Z'),
    Key("Inset View", 'EVENT_I'),
    Key("Zoom", 'MOUSE_MMB_SCROLL'),
    Key("Confirm", 'EVENT_RETURN'),
    Key("Cancel", 'EVENT_ESC'),
)
SESSION_KEYS = (
    Key("Pull Up", 'MOUSE_LMB'),
    Key("Pull Down", 'MOUSE_RMB'),
    Key("Invert", 'EVENT_CTRL'),
    Key("Smooth", 'EVENT_SHIFT'),
    RADIUS_KEY,
    Key("Strength", 'EVENT_SHIFT', 'EVENT_F'),
    *SHAPE_KEYS,
    Key("Accumulate", 'EVENT_A'),
    *LAST_KEYS,
)
GRABBING_KEYS = (Key("Grab", 'MOUSE_LMB_DRAG'), Key("Smooth", 'EVENT_SHIFT'), RADIUS_KEY, *SHAPE_KEYS, *LAST_KEYS)
DRAGGING_KEYS = (
    Key("Lock Axis", 'EVENT_X', 'EVENT_Y', 'EVENT_Z'),
    PRECISION_KEY,
    Key("Type the Length"),
    Key("Confirm", 'EVENT_RETURN'),
    Key("Cancel", 'MOUSE_RMB', 'EVENT_ESC'),
)
ADJUSTING_KEYS = (Key("Confirm", 'MOUSE_LMB'), Key("Cancel", 'MOUSE_RMB', 'EVENT_ESC'), PRECISION_KEY)


def drawn(keys):
    """Return a function for WorkSpace.status_text_set() that draws the icons of keys with their descriptions."""
    known = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
    shown = [([icon for icon in key.icons if icon in known], key.text) for key in keys]

    def draw(bar, _context):
        row = bar.layout.row(align=True)
        for icons, text in shown:
            for icon in icons[:-1]:
                row.label(text="", icon=icon)
            row.label(text=text, icon=icons[-1] if icons else 'NONE')
            row.separator()

    return draw
