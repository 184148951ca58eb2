"""Find what the operators of chains work on, by the names that scripts give or by selection. Raise Refused if it does not suit."""

from typing import Any, NamedTuple

from ..core import wiring
from ..core.declare import leader_of, systems
from ..core.file.pointers import pointed
from ..core.interface import bone_entries
from ..core.interface.operators import named_or_active
from ..core.refusals import Refused, check_local, check_unbaked, named
from ..core.translations import tr
from . import curves, groups, naming, setup


class Wanted(NamedTuple):
    """Chains to be added. owner: Object that has their settings. names: of the entries. rows: {name of an entry: objects of its row}.

    splines: {name of an entry: index of its spline}.
    """

    owner: Any
    names: list
    rows: dict
    splines: dict

    def check_free(self):
        """Raise Refused if what shall hang cannot be edited, is driven already, or moves what it hangs on."""
        check_editable(self.owner)
        if not self.rows and not self.splines:
            _check_bones(self.owner, self.names)
        for objects in self.rows.values():
            _check_row(self.owner, objects)


def wanted(context, name, bones, objects, spline):
    """Return the Wanted of keywords. Of the selection if they are empty: bones in Pose Mode, a curve, or else the selected objects as a row."""
    if objects:
        return _row([named(one.strip()) for one in objects.split(",") if one.strip()])
    if not (name or bones or context.mode == 'POSE') and len(context.selected_objects) > 1:
        return _row(_in_order(context))
    rig = named_or_active(context, name)
    if rig.type == 'CURVE' and not bones:
        found = {naming.of_spline(rig, one): one for one in curves.splines_of(rig, spline)}
        return Wanted(rig, list(found), {}, found)
    if rig.type != 'ARMATURE' and (name or bones):
        raise Refused(tr("{object} is not an armature").format(object=rig.name))
    if rig.type != 'ARMATURE':
        raise Refused(
            tr("Select a curve, or objects of a row, first those that hang and last the one that they hang on, or bones in Pose Mode")
        )
    names = bone_entries.names_in(rig, bones) if bones else bone_entries.posed(context) if not name else []
    if not names:
        raise Refused(tr("Select the topmost bones of the chains"))
    chosen = set(names)
    tops = [one for one in names if chosen.isdisjoint(bone.name for bone in rig.data.bones[one].parent_recursive)]
    return Wanted(rig, tops, {}, {})


def owner_with(context, name):
    """Return the object of this name, or the active one, or the object on whose chain that hangs. Raises Refused if it has no chains.

    An object of a row whose root is gone is returned itself (groups.is_stray).
    """
    obj = named_or_active(context, name)
    owner = obj if obj.motus.chains.entries or groups.is_stray(obj) else pointed(obj.motus.chains, "leader")
    if owner is None:
        raise Refused(tr("{object} has no chains").format(object=obj.name))
    return owner


def check_editable(owner):
    """Raise Refused if chains of an object cannot be changed."""
    check_local(owner)
    check_unbaked(owner, owner.motus.chains)


def _row(objects):
    owner, *things = objects
    if not things or len({*objects}) < len(objects):
        raise Refused(tr("Name at least two different objects: the one that stays, then those that hang on it, in their order"))
    name = naming.of_row(owner, things)
    return Wanted(owner, [name], {name: things}, {})


def _in_order(context):
    """List the selected objects: the active one, then each time the one that is nearest to the one before."""
    left = sorted(context.selected_objects, key=lambda obj: obj.name)
    if context.object not in left:
        raise Refused(
            tr("Select a curve, or objects of a row, first those that hang and last the one that they hang on, or bones in Pose Mode")
        )
    found = [context.object]
    left.remove(context.object)
    while left:
        here = found[-1].matrix_world.translation
        found.append(min(left, key=lambda obj: (obj.matrix_world.translation - here).length))
        left.remove(found[-1])
    return found


def _check_bones(rig, tops):
    ends = {*tops, *(groups.ends_of(rig) if rig.is_property_set("motus") else ())}
    bone_entries.check_free(rig, tops, setup.system())
    for top in tops:
        bones = [bone.name for bone in groups.bones_of(rig, top, ends)]
        parent = rig.pose.bones[top].parent
        if wiring.depends(rig, parent.name if parent else "", rig, bones):
            raise Refused(tr("What {bone} hangs on moves with it").format(bone=top))


def _check_row(owner, things):
    for obj in things:
        check_local(obj)
        check_unbaked(obj, obj.motus.chains)
        above = next((one for one in _above(obj) if one in things), None)
        if above:
            raise Refused(
                tr("{object} is parented to {parent}, which hangs too: clear its parent and keep its transform (Alt P)").format(
                    object=obj.name, parent=above.name
                )
            )
        if obj in _above(owner):
            raise Refused(tr("What {bone} hangs on moves with it").format(bone=owner.name))
        _check_undriven(owner, obj)
    mine = owner.motus.chains.entries if owner.is_property_set("motus") else ()
    for entry in mine:
        found = groups.objects_of(owner, entry)
        shared = next((obj for obj in things if obj in found), None)
        if shared and found[0] != things[0]:
            raise Refused(_taken(shared, setup.system(), owner))


def _check_undriven(owner, obj):
    for system in systems():
        is_own = system == setup.system() and (leader_of(system, obj) == owner or groups.is_left(obj))
        if not is_own and any(wiring.is_sink(system, one) for one in obj.constraints):
            raise Refused(_taken(obj, system, leader_of(system, obj) or obj))


def _taken(obj, system, other):
    return tr("{bone} is driven by {system} of {other} already").format(bone=obj.name, system=tr(system.label), other=other.name)


def _above(obj):
    """List the parents of an object, the nearest first; in a file that is damaged they may go round."""
    found = []
    while obj.parent is not None and obj.parent not in found:
        obj = obj.parent
        found.append(obj)
    return found
