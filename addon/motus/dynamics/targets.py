"""Find the objects, bones and properties that an operator works on: by the names that scripts give, or by selection.

Errors are raised as Refused, with a sentence for the user.
"""

import re

from ..core import wiring
from ..core.blender import actions
from ..core.declare import registered, systems
from ..core.interface import bone_entries
from ..core.measures import scene_time
from ..core.refusals import Refused, check_bone, check_local, check_unbaked, named
from ..core.settings import lists
from ..core.translations import tr
from . import inputs, setup
from .groups import unit_reads

_INDEX = re.compile(r"(.+)\[(\d{1,9})\]$", re.DOTALL)


def wanted(context, name, bones, whole_chains):
    """Return {object: names of the bones that get dynamics, or [""] for the object itself}.

    name, bones: of an object and its bones; if both are empty, the selection counts.
    whole_chains: whether all child bones are included.
    """
    if name or bones:
        obj = named(name) if name else _active(context)
        names = names_in(bones)
        for one in names:
            check_bone(obj, one)
        return {obj: _with_chains(obj, names, whole_chains) if names else [""]}
    if context.mode == 'POSE':
        found = {}
        for bone in context.selected_pose_bones or ():
            found.setdefault(bone.id_data, []).append(bone.name)
        if not found:
            raise Refused(tr("Select the bones that shall follow"))
        return {rig: _with_chains(rig, names, whole_chains) for rig, names in found.items()}
    if not context.selected_objects:
        raise Refused(tr("Select what shall follow"))
    return {obj: [""] for obj in context.selected_objects}


def names_in(bones):
    """List the names in a text of comma-separated bone names; refuses a text without names unless it is empty."""
    found = [one.strip() for one in bones.split(",") if one.strip()]
    if bones and not found:
        raise Refused(tr("No bone is named: give names with commas between"))
    return found


def property_of(context, name, path, index):
    """Return (object, (path, index)) of the property that gets dynamics; refuses a property that cannot have them.

    name: of the object; "" takes the active one. path: data path from the object. index: of an element; -1 for a whole array.
    """
    obj = named(name) if name else _active(context)
    path, index = _parted(path, index)
    if path.startswith("motus.dynamics."):
        raise Refused(tr("{path} is a setting of the dynamics themselves").format(path=path))
    # Reading obj.motus.dynamics would create the settings, so first check that they exist.
    if obj.is_property_set("motus") and setup.find(obj.motus.dynamics, (path, index)) >= 0:
        return obj, (path, index)
    indices = inputs.indices_of(obj, path, index, inputs.MOST_NUMBERS + 1) or [index]
    if len(indices) > inputs.MOST_NUMBERS or index >= inputs.MOST_NUMBERS:
        raise Refused(
            tr("Only the first {count} numbers of an array can follow: give an index below that").format(count=inputs.MOST_NUMBERS)
        )
    for one in indices:
        wiring.check_property(obj, path, one)
    return obj, (path, index)


def _parted(path, index):
    """Return (path, index) with an index at the end of the path split off, if `index` is -1."""
    found = _INDEX.match(path) if index < 0 else None
    return (found[1], int(found[2])) if found else (path, index)


def property_indices(owner, path, index):
    """List the indices of the owner's entries for a property; index -1 selects the entries of all elements. Refuses if there are none."""
    path, index = _parted(path, index)
    found = [place for place, entry in enumerate(owner.motus.dynamics.entries) if entry.data_path == path and index in (-1, entry.index)]
    if not found:
        raise Refused(tr("Nothing here has dynamics"))
    return found


def path_from(obj, id_data, data_path):
    """Return the data path from an object to a property of a datablock that the object uses; None if it does not use the datablock.

    data_path: of the property from the datablock id_data.
    """
    data = obj.data
    ways = {
        "": obj,
        "data.": data,
        "data.shape_keys.": getattr(data, "shape_keys", None),
        "data.node_tree.": getattr(data, "node_tree", None),
    }
    for index, slot in enumerate(obj.material_slots):
        ways[f"material_slots[{index}].material."] = slot.material
        ways[f"material_slots[{index}].material.node_tree."] = slot.material and slot.material.node_tree
    way = next((way for way, one in ways.items() if one == id_data), None)
    return None if way is None else (way[:-1] if data_path.startswith("[") else way) + data_path


def _active(context):
    if context.object is None:
        raise Refused(tr("Select what shall follow"))
    return context.object


