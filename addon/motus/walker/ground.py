"""Ground of a walker: the meshes that its feet stand on. Only meshes that do not move count, in addition to a level plane."""

from ..core import native, tracks, wiring
from ..core.declare import Problem, has_settings, is_owner, leader_of, registered
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.scenery import gathered, meshes, seen
from . import carrier

GONE = Problem("The ground is gone: choose another one", blocking=False)
NO_FACES = Problem("The ground has no faces", blocking=False)
MOVING = Problem("Ground that may move is left out: feet do not stand on it", blocking=False)
NOT_CARRIED = Problem("Ground that does not go along with the carrier is left out: feet do not stand on it", blocking=False)
CARRIER_GONE = Problem("The carrier is gone: choose another one", blocking=False)
PROBLEMS = GONE, NO_FACES, MOVING, NOT_CARRIED, CARRIER_GONE

DEEPEST = 64
"""Most parents, one above the other, that is_walking() goes through."""


def objects(settings):
    """List the objects that Blender has to evaluate before a walk is planned.

    They are the meshes of the ground, and the empties that instance collections with such meshes. settings: of a walker.
    """
    ground = pointed(settings, "ground")
    alone = [] if ground is None or _leaves_out(settings)(ground) else [ground]
    return alone + seen.awaited(_members(settings))


def parts(settings, scene):
    """Collect the ground of a walker; returns (tuple of meshes.Placed, Problem to show or None).

    A Placed is a triangle mesh with its world matrix, or its matrix in the space of the walker's carrier. Each ground mesh that does not
    move over time, or in this space, gives one.
    settings: evaluated settings of the walker, which name the ground's object and collection.
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
    placed = _placed(found, settings, scene)
    if carrier.is_gone(settings):
        fault = CARRIER_GONE
    elif len(placed) < len(found):
        fault = fault or (MOVING if carrier.of(settings) is None else NOT_CARRIED)
    placed = tuple(filter(None, placed))
    is_named = ground is not None or pointed(settings, "grounds") is not None
    return placed, fault or (NO_FACES if is_named and not placed else None)


def _placed(found, settings, scene):
    """List the Placed of each Seen that does not move, None if it has no faces; with a carrier, of each that goes along with it."""
    carried_by = carrier.of(settings)
    if carried_by is None:
        return [one.placed for one in seen.still(found, scene)]
    track = carrier.track_of(settings.id_data, scene)
    alone = [one.objects[0] for one in found if len(one.objects) == 1]
    return [placed for placed in (carrier.placed(obj, carried_by, track, scene) for obj in alone) if placed]


def made(placed, plane):
    """Make the native WalkerGround of ground meshes and a level plane.

    placed: tuple of meshes.Placed (a triangle mesh with its world matrix). plane: height of the plane, or None if there is no plane.
    """
    ground = tracks.kept_by(tuple(one.stamp for one in placed), "walker ground", lambda: _made(placed))
    return ground if plane is None else ground.with_plane(np.array([(0.0, 0.0, plane), (0.0, 0.0, 1.0)]))


def _made(placed):
    return native.module.WalkerGround(*(meshes.joined(placed) if placed else ()))


def _members(settings):
    collection = pointed(settings, "grounds")
    return [] if collection is None else list(gathered.meshes(collection, _leaves_out(settings)))


def _leaves_out(settings):
    """Return a function that tells whether an object is no ground because it is a part of a walker.

    The feet that these settings name count as parts even if the walker has not been wired yet.
    """
    feet = {foot.original for foot in (pointed(leg, "foot") for leg in settings.legs) if foot}
    return lambda obj: is_walking(obj, feet)


def is_walking(obj, feet=frozenset()):
    """Whether an object moves with a walker, so that it cannot be ground: as ground it would form a dependency cycle.

    An object moves with a walker if the object, one of its parents, or the armature that deforms it is the walker or a part of it.
    feet: original objects that count as feet, even if no walker drives them yet.
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
