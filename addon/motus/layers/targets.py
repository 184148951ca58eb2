"""Find the rig, layer, action and bones that an operator works on: by the names that scripts give, or by selection.

Errors are raised as Refused, with a sentence for the user.
"""

import bpy

from ..core.blender import actions, capabilities
from ..core.declare import has_settings, registered
from ..core.file.pointers import pointed
from ..core.refusals import Refused, check_bone, check_local, check_unbaked, named
from ..core.settings import lists
from ..core.translations import tr
from . import mask
from .properties import MOST_LAYERS

LIST = "motus.layers.entries"
"""Data path from an object to its list of layers."""


def rig_for(context, name):
    """Return the armature object of this name, or the active object if the name is empty; refuses an object that is no armature."""
    found = named(name) if name else context.object
    if found is None:
        raise Refused(tr("Select the armature that shall have layers"))
    if found.type != 'ARMATURE':
        raise Refused(tr("{object} is not an armature").format(object=found.name))
    return found


def layered_rig(context, name):
    """Return the rig of this name, or the active object if the name is empty. Raises Refused if it has no layers."""
    found = named(name) if name else context.object
    if found is None or found.type != 'ARMATURE' or not has_settings(registered["layers"], found) or not found.motus.layers.entries:
        raise Refused(tr("Nothing here has layers"))
    return found


def layer_index(rig, name):
    """Return the index of the layer of this name, or of the active layer if the name is empty; refuses a name that no layer has."""
    settings = rig.motus.layers
    if not name:
        return max(0, min(settings.active_entry, len(settings.entries) - 1))
    index = settings.entries.find(name)
    if index < 0:
        raise Refused(tr("{object} has no layer {layer}").format(object=rig.name, layer=name))
    return index


def action_for(name):
    """Return the action of this name; None if the name is empty. Refuses a name that no action has."""
    if not name:
        return None
    found = bpy.data.actions.get(name)
    if found is None:
        raise Refused(tr("There is no action {action}").format(action=name))
    return found


def check_action(entry):
    """Return the action of a layer. Refuses a layer whose action is missing, or has its keys in a library file."""
    action = pointed(entry, "action")
    if action is None:
        raise Refused(tr("Choose an action for this layer"))
    if actions.is_linked(action):
        raise Refused(tr("{action} is linked from another file: make it local first").format(action=action.name))
    return action


def check_slot(action, slot):
    """Refuse the identifier of an action slot that does not exist in the action or is not for objects; "" is accepted."""
    if not slot:
        return
    if action is None or not capabilities.has_slotted_actions():
        raise Refused(tr("There is no slot {slot}").format(slot=slot))
    if slot not in [one.identifier for one in actions.slots_for_objects(action)]:
        raise Refused(tr("There is no slot {slot}").format(slot=slot))


def selected_bones(context, rig):
    """List the names of the bones that are selected in Pose Mode, in the order of the armature."""
    if context.mode != 'POSE':
        return []
    found = {bone.name for bone in context.selected_pose_bones or () if bone.id_data == rig}
    return [bone.name for bone in rig.data.bones if bone.name in found]


def topmost_selected(context, rig):
    """List the names of the bones that are selected in Pose Mode, without those that have a selected parent, however far above."""
    found = set(selected_bones(context, rig))
    return [bone.name for bone in rig.data.bones if bone.name in found and not found & {above.name for above in bone.parent_recursive}]


def bones_named(rig, names):
    """List the names in a text of comma-separated bone names; refuses a name that no bone of the rig has."""
    found = [name.strip() for name in names.split(",") if name.strip()]
    for name in found:
        check_bone(rig, name)
    return found


def collections_named(rig, names):
    """List the names in a text of comma-separated bone collections; refuses a name that no bone collection of the rig has."""
    found, known = [name.strip() for name in names.split(",") if name.strip()], mask.collections(rig)
    for name in found:
        if name not in known:
            raise Refused(tr("{object} has no bone collection {collection}").format(object=rig.name, collection=name))
    return found


def check_room(rig):
    """Refuse a further layer if the rig has MOST_LAYERS layers already."""
    if len(rig.motus.layers.entries) >= MOST_LAYERS:
        raise Refused(tr("{object} has {count} layers already: flatten some first").format(object=rig.name, count=MOST_LAYERS))


def check_free_to_move(rig, index):
    """Refuse to remove or move a layer that an override has from its library."""
    lists.check_own(rig.motus.layers.entries, [index])


def check_editable(rig):
    """Refuse a rig whose layers must not be changed, because it is linked or its layers are baked."""
    check_local(rig)
    check_unbaked(rig, rig.motus.layers)
