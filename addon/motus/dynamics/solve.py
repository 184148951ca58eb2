"""Dynamics: what a group's solver reads of Blender, and the calls of the native module."""

import functools
import math
from typing import Any, NamedTuple

from mathutils import Matrix, Vector

from ..core import copies, native, rigs, stored, wiring
from ..core.lazy import numpy as np
from ..core.system import Problem, registered
from ..core.tracks import strips, transforms, world_track
from . import inputs, motion
from .groups import LOOPED, PLAN, Unit

NEEDS_RECORDING = Problem("Some of what is followed is not known ahead: record it", blocking=False)
LOOP_IS_OPEN = Problem("A rotation does not come back to where its loop began", blocking=False)
BAD_NUMBERS = Problem("Some numbers are none that a motion can be made of", blocking=False)
JUMPS_LOOPED = Problem("Where the motion loops, jumps of what it follows are swung through", blocking=False)
CONSTRAINED = Problem(
    "Constraints of its own are not followed, and may undo it: let an empty have them, and a child of that the dynamics", blocking=False)
LOOPED_BONES = Problem("Some bones move with what they follow, and are left out", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")
PROBLEMS = (NEEDS_RECORDING, LOOP_IS_OPEN, BAD_NUMBERS, JUMPS_LOOPED, CONSTRAINED, LOOPED_BONES, BONES_CHANGED)

_FORM = {"fingerprint": int, "units": [(str, [str])]}
"""Of what groups.py notes."""


class Made(NamedTuple):
    """What was made of inputs, for frames up to `reach`. stamp: of them.

    parts: motion.Part of members. tails: [motion.Tails], each with its bones' native plan. weights: of all entries where
    nothing animates them.
    """

    stamp: Any
    reach: float
    parts: list
    tails: list
    plan: Any
    problem: Any
    weights: Any


class Plan:
    """Which bones of a rig follow by their tails, between two changes of the rig. members: rows of the group's."""

    def __init__(self, rig, rows, members):
        self.still = rigs.still(rig, tuple(rows))
        self.solver = native.module.TailPlan(rigs.parents(rig, list(rows)), [rows[name] for name, _ in members])
        self.members = np.array([member for _, member in members], int)


def solve(context):
    """What of the group's members moves beyond their animation at the context's frame. Never raises for a user's error."""
    try:
        made = _made(context)
    except KeyError:  # bones or entries that are gone
        return BONES_CHANGED
    weights = made.weights
    if weights is None:
        weights = _weights(context.settings)
    seconds = context.frame / context.fps
    to_local = functools.partial(_to_local, context.owner)
    for part in made.parts:
        if weights[part.place] > 0.0:
            part.write(seconds, weights[part.place], context, to_local)
    if made.tails:
        _turn(context, made, seconds, weights)
    if made.problem is None and context.data.get(LOOPED):
        return LOOPED_BONES
    return made.problem


def _turn(context, made, seconds, weights):
    """Let tails point to where they have come."""
    rig = context.owner
    text, members = context.data[PLAN], made.plan
    plan = rigs.plan(rig, f"{text} {members}", lambda rig, rows: Plan(rig, rows, members))
    arrays = rigs.read(rig, plan.still)
    places, shares = np.zeros((len(members), 3)), np.zeros(len(members))
    for tails in made.tails:
        places[tails.rows] = tails.track.evaluate(seconds - tails.delay).reshape(-1, 3)
        shares[tails.rows] = [weights[place] for place in tails.places]
    context.rotations[plan.members] = plan.solver.solve(
        arrays.rest, arrays.poses, arrays.basis, arrays.inheritance, arrays.world, places, shares)


def _made(context):
    """The Made of the context's group, kept for as long as its inputs stay what they are."""
    owner, scene = context.owner, context.depsgraph.scene
    copy = copies.of(owner)
    stamp = _stamp(owner, copy, scene)
    place = "dynamics", context.group
    found = copy.found.get(place) if copy else None
    if found is None or stamp is None or found.stamp != stamp or context.frame > found.reach:
        found = _make(context, copy, stamp, scene)
        if copy:
            copy.found[place] = found
    return found


def _stamp(owner, copy, scene):
    """Changes whenever the inputs of an owner's entries may; None where nobody can tell."""
    if copy is None:
        return None
    render = scene.render
    found = (copy.number, strips.stamp_of(owner.animation_data), render.fps, render.fps_base, scene.frame_start)
    if owner.type == 'ARMATURE':
        found += (copies.number_of(owner.data) or None,)
    if owner.parent is not None:
        found += (world_track(transforms.parent_of(owner), scene).stamp,)
    return strips.together(found)


def _make(context, copy, stamp, scene):
    owner, settings = context.owner, context.settings
    listed = {entry.name: index for index, entry in enumerate(settings.entries)}
    reach = inputs.reach(scene, context.frame)
    parts, tails, members, problems, row = [], [], [], [], 0
    for kind, names in stored.parse(context.data.get(PLAN), _FORM)["units"]:
        places = [listed[name] for name in names]
        entries = [settings.entries[place] for place in places]
        things = [owner.pose.bones[name] if name else owner for name in names]
        rows = range(row, row + len(names))
        row += len(names)
        if any(_are_constrained(thing) for thing in things):
            problems.append(CONSTRAINED)
        try:
            if not all(math.isfinite(number) for entry in entries for number in (entry.delay, entry.jump, entry.weight)):
                raise ValueError
            source = Unit("", kind, entries, things).input(scene)
            if not source.is_known:
                problems += [NEEDS_RECORDING] if not all(entry.is_muted for entry in entries) else []
            elif kind == 'TAILS':
                first = len(members)
                made = motion.tails_of(
                    things, entries, range(first, first + len(names)), places, scene, reach)
                if made:
                    tails += made
                    members += zip(names, rows)
                    problems += [JUMPS_LOOPED] if any(one.swings_through for one in made) else []
            else:
                part = motion.part_of(things[0], entries[0], rows[0], places[0], scene, reach)
                if part:
                    parts.append(part)
                    problems += [JUMPS_LOOPED] if part.swings_through else []
        except motion.OpenLoop:
            problems.append(LOOP_IS_OPEN)
        except ValueError:
            problems.append(BAD_NUMBERS)
    if row != len(context.locations):
        raise stored.Damaged("another number of members")
    is_still = copy is not None and not copy.has_animated_settings(owner)
    return Made(stamp, reach, parts, tails, tuple(members), next(iter(problems), None),
                _weights(settings) if is_still else None)


def _are_constrained(thing):
    """Whether constraints that are not of dynamics act on an evaluated Object or PoseBone."""
    return any(not one.mute and one.influence > 0.0 and not wiring.is_sink(registered["dynamics"], one)
               for one in thing.constraints)


def _weights(settings):
    """Of all entries, with the owner's influence."""
    count, influence = len(settings.entries), settings.influence
    weights, muted = np.empty(count, np.float32), np.empty(count, bool)
    settings.entries.foreach_get("weight", weights)
    settings.entries.foreach_get("is_muted", muted)
    return [0.0 if is_muted or not weight > 0.0 else influence * weight
            for weight, is_muted in zip(weights.tolist(), muted.tolist())]


def _to_local(owner, moves, is_in_world):
    """Moves of an object in the axes that its sink adds them in, from those of the world, or of its own location."""
    parent = owner.parent
    if parent is None or not is_in_world and parent == transforms.parent_of(owner):
        return moves
    if not is_in_world:
        bone = transforms.parent_of(owner)
        offset = Matrix(transforms.parent_offset(owner)[0].tolist())
        moves = (parent.matrix_world @ bone.matrix @ offset).to_3x3() @ Vector(moves)
    # Of what hangs on a bone too.
    return (parent.matrix_world @ owner.matrix_parent_inverse).to_3x3().inverted_safe() @ Vector(moves)
