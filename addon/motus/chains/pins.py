"""Pins of chains: tails of bones that are held to an object, or to a bone of an object, by a weight over time."""

from typing import Any, NamedTuple

from ..core import tracks, wiring
from ..core.declare import Problem
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.settings import entry_keys
from ..core.translations import tr
from . import properties

MADE_KEY = "motus_chains_pin"
"""Custom property that marks the empties that Motus has made for pins."""
PATH = "motus.chains.pins"
WITHOUT_TARGET = Problem("A pin without a target holds nothing: name one in the part Pins, or remove the pin", blocking=False)
WITHOUT_TARGET_BONE = Problem(
    "The bone that a pin holds to is gone: choose another one in the part Pins, or remove the pin", blocking=False
)
WITHOUT_CHAIN = Problem(
    "A pin of a bone that belongs to no chain holds nothing: choose another bone in the part Pins, or remove the pin", blocking=False
)


class Held(NamedTuple):
    """A pin over time. bone: name of the bone whose tail is held. goal: (object, bone or ""). place, weight: Tracks of world matrix and number."""

    bone: str
    goal: tuple
    place: Any
    weight: Any

    @property
    def is_known(self):
        """Whether place and weight can be read at any time."""
        return self.place.is_known and self.weight.is_known


def goal(pin):
    """Return (object, name of its bone or "") that a pin holds to; None if there is no such object or bone, or the object was deleted."""
    target = pointed(pin, "target")
    if target is None or deleted.is_deleted(target) or _has_lost_bone(pin, target):
        return None
    return target, pin.target_bone if target.pose else ""


def _has_lost_bone(pin, target):
    return bool(target.pose and pin.target_bone) and pin.target_bone not in target.pose.bones


def problem(settings):
    """Return the Problem of the first pin that holds nothing, for all that its weight says; None if there is none. settings: of the rig."""
    return next(filter(None, (_problem_of(settings, pin) for pin in settings.pins if not pin.is_muted)), None)


def _problem_of(settings, pin):
    rig = settings.id_data
    if rig.pose is None or pin.name not in rig.pose.bones or properties.index_of(settings, pin.name) < 0:
        return WITHOUT_CHAIN
    if goal(pin) is not None:
        return None
    target = pointed(pin, "target")
    return WITHOUT_TARGET_BONE if target is not None and _has_lost_bone(pin, target) else WITHOUT_TARGET


def check_holds(rig, name, chain, target, bone):
    """Raise Refused if a target moves along with the chain of the bone that it shall hold.

    name: of the bone. chain: names of the bones of its chain, which may still have to be made. bone: of the target, or "".
    """
    if wiring.depends(target, bone, rig, chain):
        label = f"{target.name}: {bone}" if bone else target.name
        raise Refused(tr("{target} moves with the chain of {bone}: choose another one").format(target=label, bone=name))


def acting(settings, bones):
    """Return {name of a bone: (index of its pin, goal)} for the bones of these names that are pinned, by the first pin of each that acts.

    settings: of the rig.
    """
    found = {}
    for index, pin in enumerate(settings.pins):
        where = goal(pin) if pin.name in bones and pin.name not in found and not pin.is_muted else None
        if where:
            found[pin.name] = index, where
    return found


def goals(settings, bones):
    """List of the (object, bone or "") that bones of these names are pinned to, by pins that are muted too."""
    return [where for where in (goal(pin) for pin in settings.pins if pin.name in bones) if where]


def over_time(rig, bones, scene):
    """List a Held for each of a rig's bones of these names that is pinned. rig: evaluated or original."""
    settings = rig.motus.chains
    return [_held(rig, scene, name, *found) for name, found in acting(settings, bones).items()]


def _held(rig, scene, name, index, where):
    target, bone = where
    path = entry_keys.animated_prefix(rig, PATH, rig.motus.chains.pins, index)
    thing = target.pose.bones[bone] if bone else target
    return Held(name, where, tracks.world_track(thing, scene), tracks.property_track(rig, f"{path}weight"))


def at(held, rows, frames, ends, poses):
    """Return the keywords of the native StrandMotion for pins at frames (n,).

    held: list of Held, which are known. rows: {name of a bone: index of the particle at its tail}. ends: indices of particles that are held
    where the animation has them; a pin of such a one is left out. poses: (n, particles, 3), where it has all of them.
    """
    acting = [one for one in held if rows[one.bone] not in ends]
    if not acting and not ends:
        return {}
    places = [one.place.values(frames)[:, :3, 3] for one in acting] + [poses[:, end] for end in ends]
    weights = [one.weight.values(frames) for one in acting] + [np.ones(len(frames)) for _ in ends]
    return {
        "pinned": [*(rows[one.bone] for one in acting), *ends],
        "pin_places": np.stack(places, axis=1),
        "pin_weights": np.stack(weights, axis=1),
    }
