"""Detect that objects were given different parents, constraints or drivers, which may change the order in which entries are solved.

An entry is an item in an owner's list of settings. Blender tells handlers which objects were updated but not why. The relations of each
object are therefore stored and compared.
"""

import bpy

from ...evaluated import copies

_known = {}
"""(name of an object, path of its library or None) -> result of _hangs_on() for the object when it was last called."""


def look():
    """Store the relations (parent, constraints and drivers) of each object that is new in the file, and forget objects that are gone."""
    objects = {_key(obj): obj for obj in bpy.data.objects}
    for key in _known.keys() - objects.keys():
        del _known[key]
    for key in objects.keys() - _known.keys():
        _known[key] = _hangs_on(objects[key])


def have_changed(depsgraph):
    """Whether the relations of any object that the depsgraph reports as updated differ from the stored ones.

    Relations are an object's parent, constraints and drivers. The present relations are stored, to be compared the next time.
    """
    changed = False
    for update in depsgraph.updates:
        is_object = update.is_updated_transform and isinstance(update.id, bpy.types.Object)
        obj = copies.original_of(update.id, bpy.data.objects, depsgraph) if is_object else None
        if obj:
            key, now = _key(obj), _hangs_on(obj)
            changed = changed or _known.get(key, now) != now
            _known[key] = now
    return changed


def forget():
    """Forget the stored relations (parents, constraints and drivers) of all objects."""
    _known.clear()


def _key(obj):
    """Return (name of an object, file path of its library or None), by which the object can be looked up in bpy.data.objects."""
    return obj.name, obj.library and obj.library.filepath


def _hangs_on(obj):
    constraints = [(one.type, _name(getattr(one, "target", None)), getattr(one, "subtarget", "")) for one in obj.constraints]
    # For each bone only the number of its constraints: a rig may have hundreds of bones, and is posed with the mouse.
    on_bones = [len(bone.constraints) for bone in obj.pose.bones] if obj.pose else ()
    animation = obj.animation_data
    # The type is read only if there is a parent: Blender 3.4 prints a warning if the parent is gone.
    parent = (obj.parent.name, obj.parent_type, obj.parent_bone) if obj.parent else ()
    return (parent, tuple(constraints), tuple(on_bones), len(animation.drivers) if animation else 0)


def _name(obj):
    return obj.name if obj else ""
