"""Read which objects are baked, and over which frames; find what a datablock stores for unbaking."""

import bpy

from ..blender import datablocks
from ..declare import System, has_settings, leader_of, of_owner
from ..file import stored
from ..file.pointers import pointed

KEY = "motus_bake"
"""Custom property with the baking data of a datablock that is not an object; an object has a MOTUS_PG_bake instead."""
_FORMS = {
    "is_baked": (int, False),
    "owner": (bpy.types.Object, None),
    "action": (bpy.types.Action, None),
    "frame_start": (float, 0.0),
    "frame_end": (float, 0.0),
    "previous_action": (bpy.types.Action, None),
    "previous_slot": (str, ""),
    "kept": (str, ""),
}


class _Noted:
    """Baking data of a datablock that is not an object, read and written in a custom property. It has the attributes of MOTUS_PG_bake.

    A value of an unexpected type, as a damaged file may have it, reads as the default.
    """

    def __init__(self, id_data):
        self.__dict__["_id"] = id_data

    def __getattr__(self, name):
        kind, default = _FORMS[name]
        try:
            value = stored.group(self._id.get(KEY)).get(name)
        except stored.Damaged:
            return default
        return value if isinstance(value, kind) else default

    def __setattr__(self, name, value):
        try:
            stored.group(self._id.get(KEY))
        except stored.Damaged:
            self._id.pop(KEY, None)
            self._id[KEY] = {}
        if value is None:
            self._id[KEY].pop(name, None)
        else:
            self._id[KEY][name] = value


def of(id_data):
    """Baking data of a datablock: the MOTUS_PG_bake of an object; for a different datablock a _Noted, which has the same attributes."""
    return id_data.motus.bake if isinstance(id_data, bpy.types.Object) else _Noted(id_data)


def named(remembered, name):
    """The datablock in a pointer property of baking data, such as "owner" or "action"; None if the pointer is empty.

    remembered: baking data that of() returned. name: of the property.
    """
    return getattr(remembered, name) if isinstance(remembered, _Noted) else pointed(remembered, name)


def forget(id_data):
    """Remove the baking data from a datablock."""
    if isinstance(id_data, bpy.types.Object):
        id_data.motus.property_unset("bake")
    else:
        id_data.pop(KEY, None)


def baked_with(owner):
    """All datablocks that were baked together with an owner: keyframes replace the motion that the owner's systems gave them.

    owner: object whose settings the systems solve.
    """
    found = [one for one in datablocks.everything() if _may_be_baked(one)]
    return [one for one in found if of(one).is_baked and (named(of(one), "owner") or one) == owner]


def _may_be_baked(one):
    # Reading Object.motus creates the property group on the object.
    return one.is_property_set("motus") if isinstance(one, bpy.types.Object) else KEY in one


def owner_of(system, obj):
    """The object whose settings of a system drive `obj`: its leader, or else what System.owner_of(obj) returns, or else `obj` itself."""
    return leader_of(system, obj) or (system.owner_of and system.owner_of(obj)) or obj


def is_baked(system, obj):
    """Whether the motion that a system gives an object is baked to keyframes. False for a feature that computes no motion."""
    return isinstance(system, System) and is_baked_owner(system, owner_of(system, obj))


def is_baked_owner(system, owner):
    """Whether the motion that a system computes from the settings of an object, the owner, is baked to keyframes."""
    return has_settings(system, owner) and of_owner(system, owner).is_baked


def frames(system, obj):
    """(first, last) baked frame, as text, of the motion that a system gives an object; None if the motion is not baked.

    Both texts are "?" if the file does not tell the frames.
    """
    if not is_baked(system, obj):
        return None
    owner = owner_of(system, obj)
    # If the owner drives different objects only, these objects have the keyframes.
    baked = [one for one in (obj, owner) if one.is_property_set("motus") and one.motus.bake.is_baked] or [
        one for one in bpy.data.objects if one.is_property_set("motus") and pointed(one.motus.bake, "owner") == owner
    ]
    # If only properties of datablocks that are no objects are driven, the owner alone stores the frames.
    state = (baked[0] if baked else owner).motus.bake
    return tuple(f"{frame:g}" for frame in _range(state)) if state.frame_end else ("?", "?")


def _range(bake):
    action = pointed(bake, "action")
    if action and bake.frame_start == bake.frame_end:
        return action.frame_range
    return bake.frame_start, bake.frame_end
