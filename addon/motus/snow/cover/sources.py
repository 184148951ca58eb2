"""What a cover reads: the surfaces that snow lies on, the emitters whose flakes land there, and what shelters.

The settings may be an evaluated object's; what is found are originals.
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
    """Whether snow can lie on an object: not on snow."""
    return obj.type == 'MESH' and not _has(obj, "snow_cover") and not _has(obj, "snow")


def is_surface_or_cover(obj):
    """Whether snow can lie on an object, or it is such snow."""
    return obj.type == 'MESH' and not _has(obj, "snow")


def is_emitter(obj):
    """Whether flakes come from an object."""
    return _has(obj, "snow")


def surfaces(settings):
    """The surfaces that snow lies on, Gathered, without deleted ones."""
    listed = [one.original for one in (pointed(entry, "object") for entry in settings.surfaces) if one]
    found = [gathered.Gathered(obj, ()) for obj in listed]
    if pointed(settings, "collection"):
        found += gathered.meshes(pointed(settings, "collection"), lambda obj: not is_surface(obj))
    return [one for one in dict.fromkeys(found) if is_surface(one.object) and not deleted.is_deleted(one.object)]


def emitters(settings):
    """The emitters, each once, but for those that were deleted."""
    return list(_emitters(settings))


def _emitters(settings):
    """{original: emitter as the settings name it}."""
    found = {one.original: one for one in (pointed(entry, "object") for entry in settings.emitters) if one}
    return {original: obj for original, obj in found.items() if is_emitter(obj) and not deleted.is_deleted(obj)}


def scenery(settings):
    """The objects whose geometry is read, and empties by which it is seen."""
    found = [one for each in surfaces(settings) for one in (each.object, *each.instancers)]
    for emitter in _emitters(settings).values():
        found += colliders.objects(emitter.motus.snow)
        if emitter.motus.snow.shape == 'SURFACE' and source(emitter):
            found.append(source(emitter))
    # Somebody may have chosen a cover as a collider, or to be born on: it cannot wait for itself, nor two for each other.
    return [obj for obj in dict.fromkeys(obj.original for obj in found) if not _has(obj, "snow_cover")]


def placed(settings):
    """The objects whose places are read."""
    falling = _emitters(settings).values()
    return list(dict.fromkeys([*scenery(settings), *(obj.original for obj in (*falling, *map(source, falling)) if obj)]))


def signature(settings):
    """A text that tells which objects are read."""
    return "\n".join(sorted(obj.name for obj in placed(settings)))
