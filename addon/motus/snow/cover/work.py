"""Work: the part of a snow cover's computation that is done once. It finds where all flakes land, and how snow then lies at any time.

If this takes long, the viewport waits for an operator with a progress bar, and shows the last result meanwhile. A render computes the
result at once.
"""

from typing import Any, NamedTuple

from ...core import keeping, native
from ...core.declare import Problem
from ...core.evaluated.shares import waits_for_all
from ...core.measures import bounds
from .. import flakes
from . import ground, marks, shelf

KEPT, MOST_KEPT = 2, 64
"""Most results (Work) that are kept for one cover, and for all covers together."""
MOST_FLAKES = 10_000_000
"""Most flakes that may fall from one emitter until the end of the scene."""
MOST_FLAKES_KEPT = 3 * MOST_FLAKES
"""Most flakes of all results that are kept together, at about 40 bytes for each flake."""
FLAKE, FLIGHT, TRIANGLE, ROUND = 40.0, 4.0, 2.0, 0.01
"""Prices of a flake, of each second that it flies, of a triangle, and of a vertex in a round of smoothing.

A price is about a microsecond, see core/measures/bounds.py.
"""
LONG = bounds.AT_ONCE
"""Price of the work above which the viewport waits until the artist runs the operator."""
PARTS = 24
MOST_ROUNDS = 400

TOO_FINE = Problem("The layer would have more than 2 million vertices: choose a coarser resolution, or fewer surfaces", blocking=False)
LESS_SMOOTH = Problem(
    "Snow spreads less far than Smoothing says, as the layer has so many vertices: choose a coarser resolution", blocking=False
)


class Fall(NamedTuple):
    """All that the flakes of one emitter are computed from; hashable.

    keywords, acceleration, poses, wind, rate, faces, angles: arguments of flakes.made(). count: approximate number of flakes.
    end: own time of the emitter up to which flakes count, in seconds. emitter: its name.
    """

    keywords: tuple
    acceleration: tuple
    poses: Any
    wind: Any
    rate: Any
    faces: Any
    angles: Any
    count: float  # type: ignore[assignment]  # a tuple has a method of this name
    end: float
    emitter: str


class Plan(NamedTuple):
    """Everything that a snow cover is computed from, except the time; hashable.

    lain_on, shelters: meshes that carry snow, and meshes that only shelter them. resolution: edge length of the refined surface, m.
    up: direction against gravity. falls: a Fall for each emitter. volume: volume of the snow that one flake adds, m^3.
    repose: angle of repose, radians. smoothing: number of rounds of smoothing. share: of the limit of work, that the smoothing has on each
    frame. marks: marks.Marks, or None.
    """

    lain_on: tuple
    shelters: tuple
    resolution: float
    up: tuple
    falls: tuple
    volume: float
    repose: float
    smoothing: int
    share: float = 1.0
    marks: Any = None


class Work(NamedTuple):
    """Result of computing a Plan.

    ground: Ground of the cover. covers: native SnowCover of each Fall. fault: Problem to show, or None. marks: tuple of native SnowMarks.
    """

    ground: Any
    covers: tuple
    fault: Any
    marks: tuple = ()


_done = keeping.OfFile(
    "results of the computation of snow covers (Work), or the cover's Problem",
    f"name of the cover's object, and Plan (all inputs of the computation); {KEPT} for each cover",
    MOST_KEPT,
    MOST_FLAKES_KEPT,
    lambda place, _: sum(fall.count for fall in place[1].falls),
    "flakes",
)
_asked = keeping.OfFile(
    "Plans of snow covers that the viewport shows as soon as they are computed",
    "name of the cover's object",
    most=1024,
    until="the cover is computed, or a different file is opened",
)


def may_wait(depsgraph, owner):
    """Whether an evaluated cover may be shown before it is computed: in a viewport, if it is not linked.

    The operator that computes a cover does not work on linked ones.
    """
    return not waits_for_all(depsgraph) and owner.library is None


def is_too_fine(plan):
    """Whether the layer of a plan would certainly have too many vertices; the layer is not made to find this out."""
    # There are two triangles for each vertex, and no triangle is larger than an equilateral one whose sides are the resolution.
    return sum(one.area for one in plan.lain_on) > ground.MOST * plan.resolution**2


def price(plan):
    """Approximate price of computing a plan without its marks: about its microseconds (see core/measures/bounds.py)."""
    triangles = sum(len(one.faces.triangles) for one in (*plan.lain_on, *plan.shelters))
    return sum(map(_price, plan.falls)) + TRIANGLE * (triangles + min(4 * ground.MOST, _refined(plan.lain_on, plan.resolution)))


def remaining(name, plan):
    """Approximate price of what is not computed yet of a plan (see core/measures/bounds.py). name: of the cover's object."""
    found = 0.0 if _unmarked(name, plan) else price(plan)
    if plan.marks is None:
        return found
    vertices = min(ground.MOST, 0.5 * _refined(plan.lain_on, plan.resolution))
    depths = ROUND * vertices * plan.smoothing * len(plan.falls) * len(plan.marks.times)
    return found + depths + marks.price(plan.marks, vertices, plan.resolution)


def _unmarked(name, plan):
    """The kept Work of a plan that differs from this one in nothing but its marks; None if there is none. name: of the cover's object."""
    place = name, plan._replace(marks=None)
    for (whose, one), found in _done.items():
        other = whose, one._replace(marks=None)
        # Parts of two plans can be compared if their hashes are equal: a rate may be a number or Rates.
        if isinstance(found, Work) and hash(other) == hash(place) and other == place:
            return found
    return None


