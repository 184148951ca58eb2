"""The work that is done once: where all flakes land, and how snow lies by that at any time.

On frames that are shown what takes long is left to an operator with progress, and what was worked out before stays meanwhile; frames
that are rendered have it done at once.
"""

from typing import Any, NamedTuple

from ...core import keeping, native
from ...core.declare import Problem
from ...core.measures import bounds
from .. import flakes
from . import ground

KEPT, MOST_KEPT = 2, 64
"""Works of one cover, and of all."""
MOST_FLAKES = 10_000_000
"""That fall until the end."""
MOST_FLAKES_KEPT = 3 * MOST_FLAKES
"""Of all works: some 40 bytes each."""
FLAKE, FLIGHT, TRIANGLE, ROUND = 40.0, 4.0, 2.0, 0.01
"""Prices (core/measures/bounds.py) of a flake, each second that it flies, a triangle, and a vertex in a round of smoothing."""
LONG = bounds.AT_ONCE
"""The price of work from which on the viewport waits for the artist to ask for it."""
PARTS = 24
MOST_ROUNDS = 400

TOO_FINE = Problem("The layer would have more than 2 million vertices: choose a coarser resolution, or fewer surfaces", blocking=False)
LESS_SMOOTH = Problem(
    "Snow spreads less far than Smoothing says, as the layer has so many vertices: choose a coarser resolution", blocking=False
)


class Fall(NamedTuple):
    """What falls from one emitter.

    keywords: of flakes.made(). count: of flakes, about. end: seconds of its time, which starts at a frame, up to which
    flakes count.
    """

    keywords: tuple
    acceleration: tuple
    poses: Any
    wind: Any
    faces: Any
    angles: Any
    count: float  # type: ignore[assignment]  # a tuple has a method of this name
    end: float
    start_frame: float


class Plan(NamedTuple):
    """Everything that a snow cover is computed from, except the time; hashable.

    lain_on, shelters: meshes that carry snow, and meshes that only shelter them. resolution: edge length of the refined surface, m.
    up: direction against gravity. falls: a Fall for each emitter. volume: of the snow of one flake, m^3.
    repose: angle of repose, radians. smoothing: rounds of smoothing.
    """

    lain_on: tuple
    shelters: tuple
    resolution: float
    up: tuple
    falls: tuple
    volume: float
    repose: float
    smoothing: int


class Work(NamedTuple):
    """ground: what snow lies on. covers: the native SnowCover of each fall. fault: Problem or None."""

    ground: Any
    covers: tuple
    fault: Any


_done = keeping.OfFile(
    "how snow lies (Work), or what is wrong with it",
    f"name of the cover's object, Plan; {KEPT} for each cover",
    MOST_KEPT,
    MOST_FLAKES_KEPT,
    lambda place, _: sum(fall.count for fall in place[1].falls),
    "flakes",
)
_asked = keeping.OfFile(
    "the Plan of a snow cover that the viewport waits for",
    "name of the cover's object",
    most=1024,
    until="it is worked out, or another file is opened",
)


def may_wait(depsgraph, owner):
    """Whether a cover, evaluated, is shown on the way to what it will be, and somebody can ask for the work."""
    return depsgraph.mode == 'VIEWPORT' and owner.library is None


def is_too_fine(plan):
    """Whether the layer is sure to have too many vertices, which can be told without making it."""
    # Each vertex has two triangles, which are no larger than those whose sides are all of that length.
    return sum(one.area for one in plan.lain_on) > ground.MOST * plan.resolution**2


def price(plan):
    """Rough price of the whole work (see core/measures/bounds.py)."""
    triangles = sum(len(one.faces.triangles) for one in (*plan.lain_on, *plan.shelters))
    # Edges are halved: on the average they end up 0.6 times as long as the longest.
    refined = 2.0 * sum(one.area for one in plan.lain_on) / (0.6 * plan.resolution) ** 2
    return sum(map(_price, plan.falls)) + TRIANGLE * (triangles + min(4 * ground.MOST, refined))


def _price(fall):
    return fall.count * (FLAKE + FLIGHT * min(dict(fall.keywords)["lifetime"], max(0.0, fall.end)))


def known(name, plan):
    """The Work of a plan of the cover of a name, or what is wrong with it, if it was done before; else None."""
    return _done.find((name, plan))


def latest(name):
    """(Plan, Work) of what was done last for the cover of a name; None without."""
    return next(((plan, found) for (whose, plan), found in reversed(_done.items()) if whose == name and isinstance(found, Work)), None)


def rounds(smoothing, resolution):
    """Rounds of the library's smoothing by which snow spreads about so far, on a layer of a resolution.

    In a round half of a vertex's snow goes to its neighbours, edges away that are some three quarters of the resolution long.
    """
    return min(MOST_ROUNDS, round((2.0 * smoothing / (0.75 * resolution)) ** 2))


def ask(name, plan):
    """Note that the cover of a name waits for a plan."""
    _asked.add(name, plan)


def asked(name):
    """The plan that the cover of a name waits for; None where it waits for nothing."""
    return _asked.get(name)


def do(name, plan):
    """The Work of a plan, or what is wrong with it."""
    found = known(name, plan)
    if found is None:
        for _ in steps(name, plan):
            pass
        found = known(name, plan)
    return found


def steps(name, plan):
    """Do the work of a plan in parts; yields how many of part_count() are done."""
    found = yield from _steps(plan)
    _done.add((name, plan), found)
    for place in [place for place, _ in _done.items() if place[0] == name][:-KEPT]:
        _done.drop(place)
    if _asked.get(name) == plan:
        _asked.drop(name)


def part_count(plan):
    """Number of parts in which the cover's computation is done, for the progress of an operator."""
    return 1 + (PARTS + 1) * len(plan.falls)


def _steps(plan):
    place = ground.made(plan.lain_on, plan.shelters, plan.resolution, plan.up, plan.repose)
    if place is None:
        return TOO_FINE
    done, covers = 1, []
    # On each frame every fall's snow is smoothed anew.
    smoothing = min(plan.smoothing, bounds.times(ROUND * place.vertex_count * len(plan.falls)))
    yield done
    for fall in plan.falls:
        snow = flakes.made(fall.keywords, fall.acceleration, fall.poses, fall.wind, fall.faces, fall.angles, place.collider)
        if isinstance(snow, Problem):
            return snow
        try:
            for part in _landed(snow, fall):
                yield done + part
            covers.append(native.module.SnowCover(snow, end=fall.end, flake_volume=plan.volume, repose=plan.repose, smoothing=smoothing))
        except ValueError:
            return flakes.OUT_OF_RANGE
        done += PARTS + 1
        yield done
    return Work(place, tuple(covers), LESS_SMOOTH if smoothing < plan.smoothing else None)


def _landed(snow, fall):
    """Have the snow find where its flakes land, which it keeps; yields after each of PARTS, where that takes long."""
    start = dict(fall.keywords)["delay"]
    for part in range(PARTS if _price(fall) > LONG else 0):
        snow.landings(start + (fall.end - start) * (part + 1) / PARTS)
        yield part + 1
