"""Marks in lying snow: what movers, objects that go from place to place, press down or sweep away, at any frame.

The times of marks are frames since the first snow, as movers are keyed by the scene's frames and not by the snow's own time.
"""

import hashlib
import math
from typing import Any, NamedTuple

from mathutils import Matrix

from ...core import native
from ...core.declare import Problem
from ...core.lazy import numpy as np
from ...core.scenery import meshes, stillness
from ...core.scenery.meshes import hash_of, is_same
from .. import births, clock, flakes

UNKNOWN = Problem("What is deformed, or whose motion is not known ahead, leaves no marks: key it, or record its motion", False)
STEP = 0.5
"""Longest way of a mover between two looks at it, as a share of the layer's resolution."""
KNOTS, IN_A_STRETCH = 128, 16
"""Most times, while movers move, at which the depth of the snow is computed; how many of them a native SnowMarks has.

They are on whole frames. From one of these times to the next the snow grows evenly.
"""
LOOK = 1.0
"""Price of a look at a vertex below a mover: about a microsecond, see core/measures/bounds.py."""


class Mover(NamedTuple):
    """An object that leaves marks. stamp: hash of its faces and poses.

    faces: meshes.Faces, in its own space. times: (k,), rising. matrices: (k, 4, 4), to world space.
    """

    stamp: Any
    faces: Any
    times: Any
    matrices: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


class Marks(NamedTuple):
    """All that marks are computed from, beside the lying snow; hashable.

    stamp: hashable, equal for equal content. movers: tuple of Movers. start: frame of the time 0. times: (k,), rising, at which the depth
    of the snow is computed. seconds: own times (k,) of the snow of each Fall then. packed: depth, m, of the snow that stays under movers.
    """

    stamp: Any
    movers: tuple
    start: float
    times: Any
    seconds: tuple
    packed: float

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


def collected(settings, movers, scene, clocks, last):
    """Return (Marks, Problem to show or None); (None, Problem or None) if nothing leaves marks.

    settings: of the cover. movers: evaluated objects. clocks: a Clock for each Fall. last: frame until which flakes fall.
    """
    start = min(one.start for one in clocks)
    if last <= start:
        return None, None
    known = [one for one in movers if births.track(one, scene).is_known and not stillness.deforms(one, scene)]
    found = tuple(filter(None, (_mover(one, scene, start, last) for one in known)))
    fault = None if len(found) == len(movers) else UNKNOWN
    if not found:
        return None, fault
    times = _times(found, start, last)
    seconds = tuple(one.many(start + times) for one in clocks)
    stamp = found, start, times.tobytes(), tuple(one.tobytes() for one in seconds), settings.packed
    return Marks(stamp, found, start, times, seconds, settings.packed), fault


def _mover(obj, scene, start, last):
    """The Mover of an evaluated object whose motion is known; None if it has no faces, or is at no finite place."""
    faces, moved = meshes.faces(obj), births.track(obj, scene)
    if moved.extent is None:
        poses = births.standing(obj.matrix_world)
    else:
        poses = births.moving(moved, last, math.inf, clock.Clock(start, 1.0))
    if faces is None or poses is None or not np.isfinite(poses.matrices).all():
        return None
    digest = hashlib.blake2b(np.ascontiguousarray(poses.seconds), digest_size=16)
    digest.update(np.ascontiguousarray(poses.matrices))
    return Mover((faces.stamp, digest.digest()), faces, poses.seconds, poses.matrices)


def _times(movers, start, last):
    """Rising times (k,) from frame `start` to frame `last`, on whole frames and close to each other while a mover moves."""
    moving = [one.times for one in movers if len(one.times) > 1]
    if not moving:
        return np.array([0.0, last - start])
    first, end = math.floor(start + min(times[0] for times in moving)), math.ceil(start + max(times[-1] for times in moving))
    frames = np.arange(first, end + 1, max(1, math.ceil((end - first) / KNOTS)))
    return np.unique(np.clip([start, *frames, end, last], start, last)) - start


def price(marks, vertices, resolution):
    """Approximate price of the looks at all movers (see core/measures/bounds.py). vertices: of the layer. resolution: of it, m."""
    return sum(_price(one, vertices, resolution) for one in marks.movers)


def _price(mover, vertices, resolution):
    places = mover.matrices[:, :3, 3]
    way = np.sqrt((np.diff(places, axis=0) ** 2).sum(axis=1)).sum()
    size = np.ptp(mover.faces.positions, axis=0) * np.sqrt((mover.matrices[0, :3, :3] ** 2).sum(axis=0))
    beneath = min(vertices, (1.0 + np.sort(size)[1:] / (0.6 * resolution)).prod())
    return LOOK * beneath * (len(mover.times) + way / (STEP * resolution))


def part_count(marks):
    """Number of parts in which steps() computes marks."""
    return math.ceil((len(marks.times) - 1) / IN_A_STRETCH)


def steps(plan, ground, covers):
    """Compute the marks of a work.Plan in parts, and return them as a tuple of native SnowMarks; yields after each part.

    ground: Ground. covers: native SnowCover of each Fall of the plan. The result has only stretches of time in which something is pressed.
    """
    marks, found = plan.marks, []
    movers = [
        (flakes.collider((meshes.Placed((one.faces.stamp, "own"), one.faces, Matrix()),)), one.times, one.matrices) for one in marks.movers
    ]
    for first in range(0, len(marks.times) - 1, IN_A_STRETCH):
        stretch = slice(first, first + IN_A_STRETCH + 1)
        rows = [heights(ground, covers, [own[at] for own in marks.seconds]) for at in range(*stretch.indices(len(marks.times)))]
        one = native.module.SnowMarks(
            ground.layer, movers, marks.times[stretch], np.stack(rows), packed=marks.packed, step=STEP * plan.resolution
        )
        if one.marked_count:
            found.append(one)
        yield
    return tuple(found)


def heights(ground, covers, seconds):
    """How deep the snow lies on each vertex of the layer, (v,) float32, m, if nothing presses it.

    ground: Ground. covers: native SnowCovers. seconds: own time of the snow of each.
    """
    shown = slice(ground.layer.vertex_count)
    return sum((cover.heights(at)[shown] for cover, at in zip(covers, seconds)), np.float32(0.0))


def left(plan, marks, frame, depths, shares):
    """Share (v,) of the snow's depth that is left at a frame; None if nothing has pressed it.

    plan: work.Plan. marks: native SnowMarks of it. depths: (v,), heights() at that frame. shares: (v,), of the depths that lie there, or
    None for all.
    """
    if not marks:
        return None
    pressed, time = np.zeros_like(depths), frame - plan.marks.start
    for one in marks:
        np.maximum(pressed, one.pressed(time, depths, shares), out=pressed)
    return np.clip(1.0 - pressed / np.where(depths > 0.0, depths, 1.0), 0.0, 1.0)
