"""Signature of an owner's wiring: a text that changes whenever the owner has to be set up in a different way.

The owner is the object whose settings a system solves. Its wiring consists of hubs (hidden objects whose meshes carry a solver's driver
and results), proxies (hidden empties that bring a result to a bone or object), sinks (constraints, drivers and modifiers that apply
results), and the outlet (a custom property of the owner that repeats the solver's outputs).
"""

import hashlib
from typing import Any

import bpy

from ...blender import drivers
from ..hubs import outputs, sharing, traits
from ..sinks import proxy_sink
from . import solver_driver

VERSION = 3
"""Version of the way in which owners are wired. It is part of the signature: owners that an earlier version has wired are wired again."""


def has_strange_carriers(system, owner, parts):
    """Whether an owner uses hubs or proxies that are not its own, such as those of the object from which it was copied.

    A hub is a hidden object that computes for owners; a proxy is a hidden empty that brings a result to a bone or object. A hub is also not
    the owner's own if it is overridden, or if it comes from a different file than the owner. parts: Parts of the owner.
    """
    return not all(part.is_own for part in parts) or (system.groups is not None and proxy_sink.has_strange_proxies(owner))


def of(system, owner, groups):
    """Return the signature of an owner: a text that changes if the owner has to be wired in a different way.

    groups: Groups that the system declares for the owner; the text depends on their members, inputs, outputs and data.
    """
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
    ways: tuple[Any, ...] = traits.uses_attribute(system), outputs.wants_outlet(system, owner), sharing.can_share(system, owner)
    properties = [(group.key, one.output, _name(one.object, owner), one.path, one.index) for group in groups for one in group.properties]
    if solver_driver.waits_apart(owner, groups):
        ways = *ways, solver_driver.way_to_wait(owner, groups), properties
    return f"{VERSION} {hashlib.sha1(repr((ways, said)).encode()).hexdigest()}"


def _bone(thing):
    return thing.name if isinstance(thing, bpy.types.PoseBone) else ""


def _name(obj, owner):
    # The owner's name is left out, so that the signature of an object's copy equals that of the object from which it was copied.
    return "" if obj == owner else obj.name
