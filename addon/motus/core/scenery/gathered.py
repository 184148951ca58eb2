"""Mesh objects of a collection, and of the collections that empties in the collection instance."""

from typing import Any, NamedTuple

DEEPEST = 16
"""Most collection instances within each other. Deeper ones are taken for a loop and left out."""


class Gathered(NamedTuple):
    """An original mesh object that was found in a collection, directly or through collection instances.

    instancers: original empties that instance the collections in which the object was found, outermost first; empty for a direct member.
    """

    object: Any
    instancers: tuple


def meshes(collection, leaves_out=lambda _obj: False, above=()):
    """Yields a Gathered for each mesh object in a collection and in collections that its empties instance, hidden objects included.

    leaves_out(obj): whether an object is skipped. above: empties through which `collection` itself is instanced.
    If the collection is read from evaluated settings, it and all collections within it are evaluated. Solvers, which run in threads,
    must use evaluated collections, since the main thread may edit the originals at the same time.
    """
    for obj in collection.all_objects:
        if obj.type == 'MESH':
            if not leaves_out(obj):
                yield Gathered(obj.original, above)
        elif obj.type == 'EMPTY' and obj.instance_type == 'COLLECTION' and obj.instance_collection and len(above) < DEEPEST:
            yield from meshes(obj.instance_collection, leaves_out, (*above, obj.original))
