"""The mesh objects of a collection, with those of the collections that empties in it instance."""

from typing import Any, NamedTuple

DEEPEST = 16
"""Empties that instance collections within each other. What lies deeper is taken for a loop."""


class Gathered(NamedTuple):
    """A mesh object, original.

    instancers: the empties by which it is seen, the outermost first; none where it stands in the collection.
    """

    object: Any
    instancers: tuple


def meshes(collection, leaves_out=lambda _obj: False, above=()):
    """Yields what is Gathered of a collection, hidden objects too. leaves_out: says which objects do not count.

    The collection of an evaluated pointer is evaluated too, and those within it: solvers, which run in threads, go through
    these, since the main thread may edit the originals meanwhile.
    """
    for obj in collection.all_objects:
        if obj.type == 'MESH':
            if not leaves_out(obj):
                yield Gathered(obj.original, above)
        elif obj.type == 'EMPTY' and obj.instance_type == 'COLLECTION' and obj.instance_collection and len(above) < DEEPEST:
            yield from meshes(obj.instance_collection, leaves_out, (*above, obj.original))
