"""Solve the chains of a group: bring bones and objects to where their motion has them."""

import functools
from typing import Any, NamedTuple

from ..core import keeping, wiring
from ..core.animation import strips
from ..core.declare import Geometries, Problem, registered
from ..core.evaluated import copies, shares
from ..core.evaluated.question import answered
from ..core.file import deleted, stored
from ..core.settings import entries
from ..core.tracks import inputs
from . import air, colliders, curves, making, pins, steps
from .groups import LOOPED, MISSING, PARTED, PLAN
from .making import (
    CHAINS_PARTED,
    COLLIDER_NOT_KNOWN,
    CONSTRAINED,
    DEFORMED_COLLIDER,
    GRAVITY_NOT_KNOWN,
    KEEPS_LENGTHS,
    LARGE_COLLIDER,
    LOOP_IS_OPEN,
    LOOPED_CHAINS,
    NO_SNOW,
    PIN_NOT_KNOWN,
    PIN_WEIGHT_NOT_KNOWN,
    THINGS_CHANGED,
    THINGS_MISSING,
    TOO_LONG,
    WIND_NOT_KNOWN,
)
from .properties import is_bone

ROOT_DELETED = Problem("What the chains hang on is in no collection any more: they stay where their own animation has them")

PROBLEMS = (
    inputs.NEEDS_RECORDING,
    inputs.NOT_KNOWN,
    inputs.BAD_NUMBERS,
    LOOP_IS_OPEN,
    CONSTRAINED,
    COLLIDER_NOT_KNOWN,
    DEFORMED_COLLIDER,
    LARGE_COLLIDER,
    GRAVITY_NOT_KNOWN,
    WIND_NOT_KNOWN,
    NO_SNOW,
    PIN_NOT_KNOWN,
    PIN_WEIGHT_NOT_KNOWN,
    TOO_LONG,
    CHAINS_PARTED,
    LOOPED_CHAINS,
    THINGS_MISSING,
    THINGS_CHANGED,
    ROOT_DELETED,
    KEEPS_LENGTHS,
    pins.WITHOUT_TARGET,
    pins.WITHOUT_TARGET_BONE,
    pins.WITHOUT_CHAIN,
)

INPUTS = (Geometries("obstacles", of=colliders.objects), air.SnowWind("snowy", of="wind_from"))

_FORM = {"fingerprint": int, "chains": [(str, [str])]}
"""Structure of the JSON text that groups.py stores in a group's data under PLAN."""

_MADE = keeping.OfEvaluation(
    "motions of the chains of a group (Made)",
    "key of the group; looked up again if the stamp of the group's inputs differs",
    "one for each group",
)


class Made(NamedTuple):
    """Motions of a group's chains, valid while their inputs do not change.

    stamp: hashable value that changes with the inputs, including all of `read`, which Making.read describes. parts: [making.Part].
    problem: the Problem to report, or None. weights: of all entries; None if they are animated.
    share: of the limit of work, that the owner had (core/evaluated/shares.py). edits: shares.edits() when that was looked up.
    """

    stamp: Any
    read: tuple
    parts: list
    problem: Any
    weights: Any
    share: float
    edits: int


def solve(context, obstacles, snowy):
    """Bring the group's bones and objects to where the motion has them at the context's frame. Returns a Problem or None.

    obstacles, snowy: what the wiring waits by for the colliders, and for the emitter whose wind is felt.
    """
    if deleted.is_deleted(context.owner):
        return ROOT_DELETED
    try:
        made = _made(context)
    except KeyError:  # bones, objects, entries or points that are not there any more, or not where they were
        return THINGS_CHANGED
    weights = made.weights if made.weights is not None else entries.weights(context.settings)
    acting, found = {}, {}
    for part in made.parts:
        weight = context.settings.influence * weights[part.entry]
        if weight <= 0.0:
            continue
        if part.moved not in found:  # chains that touch each other have one motion
            found[part.moved] = steps.places(context, part.entry, part.moved, context.frame / context.fps)
        if found[part.moved] is not None:
            acting.setdefault(type(part.kept), []).append((part, found[part.moved][part.particles], weight))
    for kind, parts in acting.items():
        answered(object(), functools.partial(kind.fill, context, context.data[PLAN], parts))
    is_open = any(part.moved.is_open for part in made.parts)
    return made.problem or (LOOP_IS_OPEN if is_open else None) or _wrong(context.data) or pins.problem(context.settings)


def _wrong(data):
    """Return the Problem with the list of chains of a group's data; None if there is none."""
    told = ((LOOPED, LOOPED_CHAINS), (MISSING, THINGS_MISSING), (PARTED, CHAINS_PARTED))
    return next((problem for key, problem in told if data.get(key)), None)


def _made(context):
    """Return the Made of the context's group from the cache; make it anew if its inputs have changed."""
    owner, copy, depsgraph = context.owner, context.copy, context.depsgraph
    kept = _MADE.on(copy)
    found = kept.get(context.group)
    edits = shares.edits()
    share = found.share if found and found.edits == edits else shares.share_of(registered["chains"], owner, depsgraph)
    if found is None or found.stamp is None or found.share != share or found.stamp != _stamp(context, found.read):
        # One question, so that what many bones depend on, such as the motion of their rig, is found once.
        found = kept[context.group] = answered(object(), lambda: _make(context, share))
    elif found.edits != edits:
        found = kept[context.group] = found._replace(edits=edits)
    return found


def _stamp(context, read):
    """Hashable value that changes whenever the inputs of an owner's chains may change; None if changes cannot be detected."""
    owner, scene = context.owner, context.depsgraph.scene
    if context.copy is None:
        return None
    found = [context.copy.number, strips.stamp_of(owner.animation_data), _surroundings(context).stamp]
    if owner.type == 'ARMATURE':
        found.append(copies.stamp_of_data(owner))
    return strips.together((*found, *(one.stamp(owner, scene) for one in read)))


def _surroundings(context):
    """Return the making.Surroundings of the context's chains."""
    depsgraph, waited = context.depsgraph, wiring.waited_for(context.settings)
    # Blender copies markers to the evaluated scene too late for a viewport, but a render must not read what is edited meanwhile.
    marked = depsgraph.scene_eval if depsgraph.mode == 'RENDER' else depsgraph.scene
    return making.Surroundings(
        context.owner,
        depsgraph.scene,
        depsgraph.scene_eval,
        making.cuts(context.settings, marked),
        tuple(colliders.touching(waited.values())),
        _pinnable(context) if context.settings.pins else (),
    )


def _pinnable(context):
    """Return the names of the bones that hang in the context's group, as a set."""
    plan, known = stored.parse(context.data.get(PLAN), _FORM)["chains"], context.settings.entries
    return {one for name, names in plan if name in known and is_bone(known[name]) for one in names}


def _make(context, share):
    plan = stored.parse(context.data.get(PLAN), _FORM)
    if curves.are_moved(context.owner):
        raise KeyError(context.owner.name)
    found = making.Making(context.owner, context.settings, _surroundings(context), share)
    found.make(plan["chains"])
    if found.count != len(context.locations):
        raise stored.Damaged("another number of members")
    read = tuple(dict.fromkeys(found.read))
    is_still = context.copy is not None and not context.copy.has_animated_settings
    return Made(
        _stamp(context, read),
        read,
        found.parts,
        next(iter(found.problems), None),
        entries.weights(context.settings) if is_still else None,
        share,
        shares.edits(),
    )
