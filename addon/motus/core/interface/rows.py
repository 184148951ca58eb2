"""Rows of settings, declared once: a panel draws them for a property group, the redo panel for an operator's keywords."""

from collections.abc import Callable
from dataclasses import dataclass

import bpy

from .view import widths


def is_one_of(name, *values):
    """Condition for a row: the setting of this name has one of the values."""
    return lambda settings: getattr(settings, name) in values


def is_not(name, *values):
    """Condition for a row: the setting of this name has none of the values."""
    return lambda settings: getattr(settings, name) not in values


def is_positive(name):
    """Condition for a row: the setting of this name is above 0."""
    return lambda settings: getattr(settings, name) > 0.0


def is_given(name):
    """Condition for a row: the operator's keyword of this name was set, by the caller or by the operator itself."""
    return lambda operator: operator.is_given(name)


@dataclass(frozen=True)
class Row:
    """One property in a panel or in the redo panel.

    name: of the property. when: condition on the settings; if it is false the row is not drawn, None draws it always. active: condition on
    the settings; if it is false the row is dimmed. switch: name of a boolean property that is drawn before the field. search: function of
    the settings that returns (data, name of a collection in it), from which the user chooses a name. expand: draws all items of an
    enumeration, side by side, or one below the other if `stacks` is true. text: label instead of the property's name. text_ctxt:
    translation context of `text`.
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
        """Names of all properties that the row draws: the switch, if there is one, and the property itself."""
        return (self.switch, self.name) if self.switch else (self.name,)

    def fits(self, settings):
        """Whether the region that is drawn is wide enough for the row.

        A label needs room beside its field, a checkbox's label and expanded items need room among the fields.
        """
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
        """Draw the row, unless its condition `when` is false for the settings. settings: property group, or an operator."""
        if self.when and not self.when(settings):
            return
        words = {} if self.text is None else {"text": self.text, "text_ctxt": self.text_ctxt}
        properties = _properties(settings)
        if self.expand and not self.stacks:
            # Blender draws the property's name beside expanded items only if labels are split from fields.
            row = layout.row(align=True, heading="" if layout.use_property_split else properties[self.name].name)
        else:
            row = layout.column(align=True)  # in a row the components of a vector would be too narrow
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
            # Blender prints a warning if the subtype of a number with a unit is read.
            is_factor = prop.unit == 'NONE' and prop.subtype == 'FACTOR'
            row.prop(settings, self.name, slider=is_factor, expand=self.expand, **words)


@dataclass(frozen=True)
class Rows:
    """A group of rows, with a title if it is not empty. rows: Row objects, or names of properties. when: condition for the group."""

    rows: tuple
    title: str = ""
    text_ctxt: str = "*"
    when: Callable | None = None

    @property
    def names(self):
        """Names of all properties that the group's rows can draw."""
        return tuple(name for row in self._rows for name in row.names)

    @property
    def _rows(self):
        return [row if isinstance(row, Row) else Row(row) for row in self.rows]

    def draw(self, layout, settings, has_title=False):
        """Draw the rows whose conditions are true for the settings. has_title: whether the title is drawn, if there is one."""
        shown = [row for row in self._rows if row.when is None or row.when(settings)]
        if not shown or (self.when and not self.when(settings)):
            return
        column = layout.column()
        if column.use_property_split and not all(row.fits(settings) for row in shown):
            column.use_property_split = False  # labels are drawn inside the fields then
        if has_title and self.title:
            column.label(text=self.title, text_ctxt=self.text_ctxt)
        for row in shown:
            row.draw(column, settings)


def _properties(settings):
    """RNA properties of a property group, or of an operator's keywords."""
    return getattr(settings, "properties", settings).bl_rna.properties
