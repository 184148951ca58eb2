"""Find the walker, legs, body and ground that an operator works on: by name from scripts, otherwise from the selection.

Functions raise Refused, with a sentence for the artist, if an object does not fit.
"""

from mathutils import Vector

from ..core.declare import is_owner, leader_of, offered
from ..core.file.pointers import pointed
from ..core.refusals import Refused, check_bone, check_local, check_unbaked, named, named_mesh
from ..core.translations import tr
from . import ground, legs, setup
from .properties import MOST_LEGS


def owner_for(context, name):
    """Return the object that is to walk: the one of this name, or the active object if the name is empty.

    Raises Refused if there is none, or if its set-up may not be changed.
    """
    found = named(name) if name else context.object
    if found is None:
        raise Refused(tr("Select the body that shall walk"))
    check_editable(found)
    _check_free(found, found)
    return found


def walker_for(context, name):
    """Return the walker of this name, or the active object's if the name is empty; for a foot or body the walker that drives it.

    Raises Refused if there is none.
    """
    found = named(name) if name else context.object
    if found is not None and not is_owner(setup.system(), found):
        found = leader_of(setup.system(), found)
    if found is None or not is_owner(setup.system(), found):
        raise Refused(tr("Nothing here walks"))
    return found


def editable_walker(context, name):
    """Return the walker of this name, or the active object's if the name is empty.

    Raises Refused if there is none, or if its set-up may not be changed.
    """
    found = walker_for(context, name)
    check_editable(found)
    return found


def check_editable(owner):
    """Raise Refused if the walker set-up of an object must not be changed: the object is linked, or its walk is baked."""
    check_local(owner)
    if owner.is_property_set("motus"):
        check_unbaked(owner, owner.motus.walker)


def legs_for(context, owner, names):
    """List the legs, as setup.Leg, of an object that is about to walk. Raises Refused if there are none or they do not fit.

    names: names of the feet, between commas. If it is empty, the legs of an armature are its chains of the system Inverse Kinematics
    that have targets, and the feet of an object without bones are the selected objects.
    """
    listed = [name.strip() for name in names.split(",") if name.strip()]
    if owner.type == 'ARMATURE':
        found = [_named_foot(owner, name) for name in listed] if listed else _legs_of_chains(owner)
        if not found:
            raise Refused(
                tr("{object} has no chain of Inverse Kinematics with a target: add some, or name the feet").format(object=owner.name)
            )
    else:
        chosen = [named(name) for name in listed] or _selected_feet(context, owner)
        if not chosen:
            raise Refused(tr("Name the objects that are the feet of {object}, or select them too").format(object=owner.name))
        found = _legs_of_objects(chosen)
    return _checked(owner, found)


def legs_again(context, owner, is_named):
    """List the legs, as setup.Leg, of an object that walks already, if no feet are named; None if its legs stay as they are.

    Objects that are selected together with a walker without bones become its feet, unless a script names the walker (is_named).
    Otherwise legs whose foot no longer exists are left out.
    """
    settings, present = owner.motus.walker, legs.feet(owner)
    if not present:
        return legs_for(context, owner, "")
    if not (owner.pose or is_named):
        chosen = [obj for obj in _selected_feet(context, owner) if obj != pointed(settings, "body")]
        if chosen and set(chosen) != {foot.thing for foot in present}:
            return _checked(owner, _legs_of_objects(chosen))
    if len(present) == len(settings.legs):
        return None
    kept = [settings.legs[foot.index] for foot in present]
    return [setup.Leg(legs.bone(leg), pointed(leg, "foot"), leg.hip.copy(), leg.length) for leg in kept]


def _legs_of_objects(feet):
    return [setup.Leg("", obj, Vector(), 0.0) for obj in feet]


def _checked(owner, found):
    if len(found) > MOST_LEGS:
        raise Refused(
            tr("{object} would have {count} legs; there can be {most}").format(object=owner.name, count=len(found), most=MOST_LEGS)
        )
    _check_feet(owner, found)
    return found


def _selected_feet(context, owner):
    chosen = [obj for obj in context.selected_objects if obj != owner] if context.object == owner else []
    # A selected child is the body that is to rise and lean, not a foot, unless all selected objects are children.
    return sorted([obj for obj in chosen if obj.parent != owner] or chosen, key=lambda obj: obj.name)


