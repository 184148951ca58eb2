"""Base class for the settings of every system, and the `update` callbacks of their properties."""

from typing import Any

import bpy

from .. import wiring
from ..declare import registered
from ..file.pointers import to_object

ANIMATED: Any = {'ANIMATABLE'}
OVERRIDABLE: Any = {'LIBRARY_OVERRIDABLE'}
EXTENDABLE: Any = {'LIBRARY_OVERRIDABLE', 'USE_INSERTION'}
"""Options for properties that may be keyed or driven, that library overrides may change, and lists that overrides may extend."""

NO_KEYS = ". Cannot be keyed: the whole motion follows from it"
"""End of the tooltip of a number that is not ANIMATED: with a different number at each frame, each would show a different motion."""


def _system_of(item):
    """The System to which settings belong.

    item: the property group of the settings, or a property group inside it, such as an entry of a list.
    """
    return registered[item.path_from_id().split(".")[1].partition("[")[0]]


def rewire(item, _context):
    """`update` callback of a property that decides which drivers and constraints a system needs, such as a target.

    It wires the owner again: updates its drivers and constraints.
    """
    if not _is_keyword(item):
        wiring.refresh(_system_of(item), item.id_data)


def touch(item, _context):
    """`update` callback of a property whose change only requires a new evaluation of the owner."""
    if _is_keyword(item):
        return
    system = _system_of(item)
    if wiring.is_attached(system, item.id_data):
        wiring.touch(system, item.id_data)


def _is_keyword(item):
    """Whether an `update` callback was called for an operator's property, not for a setting. item: what the callback received.

    Operators may have the same properties as settings, but there is nothing to evaluate for them.
    """
    return not isinstance(item, bpy.types.PropertyGroup)


_STATE: Any = {"options": {'HIDDEN'}, "override": OVERRIDABLE}
_HELPERS: Any = {"options": {'HIDDEN'}, "override": EXTENDABLE}
"""Of what Motus notes in a file: the interface does not show it."""


class MOTUS_PG_helper(bpy.types.PropertyGroup):
    """List item that points to a hidden helper object, which Motus creates when a system is set up on an object."""

    object: to_object(name="Object", description="Hidden object that computes for this one", **_STATE)


class SystemSettings:
    """Mixin for the settings of every system on an owner: state of the set-up, and pointers to its hidden helper objects.

    The owner is the object that has the settings.
    """

    is_active: bpy.props.BoolProperty(name="Active", description="This system drives the object", **_STATE)
    is_baked: bpy.props.BoolProperty(
        name="Baked", description="The motion stands in keyframes and the live set-up is switched off", **_STATE
    )
    is_released: bpy.props.BoolProperty(
        name="Released", description="What the library has wired on this override was taken off it", **_STATE
    )
    hub: to_object(name="Hub", description="Hidden object that computes for all members", **_STATE)
    row: bpy.props.IntProperty(name="Row", description="Which of the objects that share the hub this one is", min=0, **_STATE)
    more_hubs: bpy.props.CollectionProperty(
        type=MOTUS_PG_helper, name="More Hubs", description="Hubs of the groups but the first, by the groups' keys", **_HELPERS
    )
    targets: bpy.props.CollectionProperty(
        type=MOTUS_PG_helper, name="Targets", description="Hidden objects that the constraints have as targets", **_HELPERS
    )
    wired: bpy.props.StringProperty(name="Wired", description="What was wired, to notice where it has changed since", **_STATE)
    order_proxy: to_object(
        name="Order Proxy", description="Hidden object that lets the curve's deformation be evaluated first", options={'HIDDEN'}
    )
    leader: to_object(name="Leader", description="Object whose settings drive this one", options={'HIDDEN'})


classes = (MOTUS_PG_helper,)
