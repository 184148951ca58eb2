"""Colliders, which flakes land on: meshes that do not move, carriers, or meshes as they were recorded on one frame.

The place where a flake lands is found once, for all frames. Carriers are meshes that go from place to place as they are, in a way that is
known at all times: flakes that land there are carried along. Any other mesh that moves can be a collider only if it is recorded: otherwise
all flakes that ever landed would lie at different places on each frame.
"""

from typing import Any, NamedTuple

import bpy
from mathutils import Matrix

from ..core import wiring
from ..core.blender import datablocks, helpers
from ..core.declare import Problem, is_owner, registered
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.scenery import gathered, seen, stillness
from ..core.scenery.meshes import Placed, faces, hash_of, is_same, joined, placed
from ..core.settings import lists
from . import births, flakes

GONE = Problem("The collider is gone: flakes fall on without it", blocking=False)
NO_FACES = Problem("The collider has no faces: flakes fall through it", blocking=False)
MOVING = Problem("Flakes fall through colliders that may move, until Record Colliders keeps them as on one frame", blocking=False)
PROBLEMS = GONE, NO_FACES, MOVING

NAME = "Motus Colliders"


def are_any(settings):
    """Whether an emitter's settings name any collider, single, in a collection or recorded; the level ground does not count."""
    return bool(alone(settings)) or any(pointed(settings, name) is not None for name in ("colliders", "recorded"))


def alone(settings):
    """List the collider objects that an emitter's settings name one by one, each once, without the collection."""
    named = [pointed(settings, "collider"), *(pointed(entry, "object") for entry in settings.more_colliders)]
    return list(dict.fromkeys(obj for obj in named if obj is not None))


def objects(settings):
    """List the objects that Blender has to evaluate before flakes can land.

    They are the recorded mesh, or else the collider objects and the empties that instance collections with colliders.
    """
    recorded = pointed(settings, "recorded")
    if recorded is not None:
        return [recorded]
    return alone(settings) + seen.awaited(_members(settings))


class Carrier(NamedTuple):
    """A collider that moves. stamp: hashable value that changes with it. collider: native SnowCollider in the object's own space.

    seconds: (k,), of the snow's own time, rising. matrices: (k, 4, 4), to world space.
    """

    stamp: Any
    collider: Any
    seconds: Any
    matrices: Any

    __eq__, __hash__ = is_same, hash_of  # type: ignore[misc]


def barrier(context, clock, loop, longest):
    """Return (native SnowCollider of an emitter's colliders that stand still or None, Carriers, Problem to show or None).

    context: Context of the solver. clock, loop: Clock of the snow, and Loop or None. longest: most own seconds that a flake lives.
    """
    settings, scene, carriers = context.settings, context.depsgraph.scene, ()
    if pointed(settings, "recorded") is not None:
        found, fault = parts(settings, scene)
    else:
        still, moving, fault = _split(settings, scene)
        found = _placed(still)
        known = [one for one in moving if _is_carrier(one, scene)]
        carriers = tuple(filter(None, (_carrier(one, scene, context.frame, clock, loop, longest) for one in known)))
        fault = fault or (MOVING if len(known) < len(moving) else None)
    return (flakes.collider(found) if found else None), carriers, fault or (None if found or carriers else NO_FACES)


def _is_carrier(one, scene):
    """Whether a moving Seen goes from place to place as it is, in a way that is known at all times."""
    return len(one.objects) == 1 and not stillness.deforms(one.objects[0], scene) and births.track(one.objects[0], scene).is_known


def _carrier(one, scene, frame, clock, loop, longest):
    """The Carrier of a Seen; None if it has no faces, or is at no finite place. frame, clock, loop, longest: as in births.going()."""
    found = faces(one.objects[0])
    poses = found and births.going(births.track(one.objects[0], scene), frame, longest, clock, loop)
    own = poses and flakes.collider((Placed((found.stamp, "own"), found, Matrix()),))
    return own and Carrier((found.stamp, poses.stamp), own, poses.seconds, poses.matrices)


