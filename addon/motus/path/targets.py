"""Find the objects that an operator works on, by the names that scripts give or by selection. Raise Refused if they do not suit."""

import bpy

from ..core.file.pointers import pointed
from ..core.refusals import Refused, check_local, check_unbaked, named
from ..core.settings import lists
from ..core.translations import tr
from . import curves, members, solve
from .properties import EASE_TOLERANCE, KEYWORDS


def named_list(names):
    """Return the objects of a list of names with commas between, or all objects of the collection of this name."""
    collection = bpy.data.collections.get(names)
    if collection and names not in bpy.data.objects:
        return sorted(collection.objects, key=lambda found: found.name)
    return [named(name.strip()) for name in names.split(",") if name.strip()]


def curve_for(context, name, *owners):
    """Return the curve object of this name; without a name the active or a selected curve, or the curve that owners[0] follows."""
    if name:
        return curve_named(name)
    selected = [found for found in [context.object, *context.selected_objects] if found and found.type == 'CURVE']
    if selected:
        return selected[0]
    if owners and pointed(owners[0].motus.path, "curve"):
        return pointed(owners[0].motus.path, "curve")
    raise Refused(tr("Choose a curve to follow"))


def rail_for(name, owners):
    """Return {"rail": the curve object of this name}, for the settings of the owners; {} without a name."""
    if not name:
        return {}
    rail = curve_named(name)
    for owner in owners:
        if curve_depends_on(rail, owner):
            raise Refused(tr("{curve} is moved by {object}, so {object} cannot follow it").format(curve=name, object=owner.name))
    return {"rail": rail}


def curve_named(name):
    """Return the curve object of this name. Raises Refused if there is none."""
    found = named(name)
    if found.type != 'CURVE':
        raise Refused(tr("{object} is not a curve").format(object=name))
    return found


def selected_followers(context):
    """Return the selected objects that are no curves, the active object first.

    If there are none, returns the active object, unless it is a curve.
    """
    objects = sorted(context.selected_objects, key=lambda found: (found != context.object, found.name))
    return [found for found in objects if found.type != 'CURVE'] or [found for found in [context.object] if found and found.type != 'CURVE']


def ends_for(curve, spline, is_train):
    """Default of the setting *Ends* (an item of EXTENDS) for a new follower of a spline. spline: index, or -1 for all splines."""
    splines = curves.long_splines(curve.data.splines) if spline < 0 else curve.data.splines[spline : spline + 1]
    if splines and all(one.use_cyclic_u for one in splines):
        return 'LOOP'
    return 'LINE_UP' if is_train else 'CLAMP'


def followers_of(curve):
    """Return the objects whose path settings name the curve, sorted by name. Wagons of their trains are not included."""
    users = bpy.data.user_map(subset=[curve], key_types={'OBJECT'}, value_types={'OBJECT'})
    found = [obj for obj in users.get(curve, ()) if obj.motus.path.is_active and pointed(obj.motus.path, "curve") == curve]
    return sorted(found, key=lambda obj: obj.name_full)


def check_free(obj, curve, leader=None):
    """Raise Refused if an object cannot follow the curve.

    leader: leader of the train in which the object may be a wagon already; None for no train.
    """
    check_editable(obj)
    if obj == curve:
        raise Refused(tr("{object} cannot follow itself").format(object=obj.name))
    if curve_depends_on(curve, obj):
        raise Refused(tr("{curve} is moved by {object}, so {object} cannot follow it").format(curve=curve.name, object=obj.name))
    other = pointed(obj.motus.path, "leader")
    if other != leader and members.is_wagon(obj):
        raise Refused(tr("{object} is a wagon of {leader}: remove it from the train first").format(object=obj.name, leader=other.name))


def check_settings(obj, curve, keywords):
    """Raise Refused if the path settings of an object, with the values of `keywords` in place of the present ones, cannot work."""
    if keywords.get("ease_in", 0.0) + keywords.get("ease_out", 0.0) > 1.0 + EASE_TOLERANCE:
        raise Refused(tr("ease_in and ease_out are together more than 1"))
    wanted = {name: keywords.get(name, getattr(obj.motus.path, name)) for name in KEYWORDS}
    if wanted["forward_axis"][-1] == wanted["up_axis"][-1]:
        raise Refused(tr(solve.AXES_NOT_ACROSS.sentence))
    if curve.modifiers:  # modifiers may create splines
        return
    if not curve.data.splines:
        raise Refused(tr(curves.NO_SPLINES.sentence))
    if wanted["spline"] >= len(curve.data.splines):
        raise Refused(tr(curves.NO_SUCH_SPLINE.sentence))


def check_editable(obj):
    """Raise Refused if the path settings of an object must not be changed, such as those of a linked or baked object."""
    check_local(obj)
    check_unbaked(obj, obj.motus.path)


def check_uncouplable(leader, index):
    """Raise Refused if the wagon at `index` came from a library: a library override cannot remove it from the train."""
    if index < lists.count_from_library(leader.motus.path.wagons):
        raise Refused(
            tr("The wagons of {object} are from its library and cannot be uncoupled here: remove the train").format(object=leader.name)
        )


def check_wagon(obj, curve, leader=None):
    """Raise Refused if an object cannot become a wagon of a train on the curve.

    leader: leader of the train in which the object may be a wagon already; None for no train.
    """
    check_free(obj, curve, leader)
    if obj.motus.path.is_active:
        raise Refused(tr("{object} follows a path of its own: remove that first").format(object=obj.name))


def curve_depends_on(curve, obj):
    """Whether the curve is parented or hooked to the object, directly or through parents."""
    movers = [modifier.object for modifier in curve.modifiers if modifier.type == 'HOOK']
    seen = set()
    for mover in [curve.parent, *movers]:
        while mover and mover not in seen:
            if mover == obj:
                return True
            seen.add(mover)
            mover = mover.parent
    return False
