"""Find the objects that a snow cover reads: surfaces, emitters, movers, and objects that shelter the surfaces from flakes.

The functions take the settings of an original or evaluated cover, and return original objects.
"""

from ...core.declare import is_owner, registered
from ...core.file import deleted
from ...core.file.pointers import pointed
from ...core.scenery import gathered
from .. import colliders
from ..solve import source


def _has(obj, name):
    return is_owner(registered[name], obj)


def is_surface(obj):
    """Whether snow can lie on an object: a mesh that is neither a snow cover nor an emitter of snow."""
    return obj.type == 'MESH' and not _has(obj, "snow_cover") and not _has(obj, "snow")


def is_surface_or_cover(obj):
    """Whether an object is a mesh that snow can lie on, or is a snow cover itself."""
    return obj.type == 'MESH' and not _has(obj, "snow")


def is_emitter(obj):
    """Whether an object is an emitter of snow."""
    return _has(obj, "snow")


def surfaces(settings):
    """List the surfaces that snow lies on, as gathered.Gathered (an original mesh object, with the empties that instance it).

    They come from the list and from the collection of a cover's settings. Deleted objects are left out.
    """
    listed = [one.original for one in (pointed(entry, "object") for entry in settings.surfaces) if one]
    found = [gathered.Gathered(obj, ()) for obj in listed]
    if pointed(settings, "collection"):
        found += gathered.meshes(pointed(settings, "collection"), lambda obj: not is_surface(obj))
    return [one for one in dict.fromkeys(found) if is_surface(one.object) and not deleted.is_deleted(one.object)]


def movers(settings):
    """List the original mesh objects of a cover's settings that leave marks, each once, without deleted ones and surfaces."""
    listed = [one.original for one in (pointed(entry, "object") for entry in settings.movers) if one]
    lain_on = {one.object for one in surfaces(settings)} if listed else ()
    return [obj for obj in dict.fromkeys(listed) if is_surface(obj) and obj not in lain_on and not deleted.is_deleted(obj)]


def emitters(settings):
    """List the original emitters of a cover's settings, each once, without deleted ones."""
    return list(_emitters(settings))


def _emitters(settings):
    """Return {original emitter: emitter, original or evaluated as the settings are}, without deleted ones."""
    found = {one.original: one for one in (pointed(entry, "object") for entry in settings.emitters) if one}
    return {original: obj for original, obj in found.items() if is_emitter(obj) and not deleted.is_deleted(obj)}


def scenery(settings):
    """List the original objects whose geometry a cover reads, and the empties that instance such objects.

    The geometry is that of surfaces, of movers, of colliders of the emitters, and of meshes that emit flakes.
    """
    found = [one for each in surfaces(settings) for one in (each.object, *each.instancers)] + movers(settings)
    for emitter in _emitters(settings).values():
        found += colliders.objects(emitter.motus.snow)
        if emitter.motus.snow.shape == 'SURFACE' and source(emitter):
            found.append(source(emitter))
    # A snow cover that is a collider or emits flakes is left out: otherwise it could form a dependency cycle.
    return [obj for obj in dict.fromkeys(obj.original for obj in found) if not _has(obj, "snow_cover")]


def placed(settings):
    """List the original objects whose world matrices a cover reads: its scenery, the emitters, and the meshes or cameras of emitters."""
    falling = _emitters(settings).values()
    return list(dict.fromkeys([*scenery(settings), *(obj.original for obj in (*falling, *map(source, falling)) if obj)]))


def signature(settings):
    """Return a text that differs if a cover reads different objects: their names, sorted, one on each line."""
    return "\n".join(sorted(obj.name for obj in placed(settings)))
