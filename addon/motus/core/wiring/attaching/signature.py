"""Signature of an owner's wiring: a text that changes whenever the owner has to be set up in a different way.

The owner is the object whose settings a system solves. Its wiring consists of hubs (hidden objects whose meshes carry a solver's driver
and results), proxies (hidden empties that bring a result to a bone or object), sinks (constraints, drivers and modifiers that apply
results), and the outlet (a custom property of the owner that repeats the solver's outputs).
"""

import hashlib
from typing import Any

import bpy

from ...blender import drivers
from ...declare import OwnMatrix, input_variables
from ...evaluated import copies
from ..hubs import hub_lookup, outbox
from ..sinks import attribute_sink, proxy_sink
from . import sharing

VERSION = 3
"""Version of the way in which owners are wired. It is part of the signature: owners that an earlier version has wired are wired again."""


def has_strange_carriers(system, owner):
    """Whether an owner is a copy that still depends on the hubs or proxies of the object from which it was copied.

    Hubs and proxies are hidden objects that compute and bring results for one owner. Also true for a shared hub that is linked or
    overridden.
    """
    return any(_is_strange(system, owner, hub) for _, hub in hub_lookup.hubs(system, owner)) or (
        system.groups is not None and proxy_sink.has_strange_proxies(owner)
    )


def _is_strange(system, owner, hub):
    if outbox.is_shared(system, hub.data):
        return bool(hub.library or hub.override_library) or not sharing.is_own(system, owner, hub.data)
    return not hub_lookup.is_own_hub(hub, owner)


def wants_outlet(system, owner):
    """Whether an owner is to have an outlet, the custom property that repeats the solver's outputs (see outputs.create_outlet).

    An owner has no outlet if the system has no outputs, or if settings are animated. It also has none if the solver reads the owner's
    own world matrix: the outlet and the settings are one node in Blender's dependency graph, the owner's other solvers wait for this
    node, and the matrix waits for those solvers, so the graph would have a cycle.
    """
    return bool(system.outputs) and not copies.has_animated_settings(owner) and not _waits_for_itself(system, owner)


def _waits_for_itself(system, owner):
    return any(variable for declared, variable in input_variables(system, owner) if isinstance(declared, OwnMatrix))


def wait_for_keys(system, owner):
    """Give the owner a custom property with a driver, to wait for the owner's F-curves; returns the data path of the property.

    Blender evaluates the property after the owner's keyframes, and nothing else precedes it. The settings cannot be used for this: all
    plain properties of an object are one node in Blender's dependency graph, and sinks may drive some of these properties.
    """
    key = wait_key(system)
    owner[key] = 0.0
    drivers.copy_value(owner, f'["{key}"]')
    return f'["{key}"]'


def wait_key(system):
    """Return the name of the custom property that wait_for_keys() creates on an owner."""
    return f"motus_{system.name}_wait"


def waits_apart(owner, groups):
    """Whether the owner's solvers must not wait for the owner's plain properties, which are a single node in Blender's dependency graph.

    If solvers drive some of these properties, waiting would be a dependency cycle. On a camera no solver may wait: Blender evaluates
    the properties of a camera object after those of the camera's data, which may be driven by a solver that waits for the camera.
    """
    return owner.type == 'CAMERA' or any(group.properties for group in groups)


def way_to_wait(owner, groups):
    """Return how a solver, for which waits_apart() is true, waits for animated settings: "", "keys" or "settings".

    "": there is nothing to wait for. "keys": it waits by the property of wait_for_keys(). "settings": a driver sets a setting, so the
    solver waits for the settings themselves.
    """
    if not waits_apart(owner, groups) or not copies.has_animated_settings(owner):
        return ""
    return "settings" if copies.has_driven_settings(owner) else "keys"


def of(system, owner, groups):
    """Return the signature: a text that changes if the owner has to be wired in a different way, or declares different groups."""
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
    # The owner's name is left out, so that the signature of an object's copy equals that of the object from which it was copied.
    return "" if obj == owner else obj.name
