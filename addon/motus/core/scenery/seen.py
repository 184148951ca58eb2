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
        """Whether the object may have another place or shape at another frame."""
        return any(stillness.moves(obj, scene) for obj in self.objects)

    @property
    def placed(self):
        """The object's faces, Placed; None without faces."""
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
    """The Seen that do not move. Parents that several of them share are asked once."""
    return answered(object(), lambda: [one for one in found if not one.moves(scene)])


def matrix(each, ready):
    """World matrix of a Gathered object."""
    found = ready[each.object].matrix_world
    for instancer in reversed(each.instancers):
        found = ready[instancer].matrix_world @ Matrix.Translation(-instancer.instance_collection.instance_offset) @ found
    return found
