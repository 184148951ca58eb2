"""The steps of a whole shot, planned by the native library from the body's motion, the legs and the ground."""

import hashlib
import itertools
import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any, NamedTuple

from ..core import native, tracks
from ..core.animation import keys
from ..core.declare import Problem
from ..core.lazy import numpy as np
from ..core.measures import axes, scene_time
from ..core.refusals import INFINITE
from . import carrying, ground, legs
from .properties import NUMBERS

UNLIKE = 1e-4
"""How far numbers of a matrix are apart, of the largest, that somebody has changed. Blender's own are in single precision."""
MOST_FRAMES = 9_000
"""That are planned: fewer than keys.MOST, as each has to be a sample. *Jump* counts from one to the next."""
LEAST_STRIDE = 1e-4
"""m: a body that is scaled to nothing has steps too."""
MARGIN = 250.0
"""Frames after the scene's last one, to which a foot that is lifted by then may be on its way."""
EVERYWHERE = 1e6
"""m: length of a leg of which nobody knows how long it is."""
SCALED = "stride", "clearance", "minimum_step", "reach_up", "reach_down"
"""Lengths before the body's scale, under the library's names."""
BODY = "body_height", "body_tilt"
"""Settings of what rises and leans."""
SETTINGS = {
    "height": "body_height",
    "tilt": "body_tilt",
    "up": "up_axis",
    "forward": "forward_axis",
    "hips": "hip",
    "lengths": "length",
    "phases": "phase",
}
"""Arguments of the library that settings, also of legs, give under another name."""

NO_LEGS = Problem("There are no legs: add the walker again, and name its feet")
NOT_FINITE = Problem("A setting is not a finite number")
MOTION_NOT_FINITE = Problem("The body's motion is not a finite number")
TOO_FAR = Problem("The body goes too far away for its steps to be planned")
AXES_NOT_ACROSS = Problem("The forward axis and the up axis must be perpendicular to each other")
TOO_MANY = Problem("The walk has more than 1,000,000 steps: a longer stride, a slower body or a lower cadence has fewer")
OUT_OF_RANGE = Problem("A setting is outside of what a walk can be planned by")
UNKNOWN = Problem("The body's motion is not known ahead, and its feet do not step: record it, or key it", blocking=False)
UNKEYED = Problem("The body was moved away from its keys: its feet stand below it until it is keyed here", blocking=False)
UNRECORDED = Problem("The body is not where it was recorded, and its feet stand below it: record it again, here too", blocking=False)
BEYOND = Problem("The walk is planned for the frames of the scene: here the feet stand", blocking=False)
TOO_LONG = Problem("Only the first 9,000 frames of the body's motion are walked: beyond, the feet stand", blocking=False)
PROBLEMS = (
    NO_LEGS,
    NOT_FINITE,
    MOTION_NOT_FINITE,
    TOO_FAR,
    AXES_NOT_ACROSS,
    TOO_MANY,
    OUT_OF_RANGE,
    UNKNOWN,
    UNKEYED,
    UNRECORDED,
    TOO_LONG,
    BEYOND,
    *ground.PROBLEMS,
)

EVER = -math.inf, math.inf


class Poses(NamedTuple):
    """Where the body is over time.

    digest: of the samples, which is the same in the viewport and on each frame of a render. known: (first, last) frame up to
    which it goes on as the samples say.
    """

    digest: bytes
    seconds: Any
    matrices: Any
    known: tuple


class Numbers(NamedTuple):
    """Settings that the plan is made from."""

    gait: str
    duty: float
    values: tuple
    forward: tuple
    up: tuple
    plane: Any
    rest: tuple
    hips: tuple
    lengths: tuple
    phases: tuple

    def value(self, name):
        """A number among NUMBERS."""
        return self.values[NUMBERS.index(name)]


class Plan(NamedTuple):
    """A walk that is planned.

    walker: the native Walker. fault: Problem or None. known: as of Poses. stamp: of all that the plan was made from.
    has_problems: whether walker.problems has any.
    """

    walker: Any
    fault: Any
    known: tuple
    stamp: Any
    has_problems: bool


