"""Plan the steps of a whole shot: the native library computes them from the body's motion, the legs and the ground.

The owner is the object that walks; its world matrix is the motion of the body. A Problem is a sentence that the panel shows.
"""

import hashlib
import itertools
import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any, NamedTuple

from ..core import keeping, native, tracks
from ..core.animation import keys
from ..core.declare import Problem
from ..core.evaluated import copies
from ..core.lazy import numpy as np
from ..core.measures import axes, scene_time
from ..core.refusals import INFINITE
from . import carrier, carrying, ground, keyed, legs, pace
from .properties import NUMBERS
from .steps import stored

UNLIKE = 1e-4
"""Difference between numbers of two world matrices, as a share of the largest, from which on the body counts as moved by the artist.

It is larger than the rounding of Blender's matrices, which are in single precision.
"""
MOST_FRAMES = 9_000
"""Most frames of a motion that are planned. Fewer than keys.MOST, since each whole frame has to be a sample.

The setting Jump compares the body's place in one sample with its place in the next.
"""
LEAST_STRIDE = 1e-4
"""Smallest stride, in metres, so that a body that is scaled to nothing has steps too."""
MARGIN = 250.0
"""Frames after the scene's last one that are planned too: a foot that is lifted at the end of the scene touches down later."""
EVERYWHERE = 1e6
"""Length, in metres, that the library is given for a leg of unknown length, so that the leg reaches everywhere."""
SCALED = "stride", "clearance", "minimum_step", "reach_up", "reach_down", "ankle", "heel", "toe", "hip_height"
"""Settings that are lengths in the body's space, which the body's scale multiplies; the library has arguments of these names."""
SOLES = "strike", "push"
"""Settings that have an effect only if feet turn with the ground."""
BODY = "body_height", "body_tilt"
"""Settings that have an effect only if the walker has a body part that rises and leans."""
SETTINGS = {
    "height": "body_height",
    "tilt": "body_tilt",
    "up": "up_axis",
    "forward": "forward_axis",
    "hips": "hip",
    "lengths": "length",
    "phases": "phase",
    "chosen": "steps",
    "strides": "stride",
    "cadences": "cadence",
    "duties": "duty",
    "changes": "gait",
}
"""Argument of the library -> setting of the walker, or of a leg, that has a different name."""

NO_HEIGHT = Problem("Natural Stride has no height to go by: set Hip Height")
NO_LEGS = Problem("There are no legs: add the walker again, and name its feet")
NOT_FINITE = Problem("A setting is not a finite number")
MOTION_NOT_FINITE = Problem("The body's motion is not a finite number")
TOO_FAR = Problem("The body goes too far away for its steps to be planned")
AXES_NOT_ACROSS = Problem("The forward axis and the up axis must be perpendicular to each other")
TOO_MANY = Problem("The walk has more than 1,000,000 steps: a longer stride, a slower body or a lower cadence has fewer")
OUT_OF_RANGE = Problem("A setting is outside of what a walk can be planned by")
UNKNOWN = Problem("The body's motion is not known ahead, and its feet do not step: record it, or key it", blocking=False)
UNKNOWN_CARRIER = Problem("The carrier's motion is not known ahead, and feet do not step on it: record it, or key it", blocking=False)
UNKEYED = Problem("The body was moved away from its keys: its feet stand below it until it is keyed here", blocking=False)
UNRECORDED = Problem("The body is not where it was recorded, and its feet stand below it: record it again, here too", blocking=False)
BEYOND = Problem("The walk is planned for the frames of the scene: here the feet stand", blocking=False)
TOO_LONG = Problem("Only the first 9,000 frames of the body's motion are walked: beyond, the feet stand", blocking=False)
PROBLEMS = (
    NO_LEGS,
    NO_HEIGHT,
    NOT_FINITE,
    MOTION_NOT_FINITE,
    TOO_FAR,
    AXES_NOT_ACROSS,
    TOO_MANY,
    OUT_OF_RANGE,
    UNKNOWN,
    UNKNOWN_CARRIER,
    keyed.UNKNOWN,
    UNKEYED,
    UNRECORDED,
    TOO_LONG,
    BEYOND,
    *ground.PROBLEMS,
)

