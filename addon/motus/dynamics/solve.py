"""Solve the dynamics of a group of members: read their animation from Blender and call the native module.

A group is a set of objects, bones or properties of one owner that are solved by one call.
"""

import functools
import math
from typing import Any, NamedTuple

from mathutils import Matrix, Vector

from ..core import keeping, rigs
from ..core.animation import strips
from ..core.declare import Problem, registered
from ..core.evaluated import copies, shares
from ..core.evaluated.question import answered
from ..core.file import stored
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.settings import entries
from ..core.tracks import in_world, own_track, solved
from ..core.tracks.inputs import (
    BAD_NUMBERS,
    BONES_CHANGED,
    LOOPED_BONES,
    MISSING_BONES,
    NEEDS_RECORDING,
    NOT_KNOWN,
    of_unknown,
    stamp_of_carrier,
    stamp_of_known,
)
from . import inputs, motion, sampling
from .groups import LOOPED, MISSING, PLAN, PROPERTIES, Unit

LOOP_IS_OPEN = Problem("A rotation does not come back to where its loop began", blocking=False)
JUMPS_LOOPED = Problem("Where the motion loops, jumps of what it follows are swung through", blocking=False)
CONSTRAINED = Problem(
    "Constraints of its own are not followed, and may undo it: let an empty have them, and a child of that the dynamics", blocking=False
)
EMPTY_LOOP = Problem("A loop ends before it begins, and is none: set its end behind its start", blocking=False)
TOO_LONG = Problem(
    "What is followed goes on for too long, and only its beginning counts: raise Damping or Frequency, shorten Delay, or have fewer dynamics",
    blocking=False,
)
PROBLEMS = (
    NEEDS_RECORDING,
    LOOP_IS_OPEN,
    BAD_NUMBERS,
    JUMPS_LOOPED,
    CONSTRAINED,
    LOOPED_BONES,
    BONES_CHANGED,
    EMPTY_LOOP,
    MISSING_BONES,
    NOT_KNOWN,
    TOO_LONG,
)

_FORM = {"fingerprint": int, "units": [(str, [str])], "properties?": [(str, lambda index: type(index) is int, int)]}
"""Structure of the JSON text that groups.py stores in a group's data under PLAN."""

_MADE = keeping.OfEvaluation(
    "filtered motions of the entries of a group (Made)",
    "key of the group; recomputed if the stamp of the group's inputs differs",
    "one for each group",
)


class Made(NamedTuple):
    """Filtered motions of a group, valid for the frames of a sampling.Reach (`reach`) while their inputs do not change.

    stamp: hashable value that changes with the inputs, including those that `asked` (an Asked) names.
    parts: [motion.Part]. tails: [motion.Tails]. values: [motion.Values].
    plan: ((bone name, row of the member), ...) of the bones in `tails`. problem: the Problem to report, or None.
    weights: of all entries; None if they are animated. share: of the limit of work, that the owner had (core/evaluated/shares.py). edits:
    shares.edits() when that was looked up.
    """

    stamp: Any
    asked: Any
    reach: Any
    parts: list
    tails: list
    values: list
    plan: Any
    problem: Any
    weights: Any
    share: float
    edits: int


def solve(context):
    """Fill the context's arrays with the changes by which dynamics move the group's members at the context's frame.

    Returns a Problem or None. A user's error never raises an exception.
    """
    try:
        made = _made(context)
    except KeyError:  # bones or entries that do not exist any more
        return BONES_CHANGED
    own_weights = made.weights
    if own_weights is None:
        own_weights = entries.weights(context.settings)
    influence = context.settings.influence
    weights = own_weights if influence == 1.0 else [influence * weight for weight in own_weights]
    seconds = context.frame / context.fps
    to_local = functools.partial(_to_local, context.owner)
    for part in made.parts:
        if weights[part.place] > 0.0:
            part.write(seconds, weights[part.place], context, to_local)
    if made.tails:
        _turn(context, made, seconds, weights)
    for value in made.values:
        if own_weights[value.place] > 0.0:  # the influence is applied to outputs after solve()
            value.write(seconds, own_weights[value.place], context.outputs)
    if made.problem is None and context.data.get(LOOPED):
        return LOOPED_BONES
    if made.problem is None and context.data.get(MISSING):
        return MISSING_BONES
    return made.problem


def _turn(context, made, seconds, weights):
    """Fill context.rotations so that bones point their tails to the filtered positions. weights: of all entries."""
    places, influences = np.zeros((len(made.plan), 3)), np.zeros(len(made.plan))
    for tails in made.tails:
        places[tails.rows] = tails.track.evaluate(seconds - tails.delay).reshape(-1, 3)
        influences[tails.rows] = [weights[place] for place in tails.places]
    rigs.turn(context, context.data[PLAN], made.plan, places, influences)


