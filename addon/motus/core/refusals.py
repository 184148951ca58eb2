"""What operators refuse, whichever system is theirs: a sentence says why."""

import math

import bpy

from .translations import tr


class Refused(Exception):
    """What was asked cannot be done; the sentence says why."""


def check_finite(operator, names):
    """Refuse keywords that were given something that is no number."""
    for name in names:
        value = getattr(operator, name)
        parts = value if hasattr(value, "__len__") else (value,)
        if not all(math.isfinite(part) for part in parts if isinstance(part, float)):
            raise Refused(tr("{keyword} is not a finite number").format(keyword=name))


def check_no_tweak_mode(obj):
    """Refuse an object whose actions Blender does not let be exchanged, and whose keys would go into a strip of the NLA."""
    if obj.animation_data and obj.animation_data.use_tweak_mode:
        raise Refused(tr("{object} is in the tweak mode of the NLA editor: leave it first").format(object=obj.name))


def check_evaluated(obj, view_layer):
    """Refuse an object that Blender does not evaluate: of what it does over time nothing is known."""
    view_layer.update()
    if not obj.evaluated_get(view_layer.depsgraph).is_evaluated:
        _refuse_hidden(obj)


def check_posed(rig, view_layer):
    """The same for a rig's bones, and refuse one that shows its rest pose."""
    check_evaluated(rig, view_layer)
    # Of a hidden rig Blender evaluates those bones that something visible needs, and lists it nowhere.
    if not any(one.original == rig for one in view_layer.depsgraph.ids if isinstance(one, bpy.types.Object)):
        _refuse_hidden(rig)
    if rig.data.pose_position == 'REST':
        raise Refused(tr("{object} is in Rest Position: switch to Pose Position first").format(object=rig.name))


def _refuse_hidden(obj):
    raise Refused(tr("{object} is not evaluated: show it in the viewport first").format(object=obj.name))