EVER = -math.inf, math.inf

_KEPT = keeping.OfEvaluation(
    "a walker's plan, and the frame at which its present evaluated copy was first evaluated",
    "name of the value; the plan is looked up again if what it is made from differs",
    "one for each name",
)


class Poses(NamedTuple):
    """World matrices of an object that walks, over time.

    digest: hash of the samples; equal in the viewport and on each frame of a render. seconds: (k,), rising.
    matrices: (k, 4, 4). known: (first, last) frame between which the samples tell where the object is; a side is infinite if the object
    rests before its first or after its last sample.
    """

    digest: bytes
    seconds: Any
    matrices: Any
    known: tuple


class Numbers(NamedTuple):
    """Settings of a walker that the plan is made from, as numbers and tuples, so that they can be compared and hashed.

    values: of the settings properties.NUMBERS. rest, hips, lengths, phases: an item for each leg. plane: height of the plane, or None.
    has_duty: whether the setting Duty counts instead of the usual one of the gait. A length of 0 is for a leg that reaches everywhere.
    turns: of the feet, in the body's space; empty if feet do not turn with the ground. chosen: steps that were chosen by hand, as
    steps/stored.py reads them. keyed: names of the settings that are keyed, whose values here are 0 or empty.
    """

    gait: str
    has_duty: bool
    values: tuple
    forward: tuple
    up: tuple
    plane: Any
    rest: tuple
    hips: tuple
    lengths: tuple
    phases: tuple
    turns: tuple
    chosen: tuple
    keyed: tuple

    def value(self, name):
        """Value of the setting of this name, one of properties.NUMBERS."""
        return self.values[NUMBERS.index(name)]


class Plan(NamedTuple):
    """The planned walk of one owner over the whole shot.

    walker: the native Walker. fault: the Problem to show, which does not keep the owner from walking, or None.
    known: (first, last) frame for which the walk is planned, see Poses. stamp: hashable value that changes with all that the plan
    was made from. troubles: the set of all reasons in walker.problems. turns: see Numbers.
    """

    walker: Any
    fault: Any
    known: tuple
    stamp: Any
    troubles: Any
    turns: tuple


def of(owner, scene, numbers, frame=None):
    """Return the Plan of an evaluated owner (the object that walks), or the Problem that keeps it from walking.

    numbers: result of read() for the owner's settings. frame: the present frame in a viewport, where the artist may have moved the body
    without keys; None if that is not to be examined, as in a render.
    """
    if isinstance(numbers, Problem):
        return numbers
    fps = scene_time.fps(scene)
    poses, fault = body(owner, scene, fps)
    beyond, is_standing = None, fault in {UNKNOWN, UNKNOWN_CARRIER}
    if poses is not None and frame is not None:
        if not poses.known[0] <= frame <= poses.known[1]:
            # A body that stands where the first or last sample has it, such as one that has arrived, is planned correctly.
            beyond = BEYOND if _differs(owner, poses.matrices[0 if frame < poses.known[0] else -1]) else None
        elif _may_be_elsewhere(owner, scene, frame) and _is_elsewhere(owner, poses, frame / fps):
            poses, fault, is_standing = _standing(owner), UNRECORDED if body_track(owner, scene).reason else UNKEYED, True
    if poses is None:
        return MOTION_NOT_FINITE
    values, keys_stamp = {}, None
    if numbers.keyed:
        # Rounded, so that a key on a whole frame is not missed by the last digit.
        found = keyed.over(owner, numbers.keyed, np.round(poses.seconds * fps, 9), poses.digest)
        if isinstance(found, Problem):
            return found
        values, keys_stamp = found
    placed, unsure = ground.parts(owner.motus.walker, scene)
    bodies, moving = carrying.moved(owner, poses.seconds * fps, poses.digest) if any(numbers.lengths) else (None, None)
    stamp = numbers, poses.digest, tuple(one.stamp for one in placed), moving, keys_stamp
    made = _kept(owner, stamp, lambda: tracks.kept_by(stamp, "walker plan", lambda: _made(numbers, values, poses, placed, bodies, fps)))
    if isinstance(made, Problem):
        return made
    walker, troubles = made
    found = Plan(walker, fault or unsure or beyond, poses.known, stamp, troubles, numbers.turns)
    return found if carrier.of(owner.motus.walker) is None else _carried(found, owner, scene, is_standing)


