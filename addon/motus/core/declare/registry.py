"""Registry of features and systems, and lookups of their owners.

A feature is a folder of the add-on with settings, operators and panels; a system is a feature whose settings are solved. The owner is an
object on which a system is set up, that is, whose settings are solved.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from ..blender.poses import is_pose_outdated
from ..file.pointers import pointed
from .inputs import Variable
from .members import Group, Member
from .system import Feature, System

registered: dict[str, Feature] = {}
"""Registered features by name, systems included."""


def systems() -> list[System]:
    """The registered features that are Systems."""
    return [feature for feature in registered.values() if isinstance(feature, System)]


def laying_systems() -> list[System]:
    """The registered systems that set the own transforms of bones, as keys do, beneath all constraints and all other systems.

    They declare System.lays_pose, such as the system of animation layers.
    """
    return [system for system in systems() if system.lays_pose]


def laid_beneath(system: System) -> list[System]:
    """The systems whose poses of bones are the start of a system's own: laying_systems(), unless the system itself is one of them.

    Systems without entries drive no bones.
    """
    return [] if system.entries is None or system.lays_pose else laying_systems()


def entries_on(owner: Any, without: System | None = None) -> Iterator[tuple[System, Any]]:
    """Yield (system, Entry) for each Entry of an owner, an item in its list of settings that drives bones or objects.

    Systems that pose bones by their own transforms (System.lays_pose) are left out. without: a System that is left out too.
    """
    for system in systems():
        if system.entries and not system.lays_pose and system != without and has_settings(system, owner):
            for entry in system.entries(owner):
                yield system, entry


def offered(name: str) -> Any:
    """The functions that a registered feature offers to different features (Feature.offers). name: of the feature."""
    return registered[name].offers


def of_owner(system: Feature, owner: Any) -> Any:
    """The property group with the settings of a system on an object. Reading it creates it; has_settings() tells whether it exists."""
    return getattr(owner.motus, system.name)


def has_settings(system: Feature, obj: Any) -> bool:
    """Whether an object has settings of a system. Nothing is created, whereas of_owner() would create settings."""
    return obj.is_property_set("motus") and obj.motus.is_property_set(system.name)


def is_owner(system: System, obj: Any) -> bool:
    """Whether a system is set up on an object itself. False for an object that is driven by the settings of another object."""
    return has_settings(system, obj) and can_own(system, obj) and of_owner(system, obj).is_active


def can_own(system: System, obj: Any) -> bool:
    """Whether an object is of a type on which a system can be set up (System.owner_types)."""
    return not system.owner_types or obj.type in system.owner_types


def leader_of(system: System, obj: Any) -> Any:
    """The object whose settings of a system drive `obj`, such as a wagon's engine; None if none does."""
    return pointed(of_owner(system, obj), "leader") if has_settings(system, obj) else None


def wired_on(thing: Any) -> Iterator[tuple[Any, list[System]]]:
    """Yield (thing, systems that are set up on it), then (owner, [system]) for each object whose settings drive `thing`."""
    yield thing, [one for one in systems() if is_owner(one, thing)]
    for one in systems():
        leader = leader_of(one, thing)
        if leader:
            yield leader, [one]


def groups_of(system: System, owner: Any) -> tuple[Group, ...]:
    """The Groups that a system computes for an owner; one Group with all members if the system declares no groups.

    There are none if the system cannot work on the owner, or if it declares groups and Blender has not evaluated the owner's pose since
    its armature was exchanged.
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
    """(input, Variable) for each declared input of a system on an owner; None in place of the Variable if the input needs none."""
    settings = of_owner(system, owner)
    return [(declared, declared.variable(owner, settings)) for declared in system.inputs]


def described(system: Feature) -> list[Any]:
    """The SystemPanels (core/interface/panels.py) from which the panel classes of a system were generated, without repetitions."""
    found = (getattr(cls, "of_system", None) for cls in system.classes)
    return list(dict.fromkeys(one for one in found if one is not None))


def page(feature: Feature) -> str:
    """Name of the manual's page of a feature."""
    return feature.page or feature.name


def title(system: Feature) -> tuple[str, str]:
    """(label, translation context of the label) of a system, for menus, panels and dialogs."""
    panel = next(iter(described(system)), None)
    return (panel.label, panel.translation_context) if panel and panel.label == system.label else (system.label, "*")
