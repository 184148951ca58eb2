"""Keywords of the operators that pull: the object and the brush that they name."""

from ..core.refusals import Refused, named
from ..core.translations import tr
from .brush import Brush
from .properties import KEYWORDS, is_finite


def object_of(operator, context):
    """The object that the operator's keyword `object` names, or the active one. Raises Refused if there is none."""
    if not operator.object:
        if context.object is None:
            raise Refused(tr("Select a mesh"))
        return context.object
    return named(operator.object)


def brush_of(operator, context):
    """The scene's brush, with the keywords that were given in place of its own values. Raises Refused for values without meaning."""
    names = [name for name in (*KEYWORDS, "curve") if operator.properties.is_property_set(name)]
    given = {name: getattr(operator, name) for name in names}
    for name in ("location", "displacement"):
        if not is_finite(getattr(operator, name)):
            raise Refused(tr("{keyword} is not a finite number").format(keyword=name))
    return Brush.of(context.scene.motus.pull, given)


def show(operator, brush):
    """Set the operator's keywords to the brush, so that the redo panel shows what was done and starts from it."""
    copy(brush, operator)
    if brush.curve:
        operator.curve = brush.curve


def copy(brush, target):
    """Copy a brush's values into an object with BrushKeywords."""
    for name in KEYWORDS:
        value = getattr(brush, name)
        setattr(target, name, set(value) if name == "mirror" else value)