def parts(settings, scene, left_out=()):
    """Return (tuple of meshes.Placed, Problem to show or None): the colliders that do not move, or the recorded ones.

    A Placed is a triangle mesh with its world matrix. settings: evaluated settings of an emitter.
    left_out: original objects that do not count as colliders.
    """
    recorded = pointed(settings, "recorded")
    if recorded is not None:
        kept = _recorded(recorded, left_out)
        return (() if kept is None else (kept,)), None
    still, moving, fault = _split(settings, scene, left_out)
    return _placed(still), fault or (MOVING if moving else None)


def _placed(still):
    return tuple(filter(None, (one.placed for one in still)))


def _split(settings, scene, left_out=()):
    """Return ([seen.Seen] that keep place and shape, [seen.Seen] that may not, Problem or None); arguments as of parts()."""
    found, fault = _found(settings)
    found = [one for one in found if one.objects[0].original not in left_out]
    still = seen.still(found, scene)
    return still, [one for one in found if one not in still], fault


def record(emitter, view_layer):
    """Record the colliders of an emitter as they are now: flakes land on this copy, whatever the colliders do later.

    Returns whether the colliders have any faces; if not, an earlier recording stays.
    """
    settings = emitter.motus.snow
    # With a recording the emitter does not wait for the colliders, so that Blender may not evaluate them.
    before, settings.recorded = pointed(settings, "recorded"), None
    view_layer.update()
    found = [(one.objects[0].original, one.placed) for one in _found(emitter.evaluated_get(view_layer.depsgraph).motus.snow)[0]]
    found = [(obj, part) for obj, part in found if part is not None]
    if not found:
        settings.recorded = before
        return False
    kept = helpers.make(NAME, _mesh(*joined([part for _, part in found])))
    for obj, part in found:
        entry = lists.add_numbered(kept.motus.snow.recorded_of, "Collider")
        entry.object, entry.count = obj, len(part.faces.triangles)
    settings.recorded = kept
    _drop(before)
    return True


def _mesh(positions, triangles):
    mesh = bpy.data.meshes.new(NAME)
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(triangles), 3, np.int32))
    mesh.update(calc_edges=True)
    return mesh


def forget(emitter):
    """Drop an emitter's recorded colliders, so that flakes land on the colliders themselves again.

    The recorded mesh is removed from the file if no other emitter uses it.
    """
    settings = emitter.motus.snow
    kept = pointed(settings, "recorded")
    if kept is not None:
        settings.recorded = None
        _drop(kept)


def _drop(kept):
    if kept is not None and kept.library is None and kept.users == 0:
        datablocks.remove_objects([kept])


def _recorded(kept, left_out):
    """Return the recorded mesh as meshes.Placed, without the faces of some colliders; None if no face remains.

    left_out: original objects whose faces are left out.
    """
    found = placed(kept, kept.matrix_world)
    entries = kept.motus.snow.recorded_of if kept.is_property_set("motus") else ()
    counts = [entry.count for entry in entries]
    # In a damaged file the counts may not fit the mesh.
    if found is None or min(counts, default=-1) < 0 or sum(counts) != len(found.faces.triangles):
        return found
    sources = [pointed(entry, "object") for entry in entries]
    stays = [one is None or one.original not in left_out for one in sources]
    return found if all(stays) else found.chosen(np.repeat(stays, counts))


def _found(settings):
    """Return ([seen.Seen], Problem or None): each occurrence of the colliders themselves, not their recording.

    settings: evaluated settings of an emitter.
    """
    ready = wiring.waited_for(settings)
    found, fault = seen.gathered(_members(settings), ready), None
    for obj in alone(settings):
        collider = ready.get(obj.original)
        if collider is None or deleted.is_deleted(collider):
            fault = GONE
        else:
            found.append(seen.alone(collider))
    return found, fault


def _members(settings):
    collection = pointed(settings, "colliders")
    return [] if collection is None else list(gathered.meshes(collection, _is_snow))


def _is_snow(obj):
    """Whether an object is an emitter of snow or a snow cover, which cannot be a collider: its geometry depends on the colliders."""
    return any(is_owner(registered[name], obj) for name in ("snow", "snow_cover"))