def of(owner, scene, numbers, frame=None):
    """The Plan of an evaluated owner, or the Problem that keeps it from walking. numbers: read() of its settings.

    frame: the present one in a viewport, where somebody may have moved the body without keys.
    """
    if isinstance(numbers, Problem):
        return numbers
    fps = scene_time.fps(scene)
    poses, fault = body(owner, scene, fps)
    beyond = None
    if poses is not None and frame is not None:
        if not poses.known[0] <= frame <= poses.known[1]:
            # A body that rests where the samples begin or end, such as one that has arrived, is as it is planned.
            beyond = BEYOND if _differs(owner, poses.matrices[0 if frame < poses.known[0] else -1]) else None
        elif _is_elsewhere(owner, poses, frame / fps):
            poses, fault = _standing(owner), UNRECORDED if body_track(owner, scene).reason else UNKEYED
    if poses is None:
        return MOTION_NOT_FINITE
    placed, unsure = ground.parts(owner.motus.walker, scene)
    bodies, moving = carrying.moved(owner, poses.seconds * fps, poses.digest) if any(numbers.lengths) else (None, None)
    stamp = numbers, poses.digest, tuple(one.stamp for one in placed), moving
    made = tracks.kept_by(stamp, "walker plan", lambda: _made(numbers, poses, placed, bodies))
    if isinstance(made, Problem):
        return made
    walker, has_problems = made
    return Plan(walker, fault or unsure or beyond, poses.known, stamp, has_problems)


def read(settings):
    """Numbers of the settings, or what is wrong with them: Problem.about names the setting then, of a leg too."""
    if not settings.legs:
        return NO_LEGS
    for name in ("forward_axis", "up_axis"):
        if getattr(settings, name) not in axes.IDENTIFIERS:  # in a file that somebody has changed
            return replace(OUT_OF_RANGE, about=name)
    if settings.forward_axis[-1] == settings.up_axis[-1]:
        return AXES_NOT_ACROSS
    owner = settings.id_data
    rest, hips = ([tuple(getattr(leg, name)) for leg in settings.legs] for name in ("rest", "hip"))
    lengths = [0.0 if legs.stretches(owner, leg) else leg.length for leg in settings.legs]
    phases = [leg.phase for leg in settings.legs]
    # Where nothing rises and leans, the hips stay where they are moved.
    stays = () if legs.body(owner) else BODY
    values = tuple(0.0 if name in stays else getattr(settings, name) for name in NUMBERS)
    found: dict[str, Iterable[float]] = dict(zip(NUMBERS, ((number,) for number in values)))
    found |= {"length": lengths, "phase": phases, "rest": itertools.chain(*rest), "hip": itertools.chain(*hips)}
    for name, numbers in found.items():
        if not all(abs(number) < INFINITE for number in numbers):
            return replace(NOT_FINITE, about=name)
    return Numbers(
        settings.gait,
        settings.duty if settings.use_duty or settings.gait == 'OWN' else 0.0,
        values,
        axes.vector(settings.forward_axis),
        axes.vector(settings.up_axis),
        settings.plane_height if settings.use_plane else None,
        tuple(rest),
        tuple(hips),
        tuple(lengths),
        tuple(phases),
    )


def body_track(owner, scene):
    """The Track of what is moved."""
    return tracks.world_track(owner, scene)


def body(owner, scene, fps):
    """(Poses, Problem or None) of an evaluated owner; None for poses that are not finite."""
    track = body_track(owner, scene)
    if not track.is_known:
        return _standing(owner), UNKNOWN
    stamp = track.stamp
    # To find the extent takes longer than the stamp.
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
    """Whether an evaluated owner is known to move."""
    poses, fault = body(owner, scene, scene_time.fps(scene))
    return fault != UNKNOWN and (poses is None or len(poses.seconds) > 1)


def _is_elsewhere(owner, poses, seconds):
    """Whether an evaluated owner stands where its Poses do not have it; it can be told on whole frames, and where it rests."""
    times = poses.seconds
    if len(times) == 1:
        return False
    row = min(np.searchsorted(times, seconds), len(times) - 1)
    rests = (seconds > times[-1] and poses.known[1] == EVER[1]) or (seconds < times[0] and poses.known[0] == EVER[0])
    return (times[row] == seconds or rests) and _differs(owner, poses.matrices[row])


