"""Find the rig, head and target that an operator of Look At works on: by the names that scripts give, or by selection.

Errors are raised as Refused, with a sentence for the user.
"""

from ..core import wiring
from ..core.declare import entries_on, systems
from ..core.refusals import Refused, check_bone, check_local, check_unbaked, named
from ..core.settings import lists
from ..core.translations import tr
from . import anatomy, groups, names
from .properties import ANY_BODY_LENGTH


def rig_for(context, name):
    """Armature object of a name, or the active object if the name is empty. Raises Refused if it is no armature."""
    if not name:
        if context.object is None or context.object.type != 'ARMATURE':
            raise Refused(tr("Select the armature whose head shall look"))
        return context.object
    found = named(name)
    if found.type != 'ARMATURE':
        raise Refused(tr("{object} is not an armature").format(object=name))
    return found


def looking_rig(context, name):
    """Object of a name, or the active object if the name is empty. Raises Refused if Look At is not set up on it."""
    rig = named(name) if name else context.object
    if rig is None or not rig.motus.look_at.is_active:
        raise Refused(tr("Nothing here looks at a target"))
    return rig


def head_for(context, rig, name):
    """Name of the head bone of a rig. Raises Refused if there is none.

    It is the given name; if that is empty, the active bone in Pose Mode, or else the bone that is called head.
    """
    if name:
        check_bone(rig, name)
        return name
    active = context.active_pose_bone
    if active and active.id_data == rig and context.mode == 'POSE':
        return active.name
    found = names.head_of(rig)
    if not found:
        raise Refused(tr("Choose the bone of the head"))
    return found


def entry_for(context, rig, name):
    """Index of the entry of the head bone of a name. Raises Refused if there is no such entry.

    If the name is empty, it is the entry of the active bone in Pose Mode, or else the entry that is selected in the list.
    """
    entries = rig.motus.look_at.entries
    if not entries:
        raise Refused(tr("Nothing here looks at a target"))
    if not name:
        active = context.active_pose_bone
        is_posed = active and active.id_data == rig and context.mode == 'POSE' and active.name in entries
        if not is_posed:
            return max(0, min(rig.motus.look_at.active_entry, len(entries) - 1))
        name = active.name
    index = entries.find(name)
    if index < 0:
        raise Refused(tr("{bone} of {object} looks at nothing").format(bone=name, object=rig.name))
    return index


def target_for(context, operator, rig):
    """Object that the operator's keyword `target` names; without it the only selected object besides the rig; otherwise None.

    The selection counts only if the rig was chosen by selection, too: if the operator's keyword `object` is empty.
    """
    if operator.target:
        return named(operator.target)
    if operator.object:
        return None
    others = [found for found in context.selected_objects if found != rig]
    return others[0] if len(others) == 1 else None


def check_target(target, bone):
    """Refuse the name of a target bone that the target does not have. bone: "" for the object itself, which is always accepted."""
    if not bone:
        return
    if target is None or target.type != 'ARMATURE':
        raise Refused(tr("Name an armature as the target of a bone"))
    check_bone(target, bone)


def check_eyes(rig, head, eyes):
    """Refuse eyes that are named twice, do not exist, are no descendants of the head bone, or are descendants of a different eye."""
    if len(set(eyes)) < len(eyes):
        raise Refused(tr("An eye is named twice"))
    below = {bone.name for bone in rig.data.bones[head].children_recursive}
    for eye in eyes:
        check_bone(rig, eye)
        if eye not in below:
            raise Refused(tr("{bone} is not below {head}").format(bone=eye, head=head))
    for eye in eyes:
        parents = [bone.name for bone in rig.data.bones[eye].parent_recursive]
        if set(parents) & set(eyes):
            raise Refused(tr("{bone} is below another eye").format(bone=eye))


def check_lids(rig, entry, lids):
    """Refuse eyelids that are listed already, are no descendants of the head bone, or are turned by a head or a different system."""
    below = {bone.name for bone in rig.data.bones[entry.name].children_recursive}
    turned = groups.driven_bones(rig, entry)
    for lid in lids:
        check_bone(rig, lid)
        if lid not in below:
            raise Refused(tr("{bone} is not below {head}").format(bone=lid, head=entry.name))
        if lid in turned or lid in entry.lids:
            raise Refused(tr("{bone} turns with {head} already").format(bone=lid, head=entry.name))
    check_free(rig, entry.name, lids)


def spine_for(rig, head, wanted, up, taken):
    """Number of bones below the head, counted up the parents, that turn along. Raises Refused if fewer bones than wanted are there.

    wanted: the number, or ANY_BODY_LENGTH to find neck and spine. up: up axis of the rig, an item of AXES. taken: set of the names
    of bones that different heads are about to turn.
    """
    if wanted == ANY_BODY_LENGTH:
        driven = taken.union(*(entry.drives for _, entry in _entries_beside(rig, head)))
        return anatomy.spine_length(rig, head, up, lambda bone: bone not in driven and not _is_constrained(rig.pose.bones[bone]))
    present = len(rig.data.bones[head].parent_recursive)
    if wanted > present:
        raise Refused(tr("There are only {count} bones below {head}").format(count=present, head=head))
    return wanted


def check_free(rig, head, driven):
    """Refuse bones, by the names in `driven`, that a different entry or a different Motus system drives already."""
    for system, entry in _entries_beside(rig, head):
        shared = set(driven) & set(entry.drives if system.name == "look_at" else entry.keeps)
        if shared:
            raise Refused(
                tr("{bone} is driven by {system} of {other} already").format(bone=min(shared), system=tr(system.label), other=entry.name)
            )


def _entries_beside(rig, head):
    """Yield (system, Entry) for each entry by which Motus drives bones of the rig, without the entry of this head.

    Systems that lay poses, such as layers, are left out: constraints act on top of their poses.
    """
    for system, entry in entries_on(rig):
        if system.name != "look_at" or entry.name != head:
            yield system, entry


def _is_constrained(bone):
    """Whether a pose bone has an active constraint that Motus has not added."""
    return any(
        not constraint.mute and constraint.influence > 0.0 and not any(wiring.is_sink(system, constraint) for system in systems())
        for constraint in bone.constraints
    )


def check_loop(rig, head, driven, target, target_bone):
    """Refuse a target, or its bone `target_bone`, that moves with the bones that the head turns. driven: names of these bones."""
    if target and wiring.depends(target, target_bone, rig, driven):
        raise Refused(
            tr("{target} moves with {head}, so {head} cannot look at it").format(
                target=f"{target.name}: {target_bone}" if target_bone else target.name, head=head
            )
        )


def check_removable(rig, index):
    """Refuse to remove the entry at an index if the rig is a library override that has the entry from its library."""
    lists.check_own(rig.motus.look_at.entries, [index])


def check_editable(rig):
    """Refuse a rig whose settings cannot be changed: it is linked from a different file, or baked."""
    check_local(rig)
    check_unbaked(rig, rig.motus.look_at)
