"""What is baked, and over which frames: for those who draw it."""

import bpy

from ..system import System, of_owner


def owner_of(system, obj):
    """The object whose settings of the system move this one: its leader, what the system says, or itself."""
    # To ask an object for its settings would give it some.
    leader = of_owner(system, obj).leader if obj.is_property_set("motus") else None
    return leader or (system.owner_of and system.owner_of(obj)) or obj


def is_baked(system, obj):
    """Whether the system's motion of an object stands in keyframes."""
    if not isinstance(system, System):
        return False
    owner = owner_of(system, obj)
    return owner.is_property_set("motus") and of_owner(system, owner).is_baked


def frames(system, obj):
    """(first, last) frame, as text, of what is baked of the system for an object; None where nothing is."""
    if not is_baked(system, obj):
        return None
    owner = owner_of(system, obj)
    # Where the owner drives others only, these have the keyframes.
    baked = [one for one in (obj, owner) if one.is_property_set("motus") and one.motus.bake.is_baked] or [
        one for one in bpy.data.objects if one.is_property_set("motus") and one.motus.bake.owner == owner]
    return tuple(f"{frame:g}" for frame in _range(baked[0].motus.bake)) if baked else ("?", "?")


def _range(bake):
    if bake.action and bake.frame_start == bake.frame_end:
        return bake.action.frame_range
    return bake.frame_start, bake.frame_end
