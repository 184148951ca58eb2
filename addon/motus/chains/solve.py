"""Solve the chains of a group: read their animation and surroundings over the scene, and turn bones to where the motion has them."""

import math
from typing import Any, NamedTuple

from ..core import keeping, rigs, tracks, wiring
from ..core.animation import strips
from ..core.declare import Geometries, Problem, registered
from ..core.evaluated import copies, shares
from ..core.evaluated.question import answered
from ..core.file import stored
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entries
from ..core.tracks import own_track, solved
from ..core.tracks.inputs import (
    BAD_NUMBERS,
    BONES_CHANGED,
    LOOPED_BONES,
    MISSING_BONES,
    NEEDS_RECORDING,
    NOT_KNOWN,
    Tails,
    of_unknown,
    stamp_of_carrier,
    stamp_of_known,
)
from . import colliders, motion
from .groups import BELOW, LOOPED, MISSING, PLAN
from .properties import KEYWORDS

LOOP_IS_OPEN = Problem("A chain does not come back to where its loop began", blocking=False)
CONSTRAINED = Problem("Constraints on bones of a chain are no part of what it follows, and may undo it", blocking=False)
BELOW_ANOTHER = Problem("Some chains begin within another chain, which moves them: remove them from the list", blocking=False)
COLLIDER_NOT_KNOWN = Problem("The motion of a collider is not known on other frames: chains pass through it", blocking=False)
GRAVITY_NOT_KNOWN = Problem("The scene's gravity is not known on other frames: chains move without it", blocking=False)
TOO_LONG = Problem("The scene is too long for so many chains, which come to a stop before its end: split it, or mute some", blocking=False)
PROBLEMS = (
    NEEDS_RECORDING,
    NOT_KNOWN,
    BAD_NUMBERS,
    LOOP_IS_OPEN,
    CONSTRAINED,
    BELOW_ANOTHER,
    COLLIDER_NOT_KNOWN,
    GRAVITY_NOT_KNOWN,
    TOO_LONG,
    LOOPED_BONES,
    MISSING_BONES,
    BONES_CHANGED,
)

INPUTS = (Geometries("obstacles", of=colliders.objects),)
CUT = "cut"
"""Beginning of the names of the markers at which chains start anew."""

_FORM = {"fingerprint": int, "chains": [[str]]}
"""Structure of the JSON text that groups.py stores in a group's data under PLAN."""

_MADE = keeping.OfEvaluation(
    "motions of the chains of a group (Made)",
    "key of the group; looked up again if the stamp of the group's inputs differs",
    "one for each group",
)


class Made(NamedTuple):
    """Motions of a group's chains, valid while their inputs do not change.

    stamp: hashable value that changes with the inputs, including the world tracks of `carriers` and the own tracks of `laid`, names as in
    core/tracks/inputs.py. chains: [(motion.Motion, index of the chain's entry, number of bones)]. members: (bone name, row of the member) of
    the bones of these chains. problem: the Problem to report, or None. weights: of all entries; None if they are animated.
    share: of the limit of work, that the owner had (core/evaluated/shares.py). edits: shares.edits() when that was looked up.
    """

    stamp: Any
    carriers: tuple
    laid: tuple
    chains: list
    members: tuple
    problem: Any
    weights: Any
    share: float
    edits: int


def solve(context, obstacles):
    """Turn the group's bones to where the motion has them at the context's frame. Returns a Problem or None.

    obstacles: what the wiring waits by for the colliders.
    """
    try:
        made = _made(context)
    except KeyError:  # bones or entries that do not exist any more
        return BONES_CHANGED
    weights = made.weights if made.weights is not None else entries.weights(context.settings)
    places, influences = np.zeros((len(made.members), 3)), np.zeros(len(made.members))
    row = 0
    for moved, entry, count in made.chains:
        rows = slice(row, row + count)
        row += count
        weight = context.settings.influence * weights[entry]
        if weight > 0.0:
            influences[rows] = weight
            places[rows] = moved.places(context.frame / context.fps)[1:]
    if influences.any():
        rigs.turn(context, context.data[PLAN], made.members, places, influences)
    return made.problem or _wrong(context.data)


