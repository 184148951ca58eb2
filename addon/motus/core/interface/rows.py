"""Rows of settings, declared once: a panel draws them for the settings, and the redo panel for an operator's keywords."""

from collections.abc import Callable
from dataclasses import dataclass

import bpy

from .view import widths


def is_one_of(name, *values):
    """A condition: the setting has one of the values."""
    return lambda settings: getattr(settings, name) in values


def is_not(name, *values):
    """A condition: the setting has another value."""
    return lambda settings: getattr(settings, name) not in values


def is_positive(name):
    """A condition: the setting is above 0."""
    return lambda settings: getattr(settings, name) > 0.0


def is_given(name):
    """A condition: the caller of the operator gave the keyword, or it has set it itself."""
    return lambda operator: operator.is_given(name)


@dataclass(frozen=True)
class Row:
    """One property.

    when: condition on the settings; without it the row is always there. active: condition, or the row is drawn dim.
    switch: name of a boolean that stands before the field. search: gives (data, name of a collection of it) to choose
    a name from. expand: shows all items of an enumeration, one below the other where it `stacks`. text: another label than
    the property's name.
    """

    name: str
    when: Callable | None = None
    active: Callable | None = None
    switch: str = ""
    search: Callable | None = None
    expand: bool = False
    stacks: bool = False
    text: str | None = None
    text_ctxt: str = ""

    @property
    def names(self):
        """Names of all properties that the row draws."""
        return (self.switch, self.name) if self.switch else (self.name,)

    def fits(self, settings):
        """Whether the region that is drawn has room for the label, or the items, beside or among the fields."""
        prop = _properties(settings)[self.name]
        label = bpy.app.translations.pgettext_iface(
            prop.name if self.text is None else self.text, self.text_ctxt or prop.translation_context
        )
        if prop.type == 'BOOLEAN' and not prop.is_array:
            return widths.switch_fits(label)
        if self.expand and not self.stacks:
            items = [bpy.app.translations.pgettext_iface(item.name, prop.translation_context) for item in prop.enum_items]
            return widths.label_fits(label) and widths.items_fit(items)
        return widths.label_fits(label)

    def draw(self, layout, settings):
        """Draw the property, unless the row's condition `when` is false for these settings."""
        if self.when and not self.when(settings):
            return
        words = {} if self.text is None else {"text": self.text, "text_ctxt": self.text_ctxt}
        properties = _properties(settings)
        if self.expand and not self.stacks:
            # Only beside fields do items that stand side by side have the property's name.
            row = layout.row(align=True, heading="" if layout.use_property_split else properties[self.name].name)
        else:
            row = layout.column(align=True)  # in a row the parts of a vector would be too narrow
        row.active = self.active is None or bool(self.active(settings))
        if self.switch:
            row = layout.row(heading=properties[self.name].name, align=True)
            row.prop(settings, self.switch, text="")
            row = row.row(align=True)
            row.active, words = getattr(settings, self.switch), {"text": ""}
        if self.search:
            row.prop_search(settings, self.name, *self.search(settings), **words)
        else:
            prop = properties[self.name]
            # Of a number with another unit Blender warns when its subtype is asked for.
            is_factor = prop.unit == 'NONE' and prop.subtype == 'FACTOR'
            row.prop(settings, self.name, slider=is_factor, expand=self.expand, **words)


@dataclass(frozen=True)
class Rows:
    """Rows that belong together, under a title where they have one. rows: of Row, or names of properties."""

    rows: tuple
    title: str = ""
    text_ctxt: str = "*"
    when: Callable | None = None

    @property
    def names(self):
        """Names of all properties that can be drawn."""
        return tuple(name for row in self._rows for name in row.names)

    @property
    def _rows(self):
        return [row if isinstance(row, Row) else Row(row) for row in self.rows]

    def draw(self, layout, settings, has_title=False):
        """Draw the rows that matter, and the title where several groups stand below each other."""
        shown = [row for row in self._rows if row.when is None or row.when(settings)]
        if not shown or (self.when and not self.when(settings)):
            return
        column = layout.column()
        if column.use_property_split and not all(row.fits(settings) for row in shown):
            column.use_property_split = False  # labels stand within the fields then
        if has_title and self.title:
            column.label(text=self.title, text_ctxt=self.text_ctxt)
        for row in shown:
            row.draw(column, settings)


def _properties(settings):
    """RNA properties of settings, or of an operator's keywords."""
    return getattr(settings, "properties", settings).bl_rna.properties
