"""Texts in the header and the status bar: the state of the brush, and the keys of the tool."""

import bpy

from ...core.interface.dragging.number_entry import NumberEntry
from ...core.translations import tr

RADIUS, STRENGTH = "radius", "strength"
LABELS = {RADIUS: "Radius", STRENGTH: "Strength"}


def length(context, value):
    """A length in the scene's unit."""
    units = context.scene.unit_settings
    system = 'METRIC' if units.system == 'NONE' else units.system
    return bpy.utils.units.to_string(system, 'LENGTH', value * units.scale_length, precision=3)


def label(text):
    """Translate a label of the interface into the user's language."""
    return bpy.app.translations.pgettext_iface(text)


def value(context, brush, name):
    """Text of one of the brush's two numbers."""
    number = getattr(brush, name)
    if name == RADIUS and brush.distance == 'EDGES':
        return tr("{count} edges").format(count=round(number))
    return length(context, number)


def pair(context, brush, name, entry: NumberEntry | None = None):
    """Text of a number with its label. entry: characters that the user is typing instead of the number."""
    shown = f"{entry.text}|" if entry is not None and entry.is_open else value(context, brush, name)
    return f"{label(LABELS[name])} {shown}"


def item_label(settings, brush, name):
    """Label of the item that an enum of the brush has."""
    return label(settings.bl_rna.properties[name].enum_items[getattr(brush, name)].name)


def numbers(brush, adjusted=None):
    """Names of the brush's numbers that are shown. adjusted: number that is being typed or dragged, or None."""
    return (RADIUS,) if brush.direction == 'CURSOR' and adjusted != STRENGTH else (RADIUS, STRENGTH)


def drag_header(context, settings, session, drag):
    """Text for the viewport's header during a drag: length and axis of the displacement."""
    return drag.header(context, item_label(settings, session.brush, "unit"), length)


def header(context, settings, brush, entry, adjusted):
    """Text for the viewport's header. adjusted: number that is being typed or dragged, or None."""
    parts = [pair(context, brush, name, entry if adjusted == name else None) for name in numbers(brush, adjusted)]
    parts += [item_label(settings, brush, name) for name in ("falloff", "distance", "direction")]
    if brush.accumulate and brush.direction != 'CURSOR':
        parts.append(label("Accumulate"))
    if brush.mirror:
        parts.append(f"{label('Mirror')} {' '.join(sorted(brush.mirror))}")
    return "    ".join(parts)


class Key:
    """What a group of keys does, with the icons that the status bar shows for them."""

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
    """Function for the status bar that draws the icons of keys with what they do."""
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
