"""Setting walkers up and taking them back: plain functions behind the operators."""

from typing import Any, NamedTuple

import bpy
from mathutils import Vector

from ..core import wiring
from ..core.blender import actions
from ..core.declare import has_settings, of_owner, registered
from ..core.declare.forgetting import forget, says_anything
from ..core.file.pointers import pointed
from ..core.settings import entries
from . import legs

PREFIX = "motus.walker."
SHARES = {"stride": 0.5, "clearance": 0.16, "reach_up": 0.8, "reach_down": 1.2}
"""Lengths where none are given, times how far the feet stand from their middle on the average."""


class Leg(NamedTuple):
    """A leg of a walker that is about to be set up. bone: name of the owner's bone at the foot, or "" and foot: the foot's Object.

    hip: place in the owner's space. length: of the leg, 0 if it is unknown.
    """

    bone: str
    foot: Any
    hip: Vector
    length: float

    def place(self, owner):
        """The foot's place in the world; owner and foot are both original or both evaluated."""
        return owner.matrix_world @ owner.pose.bones[self.bone].head if self.bone else self.foot.matrix_world.translation


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["walker"]


def attach(context, owner, found, body, changes):
    """Let an owner walk. found: Legs. body: name of a bone, or an Object, or None. changes: settings by name.

    The feet stand where they belong; of lengths that are not given those of a new walker suit the legs. Feet that it has already
    keep their phases.
    """
    was_active = owner.motus.walker.is_active
    phases = {(leg.name, pointed(leg, "foot")): leg.phase for leg in owner.motus.walker.legs}
    rests = _own_rests(context, owner, found)
    with entries.unwired(owner.motus.walker) as settings:
        settings.legs.clear()
        for leg, rest in zip(found, rests):
            entry = settings.legs.add()
            entry.name, entry.foot, entry.rest, entry.hip, entry.length = leg.bone, leg.foot, rest, leg.hip, leg.length
            entry.phase = phases.get((leg.bone, leg.foot), 0.0)
        if owner.pose:
            settings.body_bone = body or ""
        else:
            settings.body = body
    change(owner, changes if was_active else lengths(rests) | changes)
    _forget_others()


def _forget_others():
    """Let objects that were feet or bodies, and that nobody drives any more, hold no settings."""
    for obj in bpy.data.objects:
        if has_settings(system(), obj) and not (obj.library or says_anything(of_owner(system(), obj))):
            forget(system(), obj)


def change(owner, changes):
    """Set several walker settings of an owner, {name: value}, and wire the owner once."""
    with entries.unwired(owner.motus.walker) as settings:
        for name, value in changes.items():
            setattr(settings, name, value)
    wire(owner)


def wire(owner):
    """Wire an owner as its settings are now."""
    if owner.motus.walker.is_active:
        wiring.refresh(system(), owner)
    else:
        wiring.attach(system(), owner)


def _own_rests(context, owner, found):
    """Rest positions of the feet of Legs by their own transforms, in the owner's space."""
    is_active = owner.motus.walker.is_active
    if is_active:
        wiring.set_muted(system(), owner, True)
    try:
        context.view_layer.update()
        depsgraph = context.view_layer.depsgraph
        evaluated = owner.evaluated_get(depsgraph)
        inverse = evaluated.matrix_world.inverted_safe()
        return [inverse @ leg._replace(foot=leg.foot and leg.foot.evaluated_get(depsgraph)).place(evaluated) for leg in found]
    finally:
        if is_active:
            wiring.set_muted(system(), owner, False)


def lengths(rests):
    """Settings that suit feet which stand so, in the owner's space."""
    middle = sum(rests, Vector()) / len(rests)
    size = sum((rest - middle).length for rest in rests) / len(rests) or 1.0
    return {name: share * size for name, share in SHARES.items()}


def take_rests(context, owner):
    """Let the feet belong where their own transforms have them now; returns how many there are."""
    entries_of = owner.motus.walker.legs
    feet = legs.feet(owner)
    found = [Leg(entries_of[foot.index].name, pointed(entries_of[foot.index], "foot"), Vector(), 0.0) for foot in feet]
    for foot, rest in zip(feet, _own_rests(context, owner, found)):
        owner.motus.walker.legs[foot.index].rest = rest
    return len(feet)


def remove(owner):
    """Take the walker back: wiring, keys of its settings, and the settings themselves."""
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    forget(system(), owner)
    _forget_others()
