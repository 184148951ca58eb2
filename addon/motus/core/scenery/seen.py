"""Mesh objects that a solver reads, of its own settings and of collections, each where it is seen."""

from typing import Any, NamedTuple

from mathutils import Matrix

from ..evaluated.question import answered
from . import meshes, stillness


class Seen(NamedTuple):
    """An evaluated mesh where it is seen. objects: it, and the empties that instance it."""

    matrix: Any
    objects: tuple

    def moves(self, scene):
        """Whether it may stand elsewhere, or have another shape, on another frame."""
        return any(stillness.moves(obj, scene) for obj in self.objects)

    @property
    def placed(self):
        """Its faces, Placed; None where it has none."""
        return meshes.placed(self.objects[0], self.matrix)


def awaited(members):
    """Objects that have to be evaluated before what is Gathered can be seen."""
    return [one for each in members for one in (each.object, *each.instancers)]


def gathered(members, ready):
    """[Seen] of those Gathered that are evaluated. ready: {original: evaluated}, see wiring.waited_for."""
    found = []
    for each in members:
        objects = ready.get(each.object), *map(ready.get, each.instancers)
        # What has come into the collection since the owner was wired may not be evaluated.
        if None not in objects:
            found.append(Seen(matrix(each, ready), objects))
    return found


def alone(obj):
    """The Seen of an evaluated object that settings name."""
    return Seen(obj.matrix_world, (obj,))


def still(found, scene):
    """Those Seen that do not move. What several of them hang on is asked once."""
    return answered(object(), lambda: [one for one in found if not one.moves(scene)])


def matrix(each, ready):
    """Where what is Gathered stands."""
    found = ready[each.object].matrix_world
    for instancer in reversed(each.instancers):
        found = ready[instancer].matrix_world @ Matrix.Translation(-instancer.instance_collection.instance_offset) @ found
    return found