def _differs(owner, known):
    """Whether an evaluated owner stands elsewhere than this matrix says."""
    return np.abs(np.array(owner.matrix_world, float) - known).max() > UNLIKE * max(1.0, np.abs(known).max())


def _standing(owner):
    samples = _digested(np.zeros(1), np.array(owner.matrix_world, float)[None])
    return samples and Poses(*samples, EVER)  # type: ignore[call-arg]


def _digested(seconds, matrices):
    """(digest, seconds, matrices); None where these are not finite."""
    if not np.isfinite(matrices).all():
        return None
    digest = hashlib.blake2b(np.ascontiguousarray(seconds), digest_size=16)
    digest.update(np.ascontiguousarray(matrices))
    return digest.digest(), seconds, matrices


def span(extent, scene):
    """(first, last) frame of a motion that is read: all of one that ends, else the scene's.

    From a frame before, so that the library sees the body come, or rest. A motion without a beginning is read from frame 0 on,
    even if the scene begins later, and one without an end beyond the scene's: the steps on a frame are the same whichever part of
    the shot is rendered.
    """
    start, end = extent
    last = end if math.isfinite(end) else scene_time.last(scene) + MARGIN
    first = start if math.isfinite(start) else min(scene_time.first(scene), 1.0, end + 1.0)
    if math.isinf(start) and last - first >= MOST_FRAMES:
        first = scene_time.first(scene)  # then there is not room for all
    return first - 1.0, max(last, first - 1.0)


def _sampled(track, first, last, fps):
    whole = [first, *keys.whole(first, last), last]
    frames = keys.union([whole, track.bounds(first, last)])
    if len(frames) >= keys.MOST:  # which leaves some out
        frames = keys.union([whole])
    at = np.array(frames)
    seconds, places = np.unique(at / fps, return_index=True)
    return _digested(seconds, track.values(at[places]))


def _made(numbers, poses, placed, bodies):
    """(the native Walker, whether there are problems with its steps), or what is wrong with the settings."""
    # The largest: what grows from nothing has legs as well.
    scale = np.abs(np.linalg.det(poses.matrices[:, :3, :3])).max() ** (1.0 / 3.0)
    rest = np.array(numbers.rest)
    try:
        phases, duty = numbers.phases, numbers.duty
        if numbers.gait != 'OWN':
            phases, usual = native.module.walker_gait(numbers.gait.lower(), rest, numbers.forward, numbers.up)
            duty = duty or usual
        given = {name: scale * numbers.value(name) for name in SCALED} | _reach(numbers, poses.matrices, bodies)
        given["stride"] = max(given["stride"], LEAST_STRIDE)
        jump = scale * numbers.value("jump")
        walker = native.module.Walker(
            poses.seconds,
            poses.matrices,
            rest,
            ground.made(placed, numbers.plane),
            phases=phases,
            duty=duty,
            cadence=numbers.value("cadence"),
            up=numbers.up,
            jump=jump or None,
            frequency=numbers.value("frequency"),
            damping=numbers.value("damping"),
            height=numbers.value("body_height"),
            tilt=numbers.value("body_tilt"),
            **given,
        )
    except ValueError as error:
        return _refusal(str(error))
    return walker, bool(walker.problems)


def _refusal(sentence):
    """The Problem for a sentence of the library, which begins with the name of an argument."""
    if "more than 1,000,000 steps" in sentence:
        return TOO_MANY
    name = sentence.split()[0].rstrip(":")
    return TOO_FAR if name == "poses" else replace(OUT_OF_RANGE, about=SETTINGS.get(name, name))


def _reach(numbers, matrices, bodies):
    """Keywords of the native Walker for the legs' reach; {} if it is not known."""
    if not any(numbers.lengths):
        return {}
    # A leg may point along any axis of a body that is scaled unevenly: along the longest one it reaches farthest.
    scale = np.linalg.norm(matrices[:, :3, :3], 2, axis=(1, 2)).max()
    return {
        "hips": np.array(numbers.hips),
        "lengths": np.array([scale * one if one else EVERYWHERE for one in numbers.lengths]),
        "bodies": bodies,
    }