def _refined(lain_on, resolution):
    """Approximate number of triangles of a layer on meshes."""
    # Edges are halved until none is longer than the resolution; on average their length is 0.6 times the resolution.
    return 2.0 * sum(one.area for one in lain_on) / (0.6 * resolution) ** 2


def share_of_smoothing(lain_on, resolution, rounds, share):
    """Share of the limit of work that the smoothing of a cover has on each frame: 1.0 if it needs far less than the cover's share.

    So most covers need not be computed again if a different cover is added to the scene. rounds: of all emitters together. share: the
    cover's, see core/evaluated/shares.py.
    """
    triangles = sum(len(one.faces.triangles) for one in lain_on) + _refined(lain_on, resolution)
    return 1.0 if 2.0 * ROUND * min(ground.MOST, triangles) * rounds < bounds.AT_ONCE * share else share


def _price(fall):
    return fall.count * (FLAKE + FLIGHT * min(dict(fall.keywords)["lifetime"], max(0.0, fall.end)))


def known(name, plan):
    """Return the kept Work of a plan, or the Problem that computing it gave; None if it was not computed. name: of the cover's object."""
    return _done.find((name, plan))


def latest(name):
    """Return the (Plan, Work) that was computed last for a cover; None if there is none. name: name of the cover's object."""
    return next(((plan, found) for (whose, plan), found in reversed(_done.items()) if whose == name and isinstance(found, Work)), None)


def rounds(smoothing, resolution):
    """Number of rounds of the library's smoothing in which snow spreads over a distance.

    In a round half of a vertex's snow goes to its neighbours, along edges whose length is about three quarters of the resolution.
    smoothing: the distance, m. resolution: longest edge of the layer, m.
    """
    return min(MOST_ROUNDS, round((2.0 * smoothing / (0.75 * resolution)) ** 2))


def ask(name, plan):
    """Record that a cover has to wait until the user runs the operator that computes its plan. name: name of the cover's object."""
    _asked.add(name, plan)


def asked(name):
    """Return the plan that a cover waits for; None if it does not wait. name: name of the cover's object."""
    return _asked.get(name)


def do(name, plan):
    """Return the Work of a plan, which is computed now if it is not kept; a Problem if it cannot be computed.

    name: name of the cover's object.
    """
    found = known(name, plan)
    if found is None:
        for _ in steps(name, plan):
            pass
        found = known(name, plan)
    return found


def steps(name, plan):
    """Compute a plan in parts and keep the result; yields the number of parts done, of part_count(). name: of the cover's object."""
    found = _unmarked(name, plan) or (yield from _steps(plan))
    if isinstance(found, Work):
        found = found._replace(marks=(yield from _marked(plan, found)))
    _done.add((name, plan), found)
    for place in [place for place, _ in _done.items() if place[0] == name][:-KEPT]:
        _done.drop(place)
    if _asked.get(name) == plan:
        _asked.drop(name)


def part_count(plan):
    """Number of parts in which the cover's computation is done, for the progress of an operator."""
    return 1 + (PARTS + 1) * len(plan.falls) + (marks.part_count(plan.marks) if plan.marks else 0)


def _steps(plan):
    place = ground.made(plan.lain_on, plan.shelters, plan.resolution, plan.up, plan.repose)
    if place is None:
        return TOO_FINE
    done, covers = 1, []
    # The snow of each Fall is smoothed anew on each frame, in the time that a frame has.
    smoothing = min(plan.smoothing, bounds.times(ROUND * place.vertex_count * len(plan.falls), plan.share))
    yield done
    for fall in plan.falls:
        cover = shelf.find(plan, fall, smoothing, place.vertex_count)
        if cover is None:
            cover = yield from _covered(place, plan, fall, smoothing, done)
            if isinstance(cover, Problem):
                return cover
            shelf.put(plan, fall, smoothing, cover)
        covers.append(cover)
        done += PARTS + 1
        yield done
    return Work(place, tuple(covers), LESS_SMOOTH if smoothing < plan.smoothing else None)


def _marked(plan, found):
    """Compute the marks of a plan; returns a tuple of native SnowMarks, and yields the number of parts done. found: Work without marks."""
    if plan.marks is None:
        return ()
    done, parts = part_count(plan._replace(marks=None)), marks.steps(plan, found.ground, found.covers)
    while True:
        try:
            next(parts)
        except StopIteration as end:
            return end.value
        done += 1
        yield done


def _covered(place, plan, fall, smoothing, done):
    """Compute the native SnowCover of one Fall; returns it, or a Problem, and yields the number of parts done, `done` of which were before.

    place: Ground. smoothing: rounds of smoothing.
    """
    snow = flakes.made(fall.keywords, fall.acceleration, fall.poses, fall.wind, fall.rate, fall.faces, fall.angles, place.collider)
    if isinstance(snow, Problem):
        return snow
    try:
        for part in _landed(snow, fall):
            yield done + part
        return native.module.SnowCover(snow, end=fall.end, flake_volume=plan.volume, repose=plan.repose, smoothing=smoothing)
    except ValueError:
        return flakes.OUT_OF_RANGE


def _landed(snow, fall):
    """Let a native Snow find and keep the landing places of a Fall's flakes, in PARTS parts; yields the number of parts done.

    A short search is not done in parts, but when the native SnowCover is made: then this yields nothing.
    """
    start = dict(fall.keywords)["delay"]
    for part in range(PARTS if _price(fall) > LONG else 0):
        snow.landings(start + (fall.end - start) * (part + 1) / PARTS)
        yield part + 1
