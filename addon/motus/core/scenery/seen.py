"""Occurrences of mesh objects in a scene that a solver reads: objects that settings name, and objects and instances in collections."""

from typing import Any, NamedTuple

from mathutils import Matrix

from ..evaluated.question import answered
from . import meshes, stillness


class Seen(NamedTuple):
    """One occurrence of an evaluated mesh object in the scene: the object itself, or an instance of it.

    matrix: world matrix of the occurrence. objects: the evaluated mesh object, followed by the evaluated empties that instance it.
    """

    matrix: Any
    objects: tuple

    def moves(self, scene):
        """Whether this occurrence may have a different place or shape at another frame: whether the mesh object or an instancer moves."""
        return any(stillness.moves(obj, scene) for obj in self.objects)

    @property
    def placed(self):
        """Faces of the mesh object at the place of this occurrence, as a meshes.Placed; None if the object has no faces."""
        return meshes.placed(self.objects[0], self.matrix)


def awaited(members):
    """Objects that Blender has to evaluate before the Gathered `members` can be read: the mesh objects and their instancers."""
    return [one for each in members for one in (each.object, *each.instancers)]


def gathered(members, ready):
    """List of a Seen for each Gathered in `members` whose objects are evaluated. ready: {original: evaluated}, from wiring.waited_for()."""
    found = []
    for each in members:
        objects = ready.get(each.object), *map(ready.get, each.instancers)
        # An object that came into the collection after the solver's driver was added may not be evaluated.
        if None not in objects:
            found.append(Seen(matrix(each, ready), objects))
    return found


def alone(obj):
    """A Seen for an evaluated mesh object that a setting names directly."""
    return Seen(obj.matrix_world, (obj,))


def still(found, scene):
    """List of those Seen in `found` that do not move over time. A parent that several objects share is examined once."""
    return answered(object(), lambda: [one for one in found if not one.moves(scene)])


def matrix(each, ready):
    """World matrix of a Gathered: of the object itself, or of its instance. ready: {original object: evaluated object}."""
    found = ready[each.object].matrix_world
    for instancer in reversed(each.instancers):
        found = ready[instancer].matrix_world @ Matrix.Translation(-instancer.instance_collection.instance_offset) @ found
    return found