def _named_foot(owner, name):
    """Return the setup.Leg of a bone that a script names as a foot.

    If the bone is the last bone or the target of an IK chain, the leg is this chain; otherwise the bone alone is the foot.
    """
    check_bone(owner, name)
    return next((leg for bone, leg in _chains(owner) if bone == name or leg.bone == name), None) or setup.Leg(name, None, Vector(), 0.0)


def _legs_of_chains(owner):
    return [leg for _, leg in _chains(owner)]


def _chains(owner):
    """List (name of the last bone, setup.Leg) of each chain of the system Inverse Kinematics that can be a leg.

    Such a chain is not muted, and its target is an object without bones or a bone of the owner itself.
    """
    found = []
    for name, chain in offered("ik").chains(owner).items():
        target = chain.target
        own = target == owner and chain.target_bone in owner.pose.bones
        if target is None or chain.is_muted or (target.pose and not own):
            continue
        found.append(
            (
                name,
                setup.Leg(
                    chain.target_bone if own else "",
                    None if own else target,
                    chain.bones[-1].head_local,
                    sum(bone.length for bone in chain.bones),
                ),
            )
        )
    return found


def body_for(owner, name, feet):
    """Return the part that rises and leans with the feet: the name of a bone of an armature, or a child of an object without bones.

    If `name` is empty, an object that walks already keeps its body, and a new armature gets the bone that all legs are children of.
    None or "" if there is no body. feet: names of bones, or objects, that cannot be the body. Raises Refused if the named one does not
    fit.
    """
    found = _named_body(owner, name) if name else _usual_body(owner)
    if found not in feet:
        return found
    if name:
        raise Refused(tr("{object} cannot be the body, and a foot too").format(object=name))
    return None


def _named_body(owner, name):
    if owner.type == 'ARMATURE':
        check_bone(owner, name)
        return name
    found = named(name)
    if found.parent != owner or found.parent_type != 'OBJECT':
        raise Refused(tr("{object} is no child of {parent}: parent it, and move {parent}").format(object=found.name, parent=owner.name))
    _check_free(owner, found)
    return found


def _usual_body(owner):
    if is_owner(setup.system(), owner):
        settings = owner.motus.walker
        return settings.body_bone if owner.pose else pointed(settings, "body")
    return _common_bone(owner) if owner.pose else None


def _common_bone(owner):
    """Name of the lowest bone that is a parent of all IK chains of an armature; "" if there is none."""
    above = [[one.name for one in chain.bones[-1].parent_recursive] for chain in offered("ik").chains(owner).values()]
    shared = [name for name in above[0] if all(name in one for one in above)] if above else []
    return shared[0] if shared else ""


def _check_feet(owner, found):
    """Raise Refused if a foot cannot be moved, such as a connected bone, or if two legs have the same foot."""
    for leg in found:
        if leg.bone:
            bone = owner.pose.bones[leg.bone]
            if bone.bone.use_connect and bone.parent:
                raise Refused(tr("{bone} is connected to its parent, and cannot be a foot").format(bone=leg.bone))
            continue
        if leg.foot == owner:
            raise Refused(tr("{object} cannot be its own foot").format(object=owner.name))
        _check_free(owner, leg.foot)
    feet = [leg.bone or leg.foot for leg in found]
    twice = next((foot for foot in feet if feet.count(foot) > 1), None)
    if twice is not None:
        raise Refused(tr("{foot} would be the foot of two legs").format(foot=getattr(twice, "name", twice)))


def _check_free(owner, obj):
    """Raise Refused if `obj` cannot be a part of the walker `owner`: it is linked, walks itself, or is part of a different walker.

    `obj` may be the owner itself, which may walk already.
    """
    check_local(obj)
    if obj != owner and is_owner(setup.system(), obj):
        raise Refused(tr("{object} walks itself, and can be no part of {owner}").format(object=obj.name, owner=owner.name))
    leader = leader_of(setup.system(), obj)
    if leader not in {None, owner}:
        raise Refused(tr("{object} is part of {leader}, which walks already").format(object=obj.name, leader=leader.name))


def carrier_for(name, owner):
    """Return the object of this name as the carrier of a walker's ground. Raises Refused if there is none, or if it moves with a walker."""
    found = named(name)
    if found == owner or ground.is_walking(found):
        raise Refused(tr("{object} walks itself, and carries no ground").format(object=found.name))
    return found


def ground_for(name, owner):
    """Return the mesh object of this name as ground. Raises Refused if there is none, or if it moves with a walker."""
    found = named_mesh(name)
    if found == owner or ground.is_walking(found):
        raise Refused(tr("{object} walks itself, and is no ground").format(object=found.name))
    return found
