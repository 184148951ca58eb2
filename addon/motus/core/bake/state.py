"""What is baked, and over which frames: for those who draw it; and where a datablock notes what unbaking needs."""

import bpy

from ..blender import datablocks
from ..declare import System, has_settings, leader_of, of_owner
from ..file.pointers import pointed

KEY = "motus_bake"
"""Custom property that holds, on what is no object, what MOTUS_PG_bake does."""
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
    """Baking data of a datablock that is not an object, in a custom property, with the attributes of MOTUS_PG_bake.

    A value of an unexpected type, as a damaged file may have it, reads as the default.
    """

    def __init__(self, id_data):
        self.__dict__["_id"] = id_data

    def __getattr__(self, name):
        kind, default = _FORMS[name]
        noted = self._id.get(KEY)
        value = noted.get(name) if hasattr(noted, "keys") else None
        return value if isinstance(value, kind) else default

    def __setattr__(self, name, value):
        if not hasattr(self._id.get(KEY), "keys"):
            self._id[KEY] = {}
        if value is None:
            self._id[KEY].pop(name, None)
        else:
            self._id[KEY][name] = value


def of(id_data):
    """The group of properties in which a datablock keeps what unbaking needs."""
    return id_data.motus.bake if isinstance(id_data, bpy.types.Object) else _Noted(id_data)


def named(remembered, name):
    """The datablock in a property of baking data, such as "owner" or "action"; None if the property is empty.

    remembered: baking data of a datablock, from of(). name: of the property.
    """
    return getattr(remembered, name) if isinstance(remembered, _Noted) else pointed(remembered, name)


def forget(id_data):
    """Let it remember nothing."""
    if isinstance(id_data, bpy.types.Object):
        id_data.motus.property_unset("bake")
    else:
        id_data.pop(KEY, None)


def baked_with(owner):
    """All datablocks that were baked together with an owner: keyframes replace the motion that its systems gave them."""
    found = [one for one in datablocks.everything() if _may_be_baked(one)]
    return [one for one in found if of(one).is_baked and (named(of(one), "owner") or one) == owner]


def _may_be_baked(one):
    # To ask an object for its settings would give it some.
    return one.is_property_set("motus") if isinstance(one, bpy.types.Object) else KEY in one


def owner_of(system, obj):
    """The object whose settings of a system control `obj`: its leader, or else what System.owner_of finds, or else `obj` itself."""
    return leader_of(system, obj) or (system.owner_of and system.owner_of(obj)) or obj


def is_baked(system, obj):
    """Whether the system's motion of an object stands in keyframes."""
    return isinstance(system, System) and is_baked_owner(system, owner_of(system, obj))


def is_baked_owner(system, owner):
    """Whether what the system moves for an owner stands in keyframes."""
    return has_settings(system, owner) and of_owner(system, owner).is_baked


def frames(system, obj):
    """(first, last) frame, as text, of what is baked of the system for an object; None where nothing is."""
    if not is_baked(system, obj):
        return None
    owner = owner_of(system, obj)
    # Where the owner drives others only, these have the keyframes.
    baked = [one for one in (obj, owner) if one.is_property_set("motus") and one.motus.bake.is_baked] or [
        one for one in bpy.data.objects if one.is_property_set("motus") and pointed(one.motus.bake, "owner") == owner
    ]
    # Where nothing but properties of other datablocks is driven, the owner alone tells.
    state = (baked[0] if baked else owner).motus.bake
    return tuple(f"{frame:g}" for frame in _range(state)) if state.frame_end else ("?", "?")


def _range(bake):
    action = pointed(bake, "action")
    if action and bake.frame_start == bake.frame_end:
        return action.frame_range
    return bake.frame_start, bake.frame_end
