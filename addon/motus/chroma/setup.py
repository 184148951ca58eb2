"""What setting up, measuring and removing a key consists of."""

import bpy

from ..core import datablocks
from ..core.file.pointers import pointed
from ..core.refusals import Refused
from ..core.translations import tr
from . import analysis, compositor, footage, group, plane, scene_settings, settings


def check_free(scene):
    """Refuse a scene of another file, and one that has a key."""
    check_own(scene)
    if compositor.key_of(scene) is not None:
        raise Refused(tr("{scene} has a chroma key already: remove it first").format(scene=scene.name))


def check_own(scene):
    """Refuse a scene of another file."""
    if scene.library or scene.override_library:
        raise Refused(tr("{scene} is linked from another file").format(scene=scene.name))


def key(scene):
    """The node of the scene's key. Raises Refused."""
    check_own(scene)
    found = compositor.key_of(scene)
    if found is None:
        raise Refused(tr("{scene} has no chroma key").format(scene=scene.name))
    return found


def note(noted, report):
    """Remember what was measured."""
    for name in ("share", "luminance_spread", "chroma_spread", "spill"):
        setattr(noted, name, report[name])


def apply_measured(node, noted, found, levels):
    """Give a key a colour and clip levels. found: (colour, report)."""
    color, report = found
    note(noted, report)
    place = settings.place_of_input(node, settings.COLOR)
    if place is not None:
        setattr(*place, (*color, 1.0))
    for name, level in zip(("black", "white"), levels):
        settings.assign(node, next(one for one in settings.OF_KEYING if one.keyword == name), level)
    shown = pointed(noted, "plane")
    if shown is not None:
        plane.update(shown, color, levels)


def measure(scene, color=None):
    """Look at the footage of a scene's key again."""
    node = key(scene)
    source = compositor.node_of(scene, compositor.FOREGROUND)
    if source is None or source.image is None:
        raise Refused(tr("The key has lost its footage"))
    found = analysis.measure(source.image, color)
    apply_measured(node, scene.motus.chroma, found, analysis.clip_levels(found[1]))
    return found


def add_plane(scene):
    """Show a scene's key, with the colour and levels that it has, on a plane before the scene's camera."""
    node = key(scene)
    source = compositor.node_of(scene, compositor.FOREGROUND)
    color = settings.place_of_input(node, settings.COLOR)
    levels = [settings.place(node, one) for one in settings.OF_KEYING if one.keyword in ("black", "white")]
    if source is None or source.image is None or None in (color, *levels):
        raise Refused(tr("The key has lost its footage"))
    deleted = pointed(scene.motus.chroma, "plane")
    scene.motus.chroma.plane = plane.add(
        scene, scene.camera, source.image, tuple(getattr(*color))[:3], [getattr(*one) for one in levels], plane.DISTANCE)
    if deleted is not None and group.KEY in deleted:
        datablocks.remove_objects([deleted])


def remove(scene):
    """Take all back that a key has brought."""
    noted = scene.motus.chroma
    others = [other for other in bpy.data.scenes if other != scene]
    # A copy of a scene shows the same plane.
    shown = pointed(noted, "plane")
    if shown is not None and group.KEY in shown and all(pointed(other.motus.chroma, "plane") != shown for other in others):
        datablocks.remove_objects([shown])
    compositor.remove(scene, noted)
    footage.drop_unused()
    scene_settings.restore(scene, noted)
    scene.motus.property_unset("chroma")
