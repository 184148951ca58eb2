"""Mesh objects that a solver reads, of its own settings and of collections, each where it is seen."""

from typing import Any, NamedTuple

from mathutils import Matrix

from ..evaluated.question import answered
from . import meshes, stillness


class Seen(NamedTuple):
    """One occurrence of an evaluated mesh object in the scene: the object itself, or an instance of it.

    matrix: world matrix of the occurrence. objects: the mesh object, followed by the empties that instance it.
    """

    matrix: Any
    objects: tuple

    def moves(self, scene):
        """Whether the object may have another place or shape at another frame."""
        return any(stillness.moves(obj, scene) for obj in self.objects)

    @property
    def placed(self):
        """Faces of the object at the place of this instance, as a meshes.Placed; None if the object has no faces."""
        return meshes.placed(self.objects[0], self.matrix)


def awaited(members):
    """Objects that Blender has to evaluate before the Gathered `members` can be read: the mesh objects and their instancers."""
    return [one for each in members for one in (each.object, *each.instancers)]


def gathered(members, ready):
    """List of the Seen of those Gathered whose objects are evaluated. ready: {original: evaluated}, from wiring.waited_for()."""
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
    """The Seen in `found` that do not move over time. A parent that several objects share is examined once."""
    return answered(object(), lambda: [one for one in found if not one.moves(scene)])


def matrix(each, ready):
    """World matrix of a Gathered object or instance. ready: {original object: evaluated object}."""
    found = ready[each.object].matrix_world
    for instancer in reversed(each.instancers):
        found = ready[instancer].matrix_world @ Matrix.Translation(-instancer.instance_collection.instance_offset) @ found
    return found
