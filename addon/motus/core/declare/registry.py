"""Which features are registered, and which objects a system is wired on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from ..blender.poses import is_pose_outdated
from ..file.pointers import pointed
from .inputs import Variable
from .members import Group, Member
from .system import Feature, System

registered: dict[str, Feature] = {}
"""The registered features by name, systems among them."""


def systems() -> list[System]:
    """The registered systems: of all features those that are solved."""
    return [feature for feature in registered.values() if isinstance(feature, System)]


def laying() -> list[System]:
    """The registered systems that pose bones by their own transforms, as keys do: all other systems act on top (System.lays_pose)."""
    return [system for system in systems() if system.lays_pose]


def entries_on(owner: Any) -> Iterator[tuple[System, Any]]:
    """Yields (system, Entry) for each Entry of an owner that drives the owner, its bones or other objects.

    Systems that pose bones by their own transforms (System.lays_pose) are left out.
    """
    for system in systems():
        if system.entries and not system.lays_pose:
            for entry in system.entries(owner):
                yield system, entry


def offered(name: str) -> Any:
    """The functions that a registered feature offers to others (Feature.offers)."""
    return registered[name].offers


def of_owner(system: Feature, owner: Any) -> Any:
    """Settings of `system` on an object."""
    return getattr(owner.motus, system.name)


def has_settings(system: Feature, obj: Any) -> bool:
    """Whether an object has settings of the system; to ask it for them gives it some."""
    return obj.is_property_set("motus") and obj.motus.is_property_set(system.name)


def is_owner(system: System, obj: Any) -> bool:
    """Whether the system is set up on an object itself; False for an object that another object's settings drive."""
    return has_settings(system, obj) and can_own(system, obj) and of_owner(system, obj).is_active


def can_own(system: System, obj: Any) -> bool:
    """Whether an object is of a type that the system works on."""
    return not system.owner_types or obj.type in system.owner_types


def leader_of(system: System, obj: Any) -> Any:
    """The object whose settings of the system drive this one; None where it has its own, or none."""
    return pointed(of_owner(system, obj), "leader") if has_settings(system, obj) else None


def wired_on(thing: Any) -> Iterator[tuple[Any, list[System]]]:
    """Yields (owner, systems): an object with the systems that are wired on it, then the owners that drive it, each with one system."""
    yield thing, [one for one in systems() if is_owner(one, thing)]
    for one in systems():
        leader = leader_of(one, thing)
        if leader:
            yield leader, [one]


def groups_of(system: System, owner: Any) -> tuple[Group, ...]:
    """The groups of members that the system drives for an owner: one, where the system declares none.

    There are no groups where the system cannot work on the owner, nor where the system declares groups and the owner's pose is outdated.
    """
    if not can_own(system, owner):
        return ()
    if system.groups is not None:
        return () if is_pose_outdated(owner) else tuple(system.groups(owner))
    if system.has_modifier:
        return (Group(outputs=system.outputs),)
    channels = system.channels(of_owner(system, owner))
    members = tuple(Member(thing, channels, system.space, system.is_relative) for thing in system.members(owner))
    return (Group(members=members, outputs=system.outputs),)


def input_variables(system: System, owner: Any) -> Iterable[tuple[Any, Variable | None]]:
    """(input, Variable) for each declared input of a system; None instead of the Variable for inputs that need no driver variable."""
    settings = of_owner(system, owner)
    return [(declared, declared.variable(owner, settings)) for declared in system.inputs]


def described(system: Feature) -> list[Any]:
    """SystemPanels (core/interface/panels.py) from which the panel classes of a system were generated, each once."""
    found = (getattr(cls, "of_system", None) for cls in system.classes)
    return list(dict.fromkeys(one for one in found if one is not None))


def title(system: Feature) -> tuple[str, str]:
    """(label, context of its translation) under which a system stands in menus, panels and dialogs."""
    panel = next(iter(described(system)), None)
    return (panel.label, panel.translation_context) if panel and panel.label == system.label else (system.label, "*")
