"""F-curves of a datablock, with one interface for all Blender versions: plain actions up to 4.3, slotted actions since 4.4."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterable, Iterator
from typing import Any

import bpy

from . import capabilities
from .poses import TO_BONE

Curves = Any
"""Type of a collection of F-curves, which differs between Blender versions. Functions return an empty tuple if there is none."""
OWN_CHANNEL = re.compile(TO_BONE + r"\.(?:location|rotation_\w+|scale)$")
"""Matches data paths of a bone's location, rotation and scale, with the groups of poses.TO_BONE."""


def fcurves(id_data: Any) -> Curves:
    """The F-curves of the action that is assigned to a datablock; an empty tuple if there are none."""
    return curves_of(id_data.animation_data)


def curves_of(player: Any) -> Curves:
    """The F-curves that a player plays; an empty tuple if there are none. player: AnimData, an NLA strip, or None."""
    action = player and player.action
    if not action:
        return ()
    if not capabilities.has_slotted_actions():
        return action.fcurves
    bag = player.action_slot and _channelbag(action, player.action_slot)
    return bag.fcurves if bag else ()


def curves_for_object(action: Any, slot: str = "", bones: Container[str] = ()) -> Curves:
    """The F-curves that an action has for an object; an empty tuple if there are none.

    slot: identifier of the action's slot to use. If the action has no such slot, the first slot for objects that animates one of the bones
    is used, or else its first slot for objects. bones: names of bones.
    """
    if not capabilities.has_slotted_actions():
        return action.fcurves
    found = [action.slots[slot]] if slot in action.slots else slots_for_objects(action)
    bags = [_channelbag(action, one) for one in found]
    best = next((bag for bag in bags if bag and animates(bag.fcurves, bones)), bags[0] if bags else None)
    return best.fcurves if best else ()


def bag_for_object(action: Any, slot: str, bones: Container[str], name: str) -> Any:
    """The action or channelbag that holds the F-curves which curves_for_object() gives; it is created if there is none.

    name: of the slot that is created if the action has none for objects.
    """
    if not capabilities.has_slotted_actions():
        return action
    found = [action.slots[slot]] if slot in action.slots else slots_for_objects(action)
    bags = [bag for bag in (_channelbag(action, one) for one in found) if bag]
    best = next((bag for bag in bags if animates(bag.fcurves, bones)), bags[0] if bags else None)
    return best or _ensure_channelbag(action, found[0] if found else action.slots.new('OBJECT', name))


def animates(curves: Curves, bones: Container[str]) -> bool:
    """Whether one of the F-curves animates location, rotation or scale of one of these bones. bones: names."""
    return any(bone_of(curve) in bones for curve in curves)


def bone_of(curve: bpy.types.FCurve) -> str | None:
    """Name of the bone whose location, rotation or scale an F-curve animates; None if it animates something different."""
    match = OWN_CHANNEL.match(curve.data_path)
    return bpy.utils.unescape_identifier(match["bone"]) if match and match["bone"] is not None else None


def slots_for_objects(action: Any) -> list[Any]:
    """List of the slots of an action that can animate an object."""
    return [slot for slot in action.slots if slot.target_id_type in {'OBJECT', 'UNSPECIFIED'}]


def players(id_data: Any) -> list[Any]:
    """List of everything that plays an action for a datablock: its animation data, and the NLA strips that have an action.

    The list is empty if the datablock has no animation data, or is of a type that cannot have any, such as images.
    """
    animation = getattr(id_data, "animation_data", None)
    if animation is None:
        return []
    return [animation, *(strip for track in animation.nla_tracks for strip in track.strips if strip.action)]


def make_own(player: Any) -> None:
    """Replace the action of a player by a copy, if the action is linked or has further users.

    player: AnimData or an NLA strip that has an action.
    """
    action = player.action
    if not is_linked(action) and action.users - action.use_fake_user <= 1:
        return
    slot = player.action_slot.identifier if capabilities.has_slotted_actions() and player.action_slot else ""
    # A copy of a library override is an override too, so the copy is made of the overridden action.
    player.action = (action.override_library.reference if action.override_library else action).copy()
    if slot:
        player.action_slot = player.action.slots.get(slot)


def is_linked(action: bpy.types.Action) -> bool:
    """Whether the keys of an action belong to a library file: the action is linked, or is a library override."""
    return bool(action.library or action.override_library)


def make_local(id_data: Any) -> None:
    """Replace the action of a datablock by a local copy if the action is linked, since a linked action cannot be keyed."""
    animation = id_data.animation_data
    if animation and animation.action and is_linked(animation.action):
        make_own(animation)


def all_fcurves(action: Any) -> Iterable[Curves]:
    """Iterable of the F-curve collections of an action, one for each slot in each strip; of an action without slots the only one."""
    if not capabilities.has_slotted_actions():
        return (action.fcurves,)
    return (bag.fcurves for layer in action.layers for strip in layer.strips for bag in strip.channelbags)


def find(id_data: Any, data_path: str, index: int = 0) -> bpy.types.FCurve | None:
    """The F-curve of one property of a datablock; None if there is none. index: of the component of an array property."""
    curves = fcurves(id_data)
    return curves.find(data_path, index=index) if curves else None


def slot_identifier(id_data: Any) -> str:
    """Identifier of the action slot that animates a datablock; "" if there is none, or if actions have no slots."""
    animation = id_data.animation_data
    slot = animation.action_slot if animation and capabilities.has_slotted_actions() else None
    return slot.identifier if slot else ""


def assign(id_data: Any, action: Any, slot: str = "") -> None:
    """Assign an action to a datablock. action: None removes the assigned action. slot: identifier of the slot to use."""
    animation = id_data.animation_data or id_data.animation_data_create()
    animation.action = action
    if action and capabilities.has_slotted_actions():
        animation.action_slot = action.slots.get(slot)


def assign_copy(id_data: Any, name: str) -> Any:
    """Assign to a datablock a copy of its action in which only the datablock's own slot is left; a new action if it has none.

    name: of the copy or the new action. Returns the action or channelbag that holds the F-curves (`fcurves`) and their groups (`groups`).
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
    """Yield the F-curves of each action that a datablock plays, if is_meant(data path) is true for one of them.

    An action that is linked or has further users is replaced by a copy first. In the tweak mode of the NLA no copy is made, since Blender
    does not let scripts exchange an action then.
    """
    for player in players(id_data):
        if any(is_meant(curve.data_path) for curve in curves_of(player)):
            if not id_data.animation_data.use_tweak_mode:
                make_own(player)
            yield curves_of(player)


def remove(id_data: Any, prefixes: str | tuple[str, ...]) -> None:
    """Remove F-curves and drivers whose data paths have one of these prefixes, and animation data that is empty afterwards.

    F-curves in actions of NLA strips are removed too; the strips stay.
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
    """Create an F-curve in the action or channelbag that assign_copy() returned. group: name of its group in the animation editors."""
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