def _with_chains(rig, names, whole_chains):
    """List bone names in the order of the rig's pose. whole_chains: whether all child bones are added."""
    chosen = set(names)
    if whole_chains:
        chosen.update(bone.name for name in names for bone in rig.pose.bones[name].children_recursive)
    return [bone.name for bone in rig.pose.bones if bone.name in chosen]


def chains(rig, names):
    """Return {name: (topmost of the named bones in its line of parents, number of named bones above it)}.

    The name "" stands for the object itself, which has nothing above it.
    """
    chosen, found = set(names), {}
    for name in names:
        above = [bone.name for bone in rig.pose.bones[name].parent_recursive if bone.name in chosen] if name else []
        found[name] = above[-1] if above else name, len(above)
    return found


def owner_with(context, name):
    """Return the object of this name, or the active object if the name is empty; refuses an object without dynamics."""
    obj = named(name) if name else context.object
    if obj is None or not obj.motus.dynamics.entries:
        raise Refused(tr("Nothing here has dynamics"))
    return obj


def indices_for(context, owner, operator, is_whole):
    """List the indices of the entries that an operator acts on: the active one, those of a property or of bones, or all.

    is_whole: whether, without keywords, all entries are taken even in Pose Mode, instead of those of the selected bones.
    """
    settings = owner.motus.dynamics
    if operator.only_active:
        return [settings.active_entry] if setup.active_entry(owner) else []
    if operator.data_path:
        return property_indices(owner, operator.data_path, operator.index)
    if operator.bones:
        names = names_in(operator.bones)
    elif context.mode == 'POSE' and not is_whole:
        names = [bone.name for bone in context.selected_pose_bones or () if bone.id_data == owner]
    else:
        return list(range(len(settings.entries)))
    found = [index for index in (setup.find(settings, name) for name in names) if index >= 0]
    if not found:
        raise Refused(tr("Nothing here has dynamics"))
    return found


def check_editable(owner):
    """Refuse an object whose dynamics must not be changed, because it is linked or its dynamics are baked."""
    check_local(owner)
    check_unbaked(owner, owner.motus.dynamics)


def check_free(owner, names):
    """Refuse an object or bones that a different system of Motus drives already. names: of the bones; "" for the object."""
    for system in systems():
        if system.name == "dynamics":
            continue
        if "" in names and any(thing == owner for thing, *_ in wiring.on_object(system, owner)):
            raise Refused(
                tr("{object} is driven by {system} already: let a child of it follow").format(object=owner.name, system=tr(system.label))
            )
    bone_entries.check_free(owner, [name for name in names if name], registered["dynamics"])


def loop_of(scene):
    """Return (first, last) frame of a loop over the whole scene, in the keys' time.

    The keys' time is the time of F-curves, whose frames differ from the scene's under Time Stretching.
    """
    return round(scene_time.first(scene)), round(scene_time.keys_time(scene, scene.frame_end + 1))


def check_loop(context, operator):
    """Refuse an operator's loop that does not end after its start."""
    first, last = loop_of(context.scene)
    start = operator.loop_start if operator.is_given("loop_start") else first
    end = operator.loop_end if operator.is_given("loop_end") else last
    if operator.use_loop and end <= start:
        raise Refused(tr("The loop ends on frame {end}, before it begins on frame {start}").format(start=start, end=end))


def check_no_loop(owner, names, follow):
    """Refuse bones whose motion in the world would depend on themselves, because their parent depends on them.

    names: of the bones. follow: only with 'WORLD' bones follow the motion of their parent.
    """
    for name in names:
        if name and follow == 'WORLD':
            for obj, bone in unit_reads(owner, name):
                if wiring.depends(obj, bone, owner, [name]):
                    raise Refused(tr("What {bone} hangs on moves with it").format(bone=name))


def check_removable(owner, indices):
    """Refuse to remove entries that a library override has from its library."""
    lists.check_own(owner.motus.dynamics.entries, indices)


def has_own_animation(thing):
    """Whether F-curves, NLA strips or drivers animate transform channels of an Object or PoseBone itself."""
    obj = thing.id_data
    prefix = "" if thing == obj else f"{thing.path_from_id()}."
    beginnings = tuple(f"{prefix}{name}" for name in ("location", "rotation_", "scale", "delta_"))
    animation = obj.animation_data
    if animation is None:
        return False
    curves = [curve for player in actions.players(obj) for curve in actions.curves_of(player)] + list(animation.drivers)
    return any(curve.data_path.startswith(beginnings) for curve in curves)
