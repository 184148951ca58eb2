"""The mesh objects of a collection, with those of the collections that empties in it instance."""

from typing import Any, NamedTuple

DEEPEST = 16
"""Empties that instance collections within each other. What lies deeper is taken for a loop."""


class Gathered(NamedTuple):
    """An original mesh object that was found in a collection, directly or through collection instances.

    instancers: empties that instance the collections in which it was found, outermost first; empty for a direct member.
    """

    object: Any
    instancers: tuple


def meshes(collection, leaves_out=lambda _obj: False, above=()):
    """Yields a Gathered for each mesh object in a collection and in collections that its empties instance, hidden objects included.

    leaves_out(obj): whether an object is skipped. above: empties through which `collection` itself is instanced.
    A collection read from evaluated settings is evaluated, and so are the collections within it. Solvers, which run in threads, have
    to use these, since the main thread may edit the originals at the same time.
    """
    for obj in collection.all_objects:
        if obj.type == 'MESH':
            if not leaves_out(obj):
                yield Gathered(obj.original, above)
        elif obj.type == 'EMPTY' and obj.instance_type == 'COLLECTION' and obj.instance_collection and len(above) < DEEPEST:
            yield from meshes(obj.instance_collection, leaves_out, (*above, obj.original))