def _wrong(data):
    """Return the Problem with the list of chains of a group's data; None if there is none."""
    return next(
        (problem for key, problem in ((LOOPED, LOOPED_BONES), (MISSING, MISSING_BONES), (BELOW, BELOW_ANOTHER)) if data.get(key)), None
    )


def _made(context):
    """Return the Made of the context's group from the cache; make it anew if its inputs have changed."""
    owner, copy, depsgraph = context.owner, context.copy, context.depsgraph
    kept = _MADE.on(copy)
    found = kept.get(context.group)
    edits = shares.edits()
    share = found.share if found and found.edits == edits else shares.share_of(registered["chains"], owner, depsgraph)
    if found is None or found.stamp is None or found.share != share or found.stamp != _stamp(context, found.carriers, found.laid):
        # One question, so that what many bones depend on, such as the motion of their rig, is found once.
        found = kept[context.group] = answered(object(), lambda: _make(context, share))
    elif found.edits != edits:
        found = kept[context.group] = found._replace(edits=edits)
    return found


def _stamp(context, carriers, laid):
    """Hashable value that changes whenever the inputs of an owner's chains may change; None if changes cannot be detected."""
    owner, scene = context.owner, context.depsgraph.scene
    if context.copy is None:
        return None
    found = [context.copy.number, strips.stamp_of(owner.animation_data), copies.stamp_of_data(owner), _time(scene)]
    found += [stamp_of_carrier(owner, name, scene, registered["chains"]) for name in carriers]
    found += [stamp_of_known(own_track(owner.pose.bones[name])) for name in laid]
    found += [(colliders.form(obj), stamp_of_known(track)) for obj, track in _colliders(context)]
    evaluated = context.depsgraph.scene_eval
    found += [evaluated.use_gravity, *(stamp_of_known(track) for track in _gravity(evaluated)), tuple(_cuts(context))]
    return strips.together(found)


def _time(scene):
    return *scene_time.stamp(scene), scene_time.last(scene)


def _gravity(scene):
    """List the tracks of an evaluated scene's gravity: along X, Y and Z."""
    return [tracks.property_track(scene, "gravity", axis) for axis in range(3)]


def _cuts(context):
    """List the frames of the markers at which the chains start anew, rising, in the keys' time."""
    settings, depsgraph = context.settings, context.depsgraph
    if not settings.use_cuts or settings.use_loop:
        return []
    # Blender copies markers to the evaluated scene too late for a viewport, but a render must not read what is edited meanwhile.
    scene = depsgraph.scene_eval if depsgraph.mode == 'RENDER' else depsgraph.scene
    found = [marker.frame for marker in scene.timeline_markers if marker.name.lower().startswith(CUT)]
    return [scene_time.keys_time(scene, frame) for frame in sorted(found)]


def _colliders(context):
    """List (empty, track of its world matrix) of the evaluated colliders."""
    found = wiring.waited_for(context.settings)
    return colliders.over_time([obj for obj in found.values() if obj.type == 'EMPTY'], context.depsgraph.scene)


