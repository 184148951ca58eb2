"""The legs of a walker: whose feet they are, and which of them are there."""

from typing import Any, NamedTuple

import bpy

from ..core.declare import leader_of, offered, registered
from ..core.file import deleted, libraries
from ..core.file.pointers import pointed


class Foot(NamedTuple):
    """The foot of a leg that is there. index: of the leg. thing: an Object, or a PoseBone of the owner."""

    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    thing: Any

    @property
    def is_bone(self):
        return isinstance(self.thing, bpy.types.PoseBone)

    @property
    def driven(self):
        """The foot as Entry.drives names it: the name of the bone, or the object."""
        return self.thing.name if self.is_bone else self.thing


def label(leg):
    """What the interface calls a leg."""
    foot = pointed(leg, "foot")
    return leg.name or (foot.name if foot else "")


def feet(owner):
    """The Foots that the owner drives, each thing once. The copy of a body lists the first one's objects, which are not its own."""
    found, taken = [], set()
    for index, leg in enumerate(owner.motus.walker.legs):
        thing = _thing(owner, leg)
        if thing is not None and thing not in taken:
            taken.add(thing)
            found.append(Foot(index, thing))
    return found


def _thing(owner, leg):
    if leg.name:
        return owner.pose.bones.get(leg.name) if owner.pose else None
    foot = pointed(leg, "foot")
    if foot is None or deleted.is_deleted(foot):
        return None
    return foot if libraries.is_free_or_of(foot, leader_of(registered["walker"], foot), owner) else None


def stretches(owner, leg):
    """Whether a leg can reach any distance: its IK chain has Stretch 1 and the foot as its target."""
    foot = owner if leg.name else pointed(leg, "foot")
    return foot is not None and any(
        target.original == foot.original and (not leg.name or bone == leg.name) for target, bone in offered("ik").stretching_targets(owner)
    )


def names_body(owner):
    """Whether the settings say what rises and leans, be it there or not."""
    return bool(owner.motus.walker.body_bone if owner.pose else pointed(owner.motus.walker, "body"))


def body(owner):
    """The Object or PoseBone that rises and leans; None without one."""
    settings = owner.motus.walker
    if owner.pose:
        return owner.pose.bones.get(settings.body_bone)
    thing = pointed(settings, "body")
    if thing is None or thing.parent != owner or thing.parent_type != 'OBJECT' or deleted.is_deleted(thing):
        return None
    return thing if libraries.is_free_or_of(thing, leader_of(registered["walker"], thing), owner) else None
