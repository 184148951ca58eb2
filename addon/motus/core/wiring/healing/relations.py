"""Notices that objects were given another parent, constraint or driver: what reads them may have to be solved in another order.

Blender tells handlers which objects were updated, not why; so what an object hangs on is kept, to be compared.
"""

import bpy

from ...evaluated import copies

_known = {}
"""What each object hung on when it was last looked at, by its name and its library's file."""


def look():
    """Note what the objects hang on that are not known yet."""
    objects = {_key(obj): obj for obj in bpy.data.objects}
    for key in _known.keys() - objects.keys():
        del _known[key]
    for key in objects.keys() - _known.keys():
        _known[key] = _hangs_on(objects[key])


def have_changed(depsgraph):
    """Whether one of the objects that were updated hangs on something else than before."""
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
    """Forget all objects."""
    _known.clear()


def _key(obj):
    """By which bpy.data.objects finds it, too."""
    return obj.name, obj.library and obj.library.filepath


def _hangs_on(obj):
    constraints = [(one.type, _name(getattr(one, "target", None)), getattr(one, "subtarget", "")) for one in obj.constraints]
    # Of bones, of which there may be hundreds that are posed with the mouse, just how many.
    on_bones = [len(bone.constraints) for bone in obj.pose.bones] if obj.pose else ()
    animation = obj.animation_data
    # Blender warns of the type of a parent that is gone (3.4).
    parent = (obj.parent.name, obj.parent_type, obj.parent_bone) if obj.parent else ()
    return (parent, tuple(constraints), tuple(on_bones), len(animation.drivers) if animation else 0)


def _name(obj):
    return obj.name if obj else ""
