"""Set up, change and remove walkers: functions that the operators call."""

from typing import Any, NamedTuple

import bpy
from mathutils import Vector

from ..core import wiring
from ..core.blender import actions
from ..core.declare import has_settings, of_owner, registered
from ..core.declare.forgetting import forget, says_anything
from ..core.file.pointers import pointed
from ..core.settings import entries, lists
from . import legs

PREFIX = "motus.walker."
SHARES = {"stride": 0.5, "clearance": 0.16, "reach_up": 0.8, "reach_down": 1.2}
"""Default of each length setting of a new walker, as a multiple of the average distance of the feet from their middle."""


class Leg(NamedTuple):
    """A leg of a walker that is about to be set up.

    bone: name of the owner's bone that is the foot; "" if the foot is an object. foot: the Object that is the foot; None for a bone.
    hip: place, in the owner's space, at which the leg begins. length: length of the whole leg, 0 if it is unknown.
    """

    bone: str
    foot: Any
    hip: Vector
    length: float

    def matrix(self, owner):
        """World matrix of the foot. owner: object that walks; owner and foot are both original or both evaluated."""
        return owner.matrix_world @ owner.pose.bones[self.bone].matrix if self.bone else self.foot.matrix_world


def system():
    """Return the System of walkers from the registry: the package's __init__ imports this module, which cannot import it in turn."""
    return registered["walker"]


def attach(context, owner, found, body, changes):
    """Set up an object to walk on legs, or change the legs of an object that walks already.

    The present places of the feet become their rest positions. A new walker gets lengths that suit its legs, if `changes` does not set
    them. Feet that a walker has already keep their phases, and their steps that were changed by hand.
    found: the legs, as Leg. body: name of the bone, or the Object, that rises and leans; None if there is none.
    changes: {name: value} of settings. Raises Refused if an override would lose a leg that it has from its library.
    """
    was_active = owner.motus.walker.is_active
    feet = [_foot(leg) for leg in owner.motus.walker.legs]
    phases = {foot: leg.phase for foot, leg in zip(feet, owner.motus.walker.legs)}
    found = lists.library_first(owner.motus.walker.legs, found, _is_same_leg)
    lists.check_replaceable(owner.motus.walker.legs, found, _is_same_leg)
    rests = _own_rests(context, owner, found)
    with entries.unwired(owner.motus.walker) as settings:
        rows = [
            {"name": leg.bone or leg.foot.name, "foot": leg.foot, "hip": leg.hip, "length": leg.length, "phase": phases.get(leg[:2], 0.0)}
            for leg in found
        ]
        lists.replace(settings.legs, rows)
        for entry, rest in zip(settings.legs, rests):
            _set_rest(entry, rest)
        _move_steps(settings.steps, feet, [leg[:2] for leg in found])
        if owner.pose:
            settings.body_bone = body or ""
        else:
            settings.body = body
    change(owner, changes if was_active else lengths([rest.translation for rest in rests]) | changes)
    _forget_others()


def _move_steps(steps, before, after):
    """Let the changed steps of a walker follow their feet, whose legs are about to have other places in the list. before, after: feet."""
    for index in reversed(range(len(steps))):
        foot = before[steps[index].leg] if steps[index].leg < len(before) else None
        if foot in after:
            steps[index].leg = after.index(foot)
        elif index >= lists.count_from_library(steps):
            lists.remove(steps, index)


def _foot(leg):
    """(name of the bone, Object) that is the foot of a leg in the settings, as the first two fields of Leg are."""
    return legs.bone(leg), pointed(leg, "foot")


def _is_same_leg(entry, leg):
    return _foot(entry) == leg[:2]


def _forget_others():
    """Remove the walker settings from objects that were feet or bodies and are no longer driven by a walker."""
    for obj in bpy.data.objects:
        if has_settings(system(), obj) and not (obj.library or says_anything(of_owner(system(), obj))):
            forget(system(), obj)


def change(owner, changes):
    """Set several walker settings of an object, then update its drivers and constraints once. changes: {name: value}."""
    with entries.unwired(owner.motus.walker) as settings:
        for name, value in changes.items():
            setattr(settings, name, value)
    wire(owner)


def wire(owner):
    """Make or update the drivers and constraints of a walker as its settings require."""
    if owner.motus.walker.is_active:
        wiring.refresh(system(), owner)
    else:
        wiring.attach(system(), owner)


def _set_rest(entry, rest):
    """Let a foot belong where a matrix, in the owner's space, has it. entry: settings of the leg."""
    entry.rest, entry.turn = rest.translation, rest.to_quaternion()


def _own_rests(context, owner, found):
    """List the matrices of feet by their own transforms, without the walk, in the owner's space.

    found: the legs, as Leg. The walker's constraints are muted during the measurement.
    """
    is_active = owner.motus.walker.is_active
    if is_active:
        wiring.set_muted(system(), owner, True)
    try:
        context.view_layer.update()
        depsgraph = context.view_layer.depsgraph
        evaluated = owner.evaluated_get(depsgraph)
        inverse = evaluated.matrix_world.inverted_safe()
        return [inverse @ leg._replace(foot=leg.foot and leg.foot.evaluated_get(depsgraph)).matrix(evaluated) for leg in found]
    finally:
        if is_active:
            wiring.set_muted(system(), owner, False)


def lengths(rests):
    """Return {name: value} of the length settings that suit feet with these rest positions. rests: Vectors in the owner's space."""
    middle = sum(rests, Vector()) / len(rests)
    size = sum((rest - middle).length for rest in rests) / len(rests) or 1.0
    return {name: share * size for name, share in SHARES.items()}


def take_rests(context, owner):
    """Set the rest positions of a walker's feet to their present places by their own transforms; returns the number of feet."""
    entries_of = owner.motus.walker.legs
    feet = legs.feet(owner)
    named = [_foot(entries_of[foot.index]) for foot in feet]
    found = [Leg(bone, foot, Vector(), 0.0) for bone, foot in named]
    for foot, rest in zip(feet, _own_rests(context, owner, found)):
        _set_rest(owner.motus.walker.legs[foot.index], rest)
    return len(feet)


def remove(owner):
    """Remove a walker: its drivers and constraints, the F-curves of its settings, and the settings themselves."""
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    forget(system(), owner)
    _forget_others()
