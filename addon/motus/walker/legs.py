"""Legs of a walker: find the objects or bones that are the feet, and the object or bone that is the body.

The owner is the object that walks. The body is a part of it that rises and leans with the feet.
"""

from typing import Any, NamedTuple

import bpy

from ..core.declare import leader_of, offered, registered
from ..core.file import deleted, libraries
from ..core.file.pointers import pointed


class Foot(NamedTuple):
    """A foot that exists. index: of its leg in the walker's settings. thing: the Object, or the PoseBone of the owner, that is the foot."""

    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    thing: Any

    @property
    def is_bone(self):
        return isinstance(self.thing, bpy.types.PoseBone)

    @property
    def driven(self):
        """The foot as an item of Entry.drives: the name of a bone, or an object."""
        return self.thing.name if self.is_bone else self.thing


def label(leg):
    """Name of a leg in the interface: the name of its foot's bone or object; "" if it has none. leg: settings of the leg."""
    foot = pointed(leg, "foot")
    return foot.name if foot else leg.name


def bone(leg):
    """Name of the bone that is a leg's foot; "" if the foot is an object, which the leg was named after. leg: settings of the leg."""
    return "" if pointed(leg, "foot") else leg.name


def feet(owner):
    """List the Foot of each leg whose foot exists and is the owner's; each object or bone appears once.

    A duplicate of a walker names the same foot objects as the original walker, which drives them: these are left out.
    """
    found, taken = [], set()
    for index, leg in enumerate(owner.motus.walker.legs):
        thing = _thing(owner, leg)
        if thing is not None and thing not in taken:
            taken.add(thing)
            found.append(Foot(index, thing))
    return found


def _thing(owner, leg):
    foot = pointed(leg, "foot")
    if foot is None:
        return owner.pose.bones.get(leg.name) if owner.pose else None
    if deleted.is_deleted(foot):
        return None
    return foot if libraries.is_free_or_of(foot, leader_of(registered["walker"], foot), owner) else None


def stretches(owner, leg):
    """Whether a leg can reach any distance: its chain in the system Inverse Kinematics has Stretch 1 and the foot as target.

    owner: object that walks. leg: settings of the leg.
    """
    own, foot = bone(leg), pointed(leg, "foot") or owner
    return bool(leg.name or foot != owner) and any(
        target.original == foot.original and (not own or name == own) for target, name in offered("ik").stretching_targets(owner)
    )


def names_body(owner):
    """Whether a walker's settings name an object or bone as the body that rises and leans, even if that no longer exists."""
    return bool(owner.motus.walker.body_bone if owner.pose else pointed(owner.motus.walker, "body"))


def body(owner):
    """Return the Object or PoseBone that rises and leans with a walker's feet; None if there is none."""
    settings = owner.motus.walker
    if owner.pose:
        return owner.pose.bones.get(settings.body_bone)
    thing = pointed(settings, "body")
    if thing is None or thing.parent != owner or thing.parent_type != 'OBJECT' or deleted.is_deleted(thing):
        return None
    return thing if libraries.is_free_or_of(thing, leader_of(registered["walker"], thing), owner) else None