def _made(context):
    """Return the Made of the context's group from the cache; make it anew if its inputs have changed or the frame is out of reach."""
    owner, copy, scene = context.owner, context.copy, context.depsgraph.scene
    kept = _MADE.on(copy)
    found = kept.get(context.group)
    edits = shares.edits()
    share = found.share if found and found.edits == edits else shares.share_of(registered["dynamics"], owner, context.depsgraph)
    if (
        found is None
        or found.stamp is None
        or found.share != share
        or not found.reach.low <= context.frame < found.reach.high
        or found.stamp != _stamp(owner, copy, scene, found.asked)
    ):
        found = kept[context.group] = _make(context, copy, scene, share)
    elif found.edits != edits:
        found = kept[context.group] = found._replace(edits=edits)
    return found


class Asked(NamedTuple):
    """What to check for changes in addition to the owner, because the group's inputs read it.

    carriers: names as in the attribute `carriers` of inputs. paths: data paths of properties from the owner.
    laid: names of bones over which different systems of Motus lay poses.
    """

    carriers: tuple
    paths: tuple
    laid: tuple


def _stamp(owner, copy, scene, asked):
    """Hashable value that changes whenever the inputs of an owner's entries may change; None if changes cannot be detected."""
    if copy is None:
        return None
    found = [copy.number, strips.stamp_of(owner.animation_data), *scene_time.stamp(scene)]
    if owner.type == 'ARMATURE':
        found.append(copies.stamp_of_data(owner))
    found += [stamp_of_carrier(owner, name, scene, registered["dynamics"]) for name in asked.carriers]
    found += [strips.stamp_of(_animation_of(owner, path)) for path in asked.paths]
    found += [stamp_of_known(own_track(owner.pose.bones[name])) for name in asked.laid]
    return strips.together(found)


def _animation_of(owner, path):
    """Return the animation data of the datablock that has a property; None if there is none. path: data path from the owner."""
    try:
        return owner.path_resolve(path, False).id_data.animation_data
    except (ValueError, AttributeError):
        return None


class Numbers(NamedTuple):
    """The numbers of an entry: attributes of the same names as those of its settings, which Blender takes ten times as long to look up."""

    frequency: float
    damping: float
    response: float
    delay: float
    jump: float
    weight: float
    loop_start: int
    loop_end: int
    use_loop: bool
    is_muted: bool


def _numbers(entries):
    """List the Numbers of all entries of an owner."""
    columns = [np.empty(len(entries), {float: np.float32, int: np.int32}.get(kind, bool)) for kind in Numbers.__annotations__.values()]
    for name, column in zip(Numbers._fields, columns):
        entries.foreach_get(name, column)
    return [Numbers(*row) for row in zip(*(column.tolist() for column in columns))]


