"""What a cover reads: the surfaces that snow lies on, the emitters whose flakes land there, and what shelters.

The settings may be an evaluated object's; what is found are originals.
"""

from ...core import deleted


def _has(obj, name):
    # To ask an object for its settings gives it some.
    return obj.is_property_set("motus") and getattr(obj.motus, name).is_active


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
    """The objects that snow lies on, each once, but for those that were deleted."""
    found = [entry.object.original for entry in settings.surfaces if entry.object]
    found += settings.collection.original.all_objects if settings.collection else []
    return [obj for obj in dict.fromkeys(found) if is_surface(obj) and not deleted.is_deleted(obj)]


def emitters(settings):
    """The emitters, each once, but for those that were deleted."""
    found = dict.fromkeys(entry.object.original for entry in settings.emitters if entry.object)
    return [obj for obj in found if is_emitter(obj) and not deleted.is_deleted(obj)]


def source(emitter):
    """The object at whose poses an emitter's flakes are born; None where it is missing."""
    snow = emitter.motus.snow
    if snow.shape != 'SURFACE':
        return emitter
    return snow.surface and snow.surface.original


def shelters(emitter, surfaces_of):
    """The objects that an emitter's flakes land on beside the surfaces."""
    collider = emitter.motus.snow.collider
    collider = collider and collider.original
    found = [collider] if collider and collider.type == 'MESH' and not deleted.is_deleted(collider) else []
    return [obj for obj in found if obj not in surfaces_of]


def scenery(settings):
    """The objects whose geometry is read."""
    lain_on = surfaces(settings)
    found = list(lain_on)
    for emitter in emitters(settings):
        found += shelters(emitter, lain_on)
        if emitter.motus.snow.shape == 'SURFACE' and source(emitter):
            found.append(source(emitter))
    return list(dict.fromkeys(found))


def placed(settings):
    """The objects whose places are read."""
    found = emitters(settings)
    return list(dict.fromkeys([*scenery(settings), *found]))


def signature(settings):
    """A text that tells which objects are read."""
    return "\n".join(sorted(obj.name for obj in placed(settings)))
