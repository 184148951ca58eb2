"""Keywords of operators that pull: which object they mean, and which brush."""

from ..core.refusals import Refused, named
from ..core.translations import tr
from .brush import Brush
from .properties import KEYWORDS, is_finite


def object_of(operator, context):
    """The object that the operator's `object` names, or the active one. Raises Refused where there is none."""
    if not operator.object:
        if context.object is None:
            raise Refused(tr("Select a mesh"))
        return context.object
    return named(operator.object)


def brush_of(operator, context):
    """The scene's brush with the keywords that were given. Raises Refused where they have no meaning."""
    names = [name for name in (*KEYWORDS, "curve") if operator.properties.is_property_set(name)]
    given = {name: getattr(operator, name) for name in names}
    for name in ("location", "displacement"):
        if not is_finite(getattr(operator, name)):
            raise Refused(tr("{keyword} is not a finite number").format(keyword=name))
    return Brush.of(context.scene.motus.pull, given)


def show(operator, brush):
    """Let the operator's keywords be those of the brush, so that Redo shows what was done and begins with it."""
    copy(brush, operator)
    if brush.curve:
        operator.curve = brush.curve


def copy(brush, target):
    """Set what has BrushKeywords to a brush's values."""
    for name in KEYWORDS:
        value = getattr(brush, name)
        setattr(target, name, set(value) if name == "mirror" else value)
