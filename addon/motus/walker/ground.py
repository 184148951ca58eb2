"""What a walker's feet stand on: meshes that stand still, beside the plane."""

from ..core import native, tracks, wiring
from ..core.declare import Problem, has_settings, is_owner, leader_of, registered
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.scenery import gathered, meshes, seen

GONE = Problem("The ground is gone: choose another one", blocking=False)
NO_FACES = Problem("The ground has no faces", blocking=False)
MOVING = Problem("Ground that may move is left out: feet do not stand on it", blocking=False)
PROBLEMS = GONE, NO_FACES, MOVING

DEEPEST = 64
"""Parents above each other that are looked through."""


def objects(settings):
    """The objects that have to be evaluated before a walk is planned: meshes, and the empties that make collections' objects visible."""
    ground = pointed(settings, "ground")
    alone = [] if ground is None or _leaves_out(settings)(ground) else [ground]
    return alone + seen.awaited(_members(settings))


def parts(settings, scene):
    """Collect the ground of a walker: (Placed of each mesh that stands still, the Problem to show or None).

    settings: evaluated walker settings, with the ground's object and collection.
    """
    ready = wiring.waited_for(settings)
    found, fault = seen.gathered(_members(settings), ready), None
    ground = pointed(settings, "ground")
    if ground is not None:
        ground = ready.get(ground.original)
        if ground is None or deleted.is_deleted(ground):
            fault = GONE
        else:
            found.append(seen.alone(ground))
    still = seen.still(found, scene)
    fault = fault or (MOVING if len(still) < len(found) else None)
    placed = tuple(filter(None, (one.placed for one in still)))
    is_named = ground is not None or pointed(settings, "grounds") is not None
    return placed, fault or (NO_FACES if is_named and not placed else None)


def made(placed, plane):
    """The native WalkerGround of what is Placed, and of a level plane of a height, or None without."""
    ground = tracks.kept_by(tuple(one.stamp for one in placed), "walker ground", lambda: _made(placed))
    return ground if plane is None else ground.with_plane(np.array([(0.0, 0.0, plane), (0.0, 0.0, 1.0)]))


def _made(placed):
    return native.module.WalkerGround(*(meshes.joined(placed) if placed else ()))


def _members(settings):
    collection = pointed(settings, "grounds")
    return [] if collection is None else list(gathered.meshes(collection, _leaves_out(settings)))


def _leaves_out(settings):
    """A function that tells which objects are no ground: parts of this walker (its feet too while it is being wired) and of other walkers."""
    feet = {foot.original for foot in (pointed(leg, "foot") for leg in settings.legs) if foot}
    return lambda obj: is_walking(obj, feet)


def is_walking(obj, feet=frozenset()):
    """Whether an object belongs to a walker and is no ground: ground that moves with the walker would form a dependency cycle.

    feet: original objects that count as parts of a walker, whether it is set up or not.
    """
    walker = registered["walker"]
    for modifier in obj.modifiers:
        if modifier.type == 'ARMATURE' and modifier.object and _is_part(walker, modifier.object, feet):
            return True
    for _ in range(DEEPEST):
        if obj is None:
            return False
        if _is_part(walker, obj, feet):
            return True
        obj = obj.parent
    return True


def _is_part(walker, obj, feet):
    return (has_settings(walker, obj) and (is_owner(walker, obj) or leader_of(walker, obj) is not None)) or obj.original in feet
