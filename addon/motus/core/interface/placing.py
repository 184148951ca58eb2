"""Where and how turned an operator adds a new object, as Blender's own Add operators ask for it."""

from bpy_extras.object_utils import AddObjectHelper, add_object_align_init

from ..refusals import Refused, check_finite
from ..translations import tr
from .rows import Row, Rows, is_given


class Placed(AddObjectHelper):
    """Mixin of operators that add an object: the properties align, location and rotation, and the matrix that they give."""

    def place(self, context):
        """World matrix of the new object, by the operator's properties, the 3D cursor and the preferences.

        Raises Refused if a number is not finite, or if there is no view to align to.
        """
        check_finite(self, ("location", "rotation"))
        if not self.is_given("rotation"):  # otherwise Blender would take the alignment of the preferences, whatever the caller has given
            if not self.properties.is_property_set("align", ghost=False):
                self.align = context.preferences.edit.object_align
            self.rotation = 0.0, 0.0, 0.0
        if self.align == 'VIEW' and getattr(context.space_data, "type", "") != 'VIEW_3D':
            raise Refused(tr("There is no 3D view to align to: choose another alignment"))
        return add_object_align_init(context, self)


def rows(when=None):
    """Make the Rows of a new object's place for the redo panel. when: condition for the group, or None."""
    return Rows(("align", Row("location", when=is_given("location")), "rotation"), title="Place", when=when)