class _Making:
    """Collects the units and properties of a group, makes their filtered motions and lists their problems.

    First unit() and property() take in what the group has, then make() fills parts, tails and values.
    """

    def __init__(self, owner, settings, scene):
        self._owner, self._settings, self._scene = owner, settings, scene
        self._ready, self._count, self.reach = [], 0, None
        self.parts, self.tails, self.values, self.members, self.problems, self.carriers, self.laid = [], [], [], [], [], [], []
        self._numbers = _numbers(settings.entries)
        self._places = {
            ("", entry.data_path, entry.index) if entry.data_path else (entry.name, "", -1): place
            for place, entry in enumerate(settings.entries)
        }

    def unit(self, kind, names, rows):
        """Take in a unit of an object or bones.

        kind: as in groups.Unit. names: of the bones, "" for the object. rows: rows of the members in the group.
        """
        places = [self._places[name, "", -1] for name in names]
        entries = [self._settings.entries[place] for place in places]
        things = [self._owner.pose.bones[name] if name else self._owner for name in names]
        self._count += len(names)
        if any(map(_is_constrained, things)):
            self.problems.append(CONSTRAINED)
        source = Unit("", kind, entries, things).input(self._scene)
        self.carriers += source.carriers
        self.laid += source.laid
        numbers = [self._numbers[place] for place in places]
        if self._is_ready(source, numbers):
            if kind == 'TAILS':
                make = functools.partial(self._make_tails, source, things, numbers, rows, places)
            else:
                make = functools.partial(self._make_part, things, entries, rows, places)
            self._ready.append((source, numbers, make))

    def _make_tails(self, source, things, numbers, rows, places):
        first = len(self.members)
        made = motion.tails_of(source, things, numbers, range(first, first + len(things)), places, self._scene, self.reach)
        if made:
            self.members += zip([thing.name for thing in things], rows)
        self.tails += made
        return made

    def _make_part(self, things, entries, rows, places):
        part = motion.part_of(things[0], entries[0], rows[0], places[0], self._scene, self.reach)
        self.parts += [part] if part else []
        return [part] if part else []

    def property(self, path, index, outputs):
        """Take in a property. path, index: as in its entry. outputs: slice of the group's outputs for the property's elements."""
        place = self._places["", path, index]
        entry = self._settings.entries[place]
        self._count += 1
        source = inputs.ValueInput(self._owner, entry, self._scene)
        numbers = [self._numbers[place]]
        if len(source.tracks) == outputs.stop - outputs.start and self._is_ready(source, numbers):
            self._ready.append((source, numbers, functools.partial(self._make_values, source, entry, outputs, place)))

    def _make_values(self, source, entry, outputs, place):
        made = motion.values_of(source, entry, outputs, place, self._scene, self.reach)
        self.values += [made] if made else []
        return [made] if made else []

    def _is_ready(self, source, numbers):
        if any(entry.use_loop and not inputs.has_loop(entry) for entry in numbers):
            self.problems.append(EMPTY_LOOP)
        if not source.is_known and not all(entry.is_muted for entry in numbers):
            self.problems.append(of_unknown(source))
        if not all(math.isfinite(number) for entry in numbers for number in (entry.delay, entry.jump, entry.weight)):
            self.problems.append(BAD_NUMBERS)
            return False
        return source.is_known

    def make(self, frame, share):
        """Make the filtered motions of all entries whose inputs are known, for the sampling.Reach (range of frames) around a frame.

        share: that the owner has of the limit of work; the owner's groups share it in turn, in proportion to their entries.
        """
        price = sum(source.price for source, _, _ in self._ready)
        count = max(1, self._count)  # a script may have removed all entries
        share *= count / max(count, len(self._settings.entries))
        self.reach = sampling.reach_of(self._scene, frame, frame, price, share)
        for source, numbers, make in self._ready:
            if source.is_cut(self.reach, numbers):
                self.problems.append(TOO_LONG)
            self._try(make)

    def _try(self, make):
        try:
            if any(one.swings_through for one in make()):
                self.problems.append(JUMPS_LOOPED)
        except motion.OpenLoop:
            self.problems.append(LOOP_IS_OPEN)
        except ValueError:
            self.problems.append(BAD_NUMBERS)


def _make(context, copy, scene, share):
    # One question, so that what many bones depend on, such as the motion of their rig, is found once.
    return answered(object(), lambda: _made_anew(context, copy, scene, share))


def _made_anew(context, copy, scene, share):
    owner, settings = context.owner, context.settings
    plan = stored.parse(context.data.get(PLAN), _FORM)
    making = _Making(owner, settings, scene)
    row = slot = 0
    for kind, names in plan["units"]:
        making.unit(kind, names, range(row, row + len(names)))
        row += len(names)
    properties = plan.get(PROPERTIES, ())
    for path, index, count in properties:
        making.property(path, index, slice(slot, slot + count))
        slot += count
    if (row, slot) != (len(context.locations), len(context.outputs)):
        raise stored.Damaged("another number of members or outputs")
    making.make(context.frame, share)
    asked = Asked(tuple(dict.fromkeys(making.carriers)), tuple(path for path, _, _ in properties), tuple(dict.fromkeys(making.laid)))
    is_still = copy is not None and not copy.has_animated_settings
    return Made(
        _stamp(owner, copy, scene, asked),
        asked,
        making.reach,
        making.parts,
        making.tails,
        making.values,
        tuple(making.members),
        next(iter(making.problems), None),
        entries.weights(settings) if is_still else None,
        share,
        shares.edits(),
    )


def _is_constrained(thing):
    """Whether active constraints move an evaluated Object or PoseBone, other than those by which Motus applies dynamics or poses."""
    return any(one.influence > 0.0 for one in solved.acting_on(thing, registered["dynamics"]))


def _to_local(owner, moves, is_in_world):
    """Convert an object's moves to the axes in which its constraint adds them.

    is_in_world: whether `moves` are in world space instead of the axes of the object's location channels.
    """
    parent = owner.parent
    if parent is None or (not is_in_world and parent == in_world.parent_of(owner)):
        return moves
    if not is_in_world:
        bone = in_world.parent_of(owner)
        offset = Matrix(in_world.parent_offset(owner)[0].tolist())
        moves = (parent.matrix_world @ bone.matrix @ offset).to_3x3() @ Vector(moves)
    # Even if the parent is a bone, the constraint's axes are those of the parent object with the parent inverse.
    return (parent.matrix_world @ owner.matrix_parent_inverse).to_3x3().inverted_safe() @ Vector(moves)
