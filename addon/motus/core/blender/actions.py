"""F-curves of a datablock, the same in every Blender: plain actions up to 4.3, slotted ones since."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterable, Iterator
from typing import Any

import bpy

from . import capabilities

Curves = Any
"""A collection of F-curves, which versions have under different types; or an empty tuple."""
OWN_CHANNEL = re.compile(r'pose\.bones\[(?:"(?P<bone>(?:[^"\\]|\\.)*)"|\d+)\]\.(?:location|rotation_\w+|scale)$')
"""Matches data paths of a bone's own transform. "bone" is its name, escaped; None where the path has its number."""


def fcurves(id_data: Any) -> Curves:
    """The F-curves that animate a datablock; an empty tuple where there are none."""
    return curves_of(id_data.animation_data)


def curves_of(player: Any) -> Curves:
    """F-curves that a player has: animation data, a strip of the NLA, or None."""
    action = player and player.action
    if not action:
        return ()
    if not capabilities.has_slotted_actions():
        return action.fcurves
    bag = player.action_slot and _channelbag(action, player.action_slot)
    return bag.fcurves if bag else ()


def curves_for_object(action: Any, slot: str = "", bones: Container[str] = ()) -> Curves:
    """The F-curves that an action has for an object.

    slot: identifier of one of its slots; "" takes the first one that animates one of these bones, else the first one of an object.
    """
    if not capabilities.has_slotted_actions():
        return action.fcurves
    found = [action.slots[slot]] if slot in action.slots else slots_for_objects(action)
    bags = [_channelbag(action, one) for one in found]
    best = next((bag for bag in bags if bag and animates(bag.fcurves, bones)), bags[0] if bags else None)
    return best.fcurves if best else ()


def animates(curves: Curves, bones: Container[str]) -> bool:
    """Whether one of the F-curves animates the own transform of one of these bones."""
    return any(bone_of(curve) in bones for curve in curves)


def bone_of(curve: bpy.types.FCurve) -> str | None:
    """Name of the bone whose own transform an F-curve animates; None for any other F-curve."""
    match = OWN_CHANNEL.match(curve.data_path)
    return bpy.utils.unescape_identifier(match["bone"]) if match and match["bone"] is not None else None


def slots_for_objects(action: Any) -> list[Any]:
    """The slots of an action that can animate an object."""
    return [slot for slot in action.slots if slot.target_id_type in {'OBJECT', 'UNSPECIFIED'}]


def players(id_data: Any) -> list[Any]:
    """All that plays an action for a datablock: its animation data, and the strips of its NLA. Images, for one, have none."""
    animation = getattr(id_data, "animation_data", None)
    if animation is None:
        return []
    return [animation, *(strip for track in animation.nla_tracks for strip in track.strips if strip.action)]


def make_own(player: Any) -> None:
    """Let nobody else play the action of animation data or of a strip: a copy where it is shared or linked."""
    action = player.action
    if not _is_linked(action) and action.users - action.use_fake_user <= 1:
        return
    slot = player.action_slot.identifier if capabilities.has_slotted_actions() and player.action_slot else ""
    # The copy of an override is an override again.
    player.action = (action.override_library.reference if action.override_library else action).copy()
    if slot:
        player.action_slot = player.action.slots.get(slot)


def make_local(id_data: Any) -> None:
    """Let a datablock play a local copy of its action if the action is linked, and so cannot be keyed."""
    animation = id_data.animation_data
    if animation and animation.action and _is_linked(animation.action):
        make_own(animation)


def _is_linked(action: bpy.types.Action) -> bool:
    """Whether its keys are a library's, which it overrides at most."""
    return bool(action.library or action.override_library)


def all_fcurves(action: Any) -> Iterable[Curves]:
    """The F-curves of an action, of all its slots, as an iterable of collections."""
    if not capabilities.has_slotted_actions():
        return (action.fcurves,)
    return (bag.fcurves for layer in action.layers for strip in layer.strips for bag in strip.channelbags)


def find(id_data: Any, data_path: str, index: int = 0) -> bpy.types.FCurve | None:
    """The F-curve of one property, or None."""
    curves = fcurves(id_data)
    return curves.find(data_path, index=index) if curves else None


def slot_identifier(id_data: Any) -> str:
    """Identifier of the slot of its action that animates the datablock; "" if there is none, or actions have no slots."""
    animation = id_data.animation_data
    slot = animation.action_slot if animation and capabilities.has_slotted_actions() else None
    return slot.identifier if slot else ""


def assign(id_data: Any, action: Any, slot: str = "") -> None:
    """Let an action, by the slot of this identifier, animate the datablock; None takes it off."""
    animation = id_data.animation_data or id_data.animation_data_create()
    animation.action = action
    if action and capabilities.has_slotted_actions():
        animation.action_slot = action.slots.get(slot)


def assign_copy(id_data: Any, name: str) -> Any:
    """Let a copy of its action, without the slots of others, animate the datablock; a new one where it has none.

    Returns what holds the F-curves (`fcurves`) and their groups (`groups`).
    """
    animation = id_data.animation_data or id_data.animation_data_create()
    slot = slot_identifier(id_data)
    action = animation.action.copy() if animation.action else bpy.data.actions.new(name)
    action.name = name
    action.use_fake_user = False
    assign(id_data, action, slot)
    if not capabilities.has_slotted_actions():
        return action
    if animation.action_slot is None:
        animation.action_slot = action.slots.new(id_data.id_type, id_data.name)
    for other in [one for one in action.slots if one != animation.action_slot]:
        action.slots.remove(other)
    return _ensure_channelbag(action, animation.action_slot)


def own_curves(id_data: Any, is_meant: Callable[[str], bool]) -> Iterator[Curves]:
    """Yields, of each action that is played for it, the F-curves, if is_meant(data path) holds for any.

    Where others play the action too, or it is linked, it plays a copy from then on; but not in the tweak mode of the NLA, in
    which Blender lets no action be exchanged.
    """
    for player in players(id_data):
        if any(is_meant(curve.data_path) for curve in curves_of(player)):
            if not id_data.animation_data.use_tweak_mode:
                make_own(player)
            yield curves_of(player)


def remove(id_data: Any, prefixes: str | tuple[str, ...]) -> None:
    """Remove keys and drivers whose data paths have one of these beginnings, and animation data that is empty then.

    Of strips of the NLA the keys alone.
    """
    animation = id_data.animation_data
    if animation is None:
        return
    for curve in [curve for curve in animation.drivers if curve.data_path.startswith(prefixes)]:
        animation.drivers.remove(curve)
    had_curves = bool(fcurves(id_data))
    for curves in own_curves(id_data, lambda path: path.startswith(prefixes)):
        for curve in [curve for curve in curves if curve.data_path.startswith(prefixes)]:
            curves.remove(curve)
    if had_curves and not fcurves(id_data):
        animation.action = None
    if not animation.action and not animation.drivers and not animation.nla_tracks:
        id_data.animation_data_clear()


def new_fcurve(bag: Any, data_path: str, index: int, group: str) -> bpy.types.FCurve:
    """A new F-curve in what assign_copy() returned, listed under `group` in the animation editors."""
    curve = bag.fcurves.new(data_path, index=index)
    curve.group = bag.groups.get(group) or bag.groups.new(group)
    return curve


def _channelbag(action: Any, slot: Any) -> Any:
    for layer in action.layers:
        for strip in layer.strips:
            bag = strip.channelbag(slot)
            if bag:
                return bag
    return None


def _ensure_channelbag(action: Any, slot: Any) -> Any:
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type='KEYFRAME')
    return strip.channelbag(slot, ensure=True)
