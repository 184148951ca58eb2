"""What an operator works on: by name from scripts, else by selection. Refusals are sentences."""

from ..core.file import deleted, libraries
from ..core.file.pointers import pointed
from ..core.refusals import Refused, check_bone, check_local, check_unbaked, named
from ..core.translations import tr
from . import chains, setup
from .goals import placing


def rig_for(context, name):
    """The armature object by name; else the active one."""
    if not name:
        if context.object is None or context.object.type != 'ARMATURE':
            raise Refused(tr("Select an armature, and the last bone of the chain in Pose Mode"))
        return context.object
    found = named(name)
    if found.type != 'ARMATURE':
        raise Refused(tr("{object} is not an armature").format(object=name))
    return found


def rig_with_ik(context, name):
    """The object by name, else the active one, where it has inverse kinematics."""
    rig = named(name) if name else context.object
    if rig is None or not rig.motus.ik.is_active:
        raise Refused(tr("Nothing here has inverse kinematics"))
    return rig


def bone_for(context, rig, name):
    """Name of the bone: the given one, else the active one."""
    if not name:
        active = active_bone(context, rig)
        if not active:
            raise Refused(tr("Select the last bone of the chain in Pose Mode"))
        return active
    check_bone(rig, name)
    return name


def active_bone(context, rig):
    """Name of the rig's active bone; "" without one."""
    # In Object Mode there is no active pose bone, but the armature remembers.
    active = rig.data.bones.active
    return active.name if active and context.object == rig else ""


def entry_for(rig, name):
    """Index of the entry of this bone; without a name the active one."""
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
    """Refuse to remove entries that an override has from its library."""
    first = min(indices, default=None)
    if first is not None and first < libraries.count_from_library(rig, "motus.ik.entries"):
        raise Refused(
            tr("{bone} of {object} is from its library and cannot be removed here: mute it").format(
                bone=rig.motus.ik.entries[first].name, object=rig.name
            )
        )


def check_target_removable(rig, entry, index):
    """Refuse a further target that cannot be removed."""
    if index < libraries.count_from_library(rig, f"{entry.path_from_id()}.extra_targets"):
        raise Refused(tr("This target is from the library of {object} and cannot be removed here").format(object=rig.name))


def goal_for(context, object_name, bone_name, rig=None):
    """(object, bone or "") by names; else, where `rig` is given, what is selected with its active bone; else None."""
    if object_name:
        found = named(object_name)
        if bone_name:
            check_bone(found, bone_name)
        return found, bone_name
    if bone_name:
        raise Refused(tr("Name the armature of the bone {bone}").format(bone=bone_name))
    return selected_goal(context, rig) if rig else None


def goal_place(context, entry):
    """World matrix of the entry's own target as it is evaluated; None where it has none."""
    target = pointed(entry, "target")
    if target is None or deleted.is_deleted(target):
        return None
    return placing.goal_matrix(context, target, entry.target_bone)


def selected_goal(context, rig):
    """The one other selected bone, or the one other selected object with its active bone; None without."""
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
    """The chain whose last bone is `bone`. Raises Refused if the chain would have no bone."""
    found = chains.of_bone(rig, bone, chain_length, use_tail)
    if found is None:
        raise Refused(tr("{bone} has no parent whose tail could reach: switch Use Tail on").format(bone=bone))
    return found


def check_free(rig, chain):
    """Refuse bones that Motus drives already, in another entry or by another system."""
    others = chains.driven_elsewhere(rig, chain.effector)
    for name in chain.driven:
        if name in others:
            label, entry = others[name]
            raise Refused(
                tr("{bone} is driven by {system} of {other} already: shorten the chain").format(bone=name, system=tr(label), other=entry)
            )


def ends(rig, names):
    """The bones of a selection that none of the others is a child of: the last bones of chains."""
    above = {bone.name for name in names for bone in rig.data.bones[name].parent_recursive}
    return [name for name in names if name not in above]


def check_no_loop(rig, bone, changes, goal):
    """Refuse a target or pole, `goal`, that moves along with the chain as it would be with these settings."""
    if goal and setup.would_wait_for_itself(rig, bone, changes):
        name = f"{goal[0].name}: {goal[1]}" if goal[1] else goal[0].name
        raise Refused(tr("{target} moves with the chain of {bone}: choose another one").format(target=name, bone=bone))


def check_editable(rig):
    """Refuse a rig whose set-up must not be changed."""
    check_local(rig)
    check_unbaked(rig, rig.motus.ik)


def warnings(rig, chain, chain_length):
    """Sentences about what will not act as one might expect."""
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
    """A constraint of the user's that turns the bone; those of Motus come from drivers and are of other types."""
    return next(
        (
            constraint
            for constraint in bone.constraints
            if constraint.type in OVERRIDING and not constraint.mute and constraint.influence > 0.0
        ),
        None,
    )
