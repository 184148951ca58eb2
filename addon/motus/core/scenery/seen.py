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
        """The mesh object's triangles with the world matrix of this occurrence, as a meshes.Placed; None if the mesh has no faces."""
        return meshes.placed(self.objects[0], self.matrix)


def awaited(members):
    """Original objects that Blender has to evaluate before a solver reads meshes of a collection: these, and empties that instance them.

    members: a Gathered for each mesh object.
    """
    return [one for each in members for one in (each.object, *each.instancers)]


def gathered(members, ready):
    """A list with a Seen for each mesh object of a collection that is evaluated, together with the empties that instance it.

    members: a Gathered for each mesh object. ready: {original object: evaluated object}, from wiring.waited_for().
    """
    found = []
    for each in members:
        objects = ready.get(each.object), *map(ready.get, each.instancers)
        # An object that came into the collection after the solver's driver was added may not be evaluated.
        if None not in objects:
            found.append(Seen(matrix(each, ready), objects))
    return found


def alone(obj):
    """The Seen of an evaluated mesh object by itself, which is no instance, such as an object that a setting names."""
    return Seen(obj.matrix_world, (obj,))


def still(found, scene):
    """The mesh occurrences in a list of Seen that keep place and shape at all frames. A parent that several share is examined once."""
    return answered(object(), lambda: [one for one in found if not one.moves(scene)])


def matrix(each, ready):
    """World matrix at which a Gathered mesh object appears: its own, or that of its instance if empties instance its collection.

    ready: {original object: evaluated object}.
    """
    found = ready[each.object].matrix_world
    for instancer in reversed(each.instancers):
        found = ready[instancer].matrix_world @ Matrix.Translation(-instancer.instance_collection.instance_offset) @ found
    return found
