"""Which rig, head and target an operator works on: by name from scripts, else by selection. Refusals are sentences."""

from ..core import wiring
from ..core.declare import entries_on, systems
from ..core.file import libraries
from ..core.refusals import Refused, check_bone, check_local, check_unbaked, named
from ..core.translations import tr
from . import anatomy, names
from .properties import ANY_BODY_LENGTH


def rig_for(context, name):
    """The armature object by name; else the active one."""
    if not name:
        if context.object is None or context.object.type != 'ARMATURE':
            raise Refused(tr("Select the armature whose head shall look"))
        return context.object
    found = named(name)
    if found.type != 'ARMATURE':
        raise Refused(tr("{object} is not an armature").format(object=name))
    return found


def looking_rig(context, name):
    """The rig by name, or else the active one. Raises Refused if no head of it looks at a target."""
    rig = named(name) if name else context.object
    if rig is None or not rig.motus.look_at.is_active:
        raise Refused(tr("Nothing here looks at a target"))
    return rig


def head_for(context, rig, name):
    """Name of the head bone: the given one, else the active one in Pose Mode, else the one that is called head."""
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
    """Index of the entry of this head; without a name that of the active bone, or the active entry."""
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
    """The target by name; else another selected object, where the rig was chosen by selection too; else None."""
    if operator.target:
        return named(operator.target)
    if operator.object:
        return None
    others = [found for found in context.selected_objects if found != rig]
    return others[0] if len(others) == 1 else None


def check_target(target, bone):
    """Refuse a bone that the target has not."""
    if not bone:
        return
    if target is None or target.type != 'ARMATURE':
        raise Refused(tr("Name an armature as the target of a bone"))
    check_bone(target, bone)


def check_eyes(rig, head, eyes):
    """Refuse names of bones that cannot be the eyes of the head."""
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


def spine_for(rig, head, wanted, up, taken):
    """How many bones below the head turn along. up: what the rig stands along; taken: bones that others are about to turn."""
    if wanted == ANY_BODY_LENGTH:
        driven = taken.union(*(entry.drives for _, entry in _entries_beside(rig, head)))
        return anatomy.spine_length(rig, head, up, lambda bone: bone not in driven and not _is_constrained(rig.pose.bones[bone]))
    present = len(rig.data.bones[head].parent_recursive)
    if wanted > present:
        raise Refused(tr("There are only {count} bones below {head}").format(count=present, head=head))
    return wanted


def check_free(rig, head, driven):
    """Refuse bones that Motus drives already, in another entry or by another system."""
    for system, entry in _entries_beside(rig, head):
        shared = set(driven) & set(entry.drives)
        if shared:
            raise Refused(
                tr("{bone} is driven by {system} of {other} already").format(bone=min(shared), system=tr(system.label), other=entry.name)
            )


def _entries_beside(rig, head):
    """(system, entry) of all that Motus does to the rig's bones, but for layers, which act beneath, and for this head."""
    for system, entry in entries_on(rig):
        if system.name != "look_at" or entry.name != head:
            yield system, entry


def _is_constrained(bone):
    """Whether a constraint that is not one of Motus's own moves a bone."""
    return any(
        not constraint.mute and constraint.influence > 0.0 and not any(wiring.is_sink(system, constraint) for system in systems())
        for constraint in bone.constraints
    )


def check_loop(rig, head, driven, target, target_bone):
    """Refuse a target that moves with the bones that turn."""
    if target and wiring.depends(target, target_bone, rig, driven):
        raise Refused(
            tr("{target} moves with {head}, so {head} cannot look at it").format(
                target=f"{target.name}: {target_bone}" if target_bone else target.name, head=head
            )
        )


def check_removable(rig, index):
    """Refuse to remove a head that an override has from its library."""
    if index < libraries.count_from_library(rig, "motus.look_at.entries"):
        raise Refused(
            tr("{bone} of {object} is from its library and cannot be removed here: mute it").format(
                bone=rig.motus.look_at.entries[index].name, object=rig.name
            )
        )


def check_editable(rig):
    """Refuse a rig whose set-up must not be changed."""
    check_local(rig)
    check_unbaked(rig, rig.motus.look_at)
