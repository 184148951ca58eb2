"""Find the rig, bones and targets that an operator of inverse kinematics works on: by names from scripts, or by selection.

Errors are raised as Refused, with a sentence for the user.
"""

from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.refusals import Refused, check_bone, check_local, check_unbaked, named
from ..core.settings import lists
from ..core.translations import tr
from . import chains, setup
from .goals import placing


def rig_for(context, name):
    """Armature object of a name, or the active object if the name is empty. Raises Refused if it is no armature."""
    if not name:
        if context.object is None or context.object.type != 'ARMATURE':
            raise Refused(tr("Select an armature, and the last bone of the chain in Pose Mode"))
        return context.object
    found = named(name)
    if found.type != 'ARMATURE':
        raise Refused(tr("{object} is not an armature").format(object=name))
    return found


def rig_with_ik(context, name):
    """Object of a name, or the active object if the name is empty. Raises Refused if it has no inverse kinematics."""
    rig = named(name) if name else context.object
    if rig is None or not rig.motus.ik.is_active:
        raise Refused(tr("Nothing here has inverse kinematics"))
    return rig


def bone_for(context, rig, name):
    """Name of a bone of the rig: the given name, or the active bone's name if it is empty. Raises Refused if there is no such bone."""
    if not name:
        active = active_bone(context, rig)
        if not active:
            raise Refused(tr("Select the last bone of the chain in Pose Mode"))
        return active
    check_bone(rig, name)
    return name


def active_bone(context, rig):
    """Name of the rig's active bone; "" if there is none, or if the rig is not the active object."""
    # In Object Mode the context has no active pose bone, but the armature keeps its active bone.
    active = rig.data.bones.active
    return active.name if active and context.object == rig else ""


def entry_for(rig, name):
    """Index of the entry of the bone of a name, or of the entry selected in the list if the name is empty. Raises Refused if none."""
    entries = rig.motus.ik.entries
    if not entries:
        raise Refused(tr("{object} has no inverse kinematics").format(object=rig.name))
    if not name:
        return max(0, min(rig.motus.ik.active_entry, len(entries) - 1))
    index = entries.find(name)
    if index < 0:
        raise Refused(tr("{bone} of {object} has no inverse kinematics").format(bone=name, object=rig.name))
    return index


def check_removable(rig, indices):
    """Refuse to remove the entries at these indices if the rig is a library override that has one of them from its library."""
    lists.check_own(rig.motus.ik.entries, indices)


def goal_for(context, object_name, bone_name, rig=None):
    """(object, bone or "") of a target or pole by its names; None if no name is given, and nothing suitable is selected.

    rig: if it is given and the names are empty, what is selected along with the rig's active bone is taken. Raises Refused if the
    names do not exist.
    """
    if object_name:
        found = named(object_name)
        if bone_name:
            check_bone(found, bone_name)
        return found, bone_name
    if bone_name:
        raise Refused(tr("Name the armature of the bone {bone}").format(bone=bone_name))
    return selected_goal(context, rig) if rig else None


def goal_place(context, entry):
    """Evaluated world matrix of an entry's target; None if it has no target, or the target was deleted."""
    target = pointed(entry, "target")
    if target is None or deleted.is_deleted(target):
        return None
    return placing.goal_matrix(context, target, entry.target_bone)


def selected_goal(context, rig):
    """(object, bone or "") of what is selected besides the rig's active bone; None if that is not a single thing.

    It is the only different selected bone in Pose Mode, or else the only different selected object, with "" for its bone.
    """
    bones = [
        bone
        for bone in context.selected_pose_bones or ()
        if context.mode == 'POSE' and (bone.id_data != rig or bone.name != active_bone(context, rig))
    ]
    if len(bones) == 1:
        return bones[0].id_data, bones[0].name
    objects = [found for found in context.selected_objects if found != rig]
    return (objects[0], "") if len(objects) == 1 and not bones else None


def chain_for(rig, bone, chain_length, use_tail):
    """Chain for an entry of the bone named `bone`. Raises Refused if the chain would have no bones."""
    found = chains.of_bone(rig, bone, chain_length, use_tail)
    if found is None:
        raise Refused(tr("{bone} has no parent whose tail could reach: switch Use Tail on").format(bone=bone))
    return found


def check_free(rig, chain):
    """Refuse a chain with a bone that a different entry or a different Motus system drives already."""
    others = chains.driven_elsewhere(rig, chain.effector)
    for name in chain.driven:
        if name in others:
            label, entry = others[name]
            raise Refused(
                tr("{bone} is driven by {system} of {other} already: shorten the chain").format(bone=name, system=tr(label), other=entry)
            )


def ends(rig, names):
    """Names of bones without a descendant in the list `names`: the last bones of the chains that are to be added."""
    above = {bone.name for name in names for bone in rig.data.bones[name].parent_recursive}
    return [name for name in names if name not in above]


def check_no_loop(rig, bone, changes, goal):
    """Refuse a target or pole that moves along with the chain that the entry of a bone would have with changed settings.

    changes: {name: value} of settings. goal: (object, bone or ""), or None, which is always accepted.
    """
    if goal and setup.would_wait_for_itself(rig, bone, changes):
        name = f"{goal[0].name}: {goal[1]}" if goal[1] else goal[0].name
        raise Refused(tr("{target} moves with the chain of {bone}: choose another one").format(target=name, bone=bone))


def check_editable(rig):
    """Refuse a rig whose settings cannot be changed: it is linked from a different file, or baked."""
    check_local(rig)
    check_unbaked(rig, rig.motus.ik)


def warnings(rig, chain, chain_length):
    """Sentences that warn the user if a chain has fewer bones than wanted, or if constraints override the rotation of its bones."""
    found = []
    if len(chain.bones) < chain_length:
        found.append(tr("There are only {count} bones up to the root: the chain takes all of them").format(count=len(chain.bones)))
    for name in chain.driven:
        constraint = _overriding(rig.pose.bones[name])
        if constraint:
            found.append(
                tr("{bone} has a constraint of its own that overrides its rotation: {constraint}").format(
                    bone=name, constraint=constraint.name
                )
            )
    return found


OVERRIDING = {
    'IK',
    'SPLINE_IK',
    'COPY_ROTATION',
    'COPY_TRANSFORMS',
    'DAMPED_TRACK',
    'TRACK_TO',
    'LOCKED_TRACK',
    'STRETCH_TO',
    'ARMATURE',
    'CHILD_OF',
    'ACTION',
    'TRANSFORM_CACHE',
}


def _overriding(bone):
    """An active constraint of the user that overrides the rotation of a pose bone; None if there is none.

    Constraints that Motus adds do not count: they are of different types.
    """
    return next(
        (
            constraint
            for constraint in bone.constraints
            if constraint.type in OVERRIDING and not constraint.mute and constraint.influence > 0.0
        ),
        None,
    )
