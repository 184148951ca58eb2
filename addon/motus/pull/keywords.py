"""Read the keywords of the operators that pull: the object to pull and the values of the brush."""

from ..core.refusals import Refused, named
from ..core.translations import tr
from .brush import Brush
from .properties import KEYWORDS, is_finite


def object_of(operator, context):
    """Return the object that the operator's keyword `object` names, or the active object. Raises Refused if there is none."""
    if not operator.object:
        if context.object is None:
            raise Refused(tr("Select a mesh"))
        return context.object
    return named(operator.object)


def brush_of(operator, context):
    """Return the scene's Brush, with the operator's given keywords in place of its values.

    Raises Refused if the values have no meaning.
    """
    names = [name for name in (*KEYWORDS, "curve") if operator.properties.is_property_set(name)]
    given = {name: getattr(operator, name) for name in names}
    for name in ("location", "displacement"):
        if not is_finite(getattr(operator, name)):
            raise Refused(tr("{keyword} is not a finite number").format(keyword=name))
    return Brush.of(context.scene.motus.pull, given)


def show(operator, brush):
    """Copy a Brush into the operator's keywords, so that Adjust Last Operation shows the values that were used and starts from them."""
    copy(brush, operator)
    if brush.curve:
        operator.curve = brush.curve


def copy(brush, target):
    """Copy the values of a Brush into a property group or operator that has the properties of BrushKeywords."""
    for name in KEYWORDS:
        value = getattr(brush, name)
        setattr(target, name, set(value) if name == "mirror" else value)