class _Making:
    """Makes the motions of a group's chains, and lists their problems."""

    def __init__(self, context, share):
        self._context, self._settings, self._scene = context, context.settings, context.depsgraph.scene
        self._share = share
        self.chains, self.members, self.problems, self.carriers, self.laid = [], [], [], [], []

    def make(self, plan):
        """Make the motions of the chains of a plan: lists of the names of their bones."""
        ready, row = [], 0
        for names in plan:
            index = self._settings.entries.find(names[0])
            if index < 0:
                raise KeyError(names[0])
            bones = [self._context.owner.pose.bones[name] for name in names]
            source = Tails(bones, self._scene, registered["chains"])
            self.carriers += source.carriers
            self.laid += source.laid
            if self._is_ready(source, bones, self._settings.entries[index]):
                ready.append((source, bones, index, range(row, row + len(bones))))
            row += len(bones)
        if row != len(self._context.locations):
            raise stored.Damaged("another number of members")
        if ready:
            self._solve(ready)

    def _is_ready(self, source, bones, entry):
        if any(one.influence > 0.0 for bone in bones for one in solved.acting_on(bone, registered["chains"])):
            self.problems.append(CONSTRAINED)
        if not source.is_known and not entry.is_muted:
            self.problems.append(of_unknown(source))
        if not all(math.isfinite(getattr(entry, name)) for name in (*KEYWORDS, "weight")):
            self.problems.append(BAD_NUMBERS)
            return False
        return source.is_known

    def _solve(self, ready):
        settings, scene = self._settings, self._scene
        price, links = sum(source.price for source, *_ in ready), sum(len(bones) for _, bones, *_ in ready)
        share = self._share * len(ready) / max(len(settings.entries), len(ready))
        times = motion.times_of(scene, _cuts(self._context), motion.most_seconds(price, links, settings.use_loop, share))
        if times.is_cut_short:
            self.problems.append(TOO_LONG)
        world = self._world(times)
        for source, bones, index, rows in ready:
            poses = source.kept(("places", times.frames.tobytes()), lambda source=source: source.places(times.frames))
            try:
                moved = self._motion(bones, np.stack(poses, axis=1), settings.entries[index], world, times)
            except ValueError:
                self.problems.append(BAD_NUMBERS)
                continue
            self.chains.append((moved, index, len(bones)))
            self.members += zip([bone.name for bone in bones], rows)

    def _motion(self, bones, poses, entry, world, times):
        places = {bone.name: place for place, bone in enumerate(bones, 1)}
        parents = [-1, 0, *(places[bone.parent.name] for bone in bones[1:])]
        is_loop, size = self._settings.use_loop, sum(bone.bone.length for bone in bones)
        if is_loop and np.abs(poses[-1] - poses[0]).max() > motion.CLOSED * size:
            self.problems.append(LOOP_IS_OPEN)
            is_loop = False
        if is_loop:
            poses[-1] = poses[0]
        found = motion.motion_of(parents, poses, entry, world, times, is_loop)
        if is_loop and found.gap > motion.CLOSED * size:
            self.problems.append(LOOP_IS_OPEN)
        return found

    def _world(self, times):
        """Return the keywords of the native StrandMotion that all chains share: the air, gravity, what they touch, how they begin."""
        settings, scene = self._settings, self._context.depsgraph.scene_eval
        found = {"settle": settings.settle, "air": motion.wind_at(times.seconds, settings.wind, settings.gusts, settings.use_loop)}
        if scene.use_gravity:
            moving = _gravity(scene)
            if all(track.is_known for track in moving):
                found["gravity"] = np.stack([track.values(times.frames) for track in moving], axis=1)
            else:
                self.problems.append(GRAVITY_NOT_KNOWN)
        touched = _colliders(self._context)
        known = [(obj, track) for obj, track in touched if track.is_known]
        if len(known) < len(touched):
            self.problems.append(COLLIDER_NOT_KNOWN)
        obstacles = colliders.at(known, times.frames)
        if obstacles:
            found |= {"obstacles": obstacles.shapes, "obstacle_places": obstacles.places, "radii": obstacles.radii}
        return found


def _make(context, share):
    plan = stored.parse(context.data.get(PLAN), _FORM)
    making = _Making(context, share)
    making.make(plan["chains"])
    carriers, laid = tuple(dict.fromkeys(making.carriers)), tuple(dict.fromkeys(making.laid))
    is_still = context.copy is not None and not context.copy.has_animated_settings
    return Made(
        _stamp(context, carriers, laid),
        carriers,
        laid,
        making.chains,
        tuple(making.members),
        next(iter(making.problems), None),
        entries.weights(context.settings) if is_still else None,
        share,
        shares.edits(),
    )
