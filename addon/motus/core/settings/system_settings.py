"""What every system's settings have, and what happens when they are edited."""

from typing import Any

import bpy

from .. import wiring
from ..declare import registered
from ..file.pointers import to_object

ANIMATED: Any = {'ANIMATABLE'}
OVERRIDABLE: Any = {'LIBRARY_OVERRIDABLE'}
EXTENDABLE: Any = {'LIBRARY_OVERRIDABLE', 'USE_INSERTION'}
"""Options of properties: keyed or driven, changed by overrides, and lists that overrides add to."""

NO_KEYS = ". Cannot be keyed: the whole motion follows from it"
"""Ends the description of a number that is not ANIMATED since each frame of another one would be a frame of another motion."""


def _system_of(item):
    """The System that settings belong to. item: the property group of the settings, or one inside it, such as an entry of a list."""
    return registered[item.path_from_id().split(".")[1].partition("[")[0]]


def rewire(item, _context):
    """`update` callback of a property that decides which drivers and constraints a system needs, such as a target: wire the owner again."""
    if not _is_keyword(item):
        wiring.refresh(_system_of(item), item.id_data)


def touch(item, _context):
    """`update` of a property whose change only needs a new evaluation."""
    if _is_keyword(item):
        return
    system = _system_of(item)
    if wiring.is_attached(system, item.id_data):
        wiring.touch(system, item.id_data)


def _is_keyword(item):
    """Whether an `update` callback was called for an operator's property and not for a setting.

    Operators may have the same properties as settings, but nothing to evaluate.
    """
    return not isinstance(item, bpy.types.PropertyGroup)


class MOTUS_PG_helper(bpy.types.PropertyGroup):
    """List item that refers to a hidden helper object, created when a system is set up on its owner."""

    object: to_object(name="Object", description="Hidden object that computes for this one", override={'LIBRARY_OVERRIDABLE'})


class SystemSettings:
    """Mixin for the settings of every system: the state of its set-up on an owner, and the hidden objects that belong to it."""

    is_active: bpy.props.BoolProperty(
        name="Active", description="This system drives the object", options=set(), override={'LIBRARY_OVERRIDABLE'}
    )
    is_baked: bpy.props.BoolProperty(
        name="Baked",
        description="The motion stands in keyframes and the live set-up is switched off",
        options=set(),
        override={'LIBRARY_OVERRIDABLE'},
    )
    is_released: bpy.props.BoolProperty(
        name="Released",
        description="What the library has wired on this override was taken off it",
        options=set(),
        override={'LIBRARY_OVERRIDABLE'},
    )
    hub: to_object(name="Hub", description="Hidden object that computes for all members", override={'LIBRARY_OVERRIDABLE'})
    row: bpy.props.IntProperty(
        name="Row",
        description="Which of the objects that share the hub this one is",
        min=0,
        options=set(),
        override={'LIBRARY_OVERRIDABLE'},
    )
    more_hubs: bpy.props.CollectionProperty(
        type=MOTUS_PG_helper,
        name="More Hubs",
        description="Hubs of the groups but the first, by the groups' keys",
        override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'},
    )
    targets: bpy.props.CollectionProperty(
        type=MOTUS_PG_helper,
        name="Targets",
        description="Hidden objects that the constraints have as targets",
        override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'},
    )
    wired: bpy.props.StringProperty(
        name="Wired", description="What was wired, to notice where it has changed since", options=set(), override={'LIBRARY_OVERRIDABLE'}
    )
    order_proxy: to_object(name="Order Proxy", description="Hidden object that lets the curve's deformation be evaluated first")
    leader: to_object(name="Leader", description="Object whose settings drive this one")


classes = (MOTUS_PG_helper,)