def _carried(planned, owner, scene, is_standing):
    """Return a Plan that was made in the space of the owner's carrier, as a Plan in the world.

    is_standing: whether the carrier counts as standing where it is now, since body or carrier are not where they are known to be.
    """
    if is_standing:
        world = _matrix(carrier.of(owner.motus.walker))
        return planned._replace(
            walker=carrier.Carried(planned.walker, lambda times: np.broadcast_to(world, (len(times), 4, 4))),
            stamp=(planned.stamp, world.tobytes()),
        )
    track, fps = carrier.track_of(owner, scene), scene_time.fps(scene)
    return planned._replace(
        walker=carrier.Carried(planned.walker, lambda times: track.values(times * fps)), stamp=(planned.stamp, track.stamp)
    )


def _matrix(obj):
    return np.array(obj.matrix_world, float)


def _kept(owner, stamp, make):
    """Return make(), kept with the evaluated owner until the stamp changes: to compare two stamps takes less time than to hash one."""
    kept = _KEPT.on(copies.of(owner))
    if kept.get("stamp") != stamp:
        kept["plan"] = make()
        kept["stamp"] = stamp
    return kept["plan"]


def read(settings):
    """Read the settings of a walker as Numbers; returns a Problem if a setting is wrong.

    Problem.about is the name of the wrong setting, of the walker or of a leg.
    """
    if not settings.legs:
        return NO_LEGS
    for name in ("forward_axis", "up_axis"):
        if getattr(settings, name) not in axes.IDENTIFIERS:  # possible in a damaged file
            return replace(OUT_OF_RANGE, about=name)
    if settings.forward_axis[-1] == settings.up_axis[-1]:
        return AXES_NOT_ACROSS
    owner = settings.id_data
    rest, hips = ([tuple(getattr(leg, name)) for leg in settings.legs] for name in ("rest", "hip"))
    lengths = [0.0 if legs.stretches(owner, leg) else leg.length for leg in settings.legs]
    phases = [leg.phase for leg in settings.legs]
    timed = keyed.names(owner)
    # Without a part that rises and leans, the hips follow the owner alone.
    stays = {*(() if legs.body(owner) else BODY), *(() if settings.use_soles else SOLES), *timed}
    turns = [tuple(leg.turn) for leg in settings.legs] if settings.use_soles else []
    height = pace.hip_height(settings) if settings.use_natural else 0.0
    values = tuple(height if name == "hip_height" else 0.0 if name in stays else getattr(settings, name) for name in NUMBERS)
    found: dict[str, Iterable[float]] = dict(zip(NUMBERS, ((number,) for number in values)))
    found |= {"length": lengths, "phase": phases}
    steps = stored.read(settings)
    found |= {"steps": stored.numbers(steps)}
    found |= {"rest": itertools.chain(*rest), "hip": itertools.chain(*hips), "turn": itertools.chain(*turns)}
    for name, numbers in found.items():
        if not all(abs(number) < INFINITE for number in numbers):
            return replace(NOT_FINITE, about=name)
    if settings.use_natural and height == 0.0:
        return NO_HEIGHT
    return Numbers(
        "" if "gait" in timed else settings.gait,
        settings.use_duty,
        values,
        axes.vector(settings.forward_axis),
        axes.vector(settings.up_axis),
        settings.plane_height if settings.use_plane else None,
        tuple(rest),
        tuple(hips),
        tuple(lengths),
        tuple(phases),
        tuple(turns),
        steps,
        timed,
    )


def body_track(owner, scene):
    """Return the Track (world matrices at any frame) of the object that walks."""
    return tracks.world_track(owner, scene)


