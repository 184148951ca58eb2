"""How an owner is to be wired, as a text: the signature, by which a change of that is noticed."""

import hashlib
from typing import Any

import bpy

from ...blender import drivers
from ...declare import OwnMatrix, input_variables
from ...evaluated import copies
from ..hubs import hub_lookup, outbox
from ..sinks import attribute_sink, proxy_sink
from . import sharing

VERSION = 2
"""Version of how owners are wired. It is part of the signature, so an owner that another version wired is wired anew."""


def has_strange_carriers(system, owner):
    """Whether the owner was copied from another one and still hangs on its hubs or proxies."""
    return any(_is_strange(system, owner, hub) for _, hub in hub_lookup.hubs(system, owner)) or (
        system.groups is not None and proxy_sink.has_strange_proxies(owner)
    )


def _is_strange(system, owner, hub):
    if outbox.is_shared(system, hub.data):
        return bool(hub.library or hub.override_library) or not sharing.is_own(system, owner, hub.data)
    return not hub_lookup.is_own_hub(hub, owner)


def wants_outlet(system, owner):
    """Whether the owner is to have an outlet: see outputs.create_outlet.

    To Blender the outlet is one with the owner's settings, for which the solvers of its other systems wait, and by those its
    matrix does: an owner whose solver waits for its own matrix has none.
    """
    return bool(system.outputs) and not copies.has_animated_settings(owner) and not _waits_for_itself(system, owner)


def _waits_for_itself(system, owner):
    return any(variable for declared, variable in input_variables(system, owner) if isinstance(declared, OwnMatrix))


def wait_for_keys(system, owner):
    """Data path of a custom property of the owner that Blender evaluates after the owner's keys, and that nothing else precedes.

    The settings themselves are one with all plain properties of the owner to Blender, which sinks may drive.
    """
    key = wait_key(system)
    owner[key] = 0.0
    drivers.copy_value(owner, f'["{key}"]')
    return f'["{key}"]'


def wait_key(system):
    """Name of that property."""
    return f"motus_{system.name}_wait"


def waits_apart(owner, groups):
    """Whether solvers must not wait for all of an owner's plain properties.

    So it is with solvers that drive some of these properties, and with all solvers on a camera: its properties come after its
    data's, which a solver may drive that waits for the camera.
    """
    return owner.type == 'CAMERA' or any(group.properties for group in groups)


def way_to_wait(owner, groups):
    """How a solver that waits apart waits for animated settings: "" where there is no need, "keys", or "settings"."""
    if not waits_apart(owner, groups) or not copies.has_animated_settings(owner):
        return ""
    return "settings" if copies.has_driven_settings(owner) else "keys"


def of(system, owner, groups):
    """A text that changes when a system is to be wired otherwise on an owner: in another way, or in other groups that it declares."""
    driven = drivers.driven_bones(owner)
    said = [
        (
            group.key,
            group.outputs,
            sorted(group.data.items()),
            [
                (
                    _name(member.thing.id_data, owner),
                    _bone(member.thing),
                    sorted(member.channels),
                    member.owner_space,
                    member.is_relative,
                    _bone(member.thing) in driven,
                )
                for member in group.members
            ],
            [(type(one).__name__, _name(one.object, owner), one.bone) for one in group.inputs],
        )
        for group in (groups if system.groups is not None else ())
    ]
    ways: tuple[Any, ...] = attribute_sink.serves(system), wants_outlet(system, owner), sharing.can_share(system, owner)
    properties = [(group.key, one.output, _name(one.object, owner), one.path, one.index) for group in groups for one in group.properties]
    if waits_apart(owner, groups):
        ways = *ways, way_to_wait(owner, groups), properties
    return f"{VERSION} {hashlib.sha1(repr((ways, said)).encode()).hexdigest()}"


def _bone(thing):
    return thing.name if isinstance(thing, bpy.types.PoseBone) else ""


def _name(obj, owner):
    # A copy is wired as the one it was copied from.
    return "" if obj == owner else obj.name
