"""Buttons that are greyed out if their operator would refuse what is selected. Calls by scripts are told apart from these buttons."""

import bpy

OFFER = "motus_offer"
"""Name of a context member of a button: RNA type of the operator that the button offers for the selection.

Everything that runs because a button was pressed has the button's context. An operator that the offered one calls, or a user's own operator
in a menu of Motus, must not count as offered, so the member names the offered operator.
"""


def offer(layout):
    """Wrap a layout so that a button is greyed out if its operator would refuse the selection; the button's tooltip says why.

    Scripts name objects by keywords. The selection therefore counts only for operators in such a layout.
    """
    pressed.clear()
    return _OfferingLayout(layout)


class _OfferingLayout:
    """Wrapper of a UILayout whose operator buttons, also in layouts inside it, have the context member OFFER."""

    def __init__(self, layout):
        self.__dict__["_layout"] = layout

    def __setattr__(self, name, value):
        setattr(self._layout, name, value)

    def __getattr__(self, name):
        found = getattr(self._layout, name)
        return _offering(found) if name in _INNER else found

    def operator(self, operator, *arguments, **keywords):
        return self._offered(operator).operator(operator, *arguments, **keywords)

    def operator_menu_enum(self, operator, *arguments, **keywords):
        return self._offered(operator).operator_menu_enum(operator, *arguments, **keywords)

    def _offered(self, identifier):
        """Create a row for one button: a context member that is set in a layout holds for all later buttons in the layout."""
        row = self._layout.row(align=True)
        module, name = identifier.split(".")
        row.context_pointer_set(OFFER, getattr(getattr(bpy.ops, module), name).get_rna_type())
        return row


_INNER = {"box", "column", "column_flow", "grid_flow", "row", "split"}
"""Functions of a UILayout that create a layout inside it."""


def _offering(make):
    def made(*arguments, **keywords):
        return _OfferingLayout(make(*arguments, **keywords))

    return made


pressed = set()
"""Classes of operators whose buttons were pressed since buttons were last drawn.

After an operator has run, Blender polls it again to decide whether to show the redo panel. The redo panel repeats the operator on the
selection before, not on what the operator has selected, so that poll must not check the selection.
"""


def is_offered(context, cls):
    """Whether an operator is called by a button that offers it for the selection, and not by a script. cls: its class."""
    offered = getattr(context, OFFER, None)
    return offered is not None and offered.identifier == _rna_name(cls.bl_idname)


def _rna_name(identifier):
    """Name of the RNA type of the operator with this bl_idname, such as "MOTUS_OT_bake" for "motus.bake"."""
    module, name = identifier.split(".")
    return f"{module.upper()}_OT_{name}"