def way_track(owner, scene):
    """Return the motion of the object that walks in the space that its steps are planned in: the world, or the space of its carrier."""
    carried_by = carrier.track_of(owner, scene)
    return body_track(owner, scene) if carried_by is None else carrier.InSpace(body_track(owner, scene), carried_by)


def body(owner, scene, fps):
    """Sample the motion of an evaluated owner; returns (Poses, Problem to show or None).

    The Poses are None if they are not finite. An owner whose motion is unknown, or that does not move, has a single sample.
    """
    track = way_track(owner, scene)
    if not track.is_known:
        return _standing(owner), UNKNOWN if not body_track(owner, scene).is_known else UNKNOWN_CARRIER
    stamp = track.stamp
    # The extent may take longer to find than the stamp: it is kept until the stamp changes.
    extent = tracks.kept_by(stamp, "walker", lambda: track.extent)
    if extent is None:
        return _standing(owner), None
    first, last = span(extent, scene)
    fault = None
    if last - first > MOST_FRAMES:
        last, fault = first + MOST_FRAMES, TOO_LONG
    start, end = extent
    known = first if math.isinf(start) else EVER[0], last if math.isinf(end) or fault else EVER[1]
    samples = tracks.kept_by(stamp, ("walker", first, last, fps), lambda: _sampled(track, first, last, fps))
    return samples and Poses(*samples, known), fault  # type: ignore[call-arg]


def is_moved(owner, scene):
    """Whether the world matrix of an evaluated owner is known to change over time; false if its motion is unknown."""
    poses, fault = body(owner, scene, scene_time.fps(scene))
    return fault not in {UNKNOWN, UNKNOWN_CARRIER} and (poses is None or len(poses.seconds) > 1)


def _may_be_elsewhere(owner, scene, frame):
    """Whether the artist may have moved an evaluated owner without keys at this frame.

    To move it makes a new evaluated copy. If nothing but keys moves the owner, they set it again on the next other frame.
    """
    if not way_track(owner, scene).rests_on_keys:
        return True
    kept = _KEPT.on(copies.of(owner))
    if "frame" not in kept:
        kept["frame"] = frame
    if kept["frame"] not in (frame, None):
        kept["frame"] = None
    return kept["frame"] is not None


def _is_elsewhere(owner, poses, seconds):
    """Whether an evaluated owner stands at a place different from its Poses, because the artist has moved it without keys.

    seconds: the present time. False for a time between two samples, at which the exact place is not known.
    """
    times = poses.seconds
    if len(times) == 1:
        return False
    row = min(int(times.searchsorted(seconds)), len(times) - 1)
    rests = (seconds > times[-1] and poses.known[1] == EVER[1]) or (seconds < times[0] and poses.known[0] == EVER[0])
    return (times[row] == seconds or rests) and _differs(owner, poses.matrices[row])


def _differs(owner, known):
    """Whether the world matrix of an evaluated owner differs from a known one, (4, 4), by more than UNLIKE."""
    numbers = known.ravel().tolist()
    apart = [abs(one - other) for one, other in zip(_present(owner).ravel().tolist(), numbers)]
    return max(apart) > UNLIKE * max(1.0, *map(abs, numbers))


def _present(owner):
    """Matrix (4, 4) of an evaluated owner now, in the world or in the space of its carrier."""
    carried_by = carrier.of(owner.motus.walker)
    return _matrix(owner) if carried_by is None else carrier.in_space(_matrix(carried_by)[None], _matrix(owner)[None])[0]


def _standing(owner):
    samples = _digested(np.zeros(1), _present(owner)[None])
    return samples and Poses(*samples, EVER)  # type: ignore[call-arg]


def _digested(seconds, matrices):
    """Return (hash, seconds, matrices) of the samples of a motion; None if a matrix is not finite."""
    if not np.isfinite(matrices).all():
        return None
    digest = hashlib.blake2b(np.ascontiguousarray(seconds), digest_size=16)
    digest.update(np.ascontiguousarray(matrices))
    return digest.digest(), seconds, matrices


def span(extent, scene):
    """Return the (first, last) frame between which a motion is sampled: its whole extent, or the scene's frames if it has no end.

    extent: (first, last) frame of the motion, each may be infinite. Sampling begins a frame earlier, so that the library knows the
    body's velocity at the beginning. A motion without a beginning is sampled from frame 0 on, even if the scene begins later, and a
    motion without an end up to MARGIN frames after the scene's end. So the steps on a frame do not depend on which part of the shot is
    rendered.
    """
    start, end = extent
    last = end if math.isfinite(end) else scene_time.last(scene) + MARGIN
    first = start if math.isfinite(start) else min(scene_time.first(scene), 1.0, end + 1.0)
    if math.isinf(start) and last - first >= MOST_FRAMES:
        first = scene_time.first(scene)  # all frames from 0 on would be more than MOST_FRAMES
    return first - 1.0, max(last, first - 1.0)


def _sampled(track, first, last, fps):
    whole = [first, *keys.whole(first, last), last]
    frames = keys.union([whole, track.bounds(first, last)])
    if len(frames) >= keys.MOST:  # keys.union() leaves out frames beyond this number
        frames = keys.union([whole])
    at = np.array(frames)
    seconds, places = np.unique(at / fps, return_index=True)
    return _digested(seconds, track.values(at[places]))


def _made(numbers, values, poses, placed, bodies, fps):
    """Make (the native Walker, the reasons in its problems); returns a Problem if the settings are refused.

    values: {name: values (k,)} of keyed settings at the samples. poses: Poses of the body. placed: ground meshes, tuple of meshes.Placed.
    bodies: matrices (k, 4, 4) of the body bone, or None.
    """
    # The largest scale over time counts, so that a body that grows from a scale of 0 has steps.
    scale = np.abs(np.linalg.det(poses.matrices[:, :3, :3])).max() ** (1.0 / 3.0)
    try:
        given = {name: scale * numbers.value(name) for name in SCALED} | _reach(numbers, poses.matrices, bodies)
        given |= keyed.keywords(numbers, values)
        given["stride"] = max(given["stride"], LEAST_STRIDE)
        if "strides" in given:
            given["strides"] = np.maximum(scale * given["strides"], LEAST_STRIDE)
        jump = scale * numbers.value("jump")
        walker = native.module.Walker(
            poses.seconds,
            poses.matrices,
            np.array(numbers.rest),
            ground.made(placed, numbers.plane),
            up=numbers.up,
            jump=jump or None,
            frequency=numbers.value("frequency"),
            damping=numbers.value("damping"),
            height=numbers.value("body_height"),
            tilt=numbers.value("body_tilt"),
            forward=numbers.forward,
            strike=numbers.value("strike"),
            push=numbers.value("push"),
            chosen=stored.given(numbers.chosen, fps),
            **given,
        )
    except ValueError as error:
        return _refusal(str(error))
    return walker, frozenset(reason for *_, reason in walker.problems)


def _refusal(sentence):
    """Return the Problem for an error message of the native library, whose first word is the name of the wrong argument."""
    if "more than 1,000,000 steps" in sentence:
        return TOO_MANY
    name = sentence.split()[0].rstrip(":")
    return TOO_FAR if name == "poses" else replace(OUT_OF_RANGE, about=SETTINGS.get(name, name))


def _reach(numbers, matrices, bodies):
    """Keywords of the native Walker that tell how far each leg reaches; {} if no leg's length is known.

    matrices: world matrices (k, 4, 4) of the body. bodies: matrices (k, 4, 4) of the body bone's own motion, or None.
    """
    if not any(numbers.lengths):
        return {}
    # A leg may point along any axis of a body that is scaled unevenly: along the longest one it reaches farthest.
    scale = np.linalg.norm(matrices[:, :3, :3], 2, axis=(1, 2)).max()
    return {
        "hips": np.array(numbers.hips),
        "lengths": np.array([scale * one if one else EVERYWHERE for one in numbers.lengths]),
        "bodies": bodies,
    }
