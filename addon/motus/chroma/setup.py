"""Functions that set up, measure, upgrade and remove a chroma key; the operators call them."""

import bpy

from ..core.blender import copied_animation, datablocks
from ..core.file.pointers import pointed
from ..core.refusals import Refused
from ..core.translations import tr
from . import analysis, compositor, footage, group, plane, scene_settings, settings


def check_free(scene):
    """Raise Refused if a scene is linked from a different file, or has a chroma key already."""
    check_own(scene)
    if compositor.key_of(scene) is not None:
        raise Refused(tr("{scene} has a chroma key already: add another color to it, or remove it first").format(scene=scene.name))


def check_own(scene):
    """Raise Refused if a scene is linked from a different file."""
    if scene.library or scene.override_library:
        raise Refused(tr("{scene} is linked from another file").format(scene=scene.name))


def key(scene):
    """Return the node of the scene's key that the panel shows. Raises Refused if the scene has no key."""
    check_own(scene)
    found = compositor.active_key(scene)
    if found is None:
        raise Refused(tr("{scene} has no chroma key").format(scene=scene.name))
    return found


def note(noted, report):
    """Store the values of a measurement report in `noted`, the chroma settings of a scene."""
    for name in ("share", "luminance_spread", "chroma_spread", "spill"):
        setattr(noted, name, report[name])


def note_gaps(scene, *images):
    """Store a sentence on missing pictures of image sequences in the scene's chroma settings; "" if none are missing.

    images: images, or None for no image.
    """
    found = [(image, gap) for image in images if image is not None and (gap := footage.gap(image))]
    scene.motus.chroma.gap = " ".join(
        tr("{object} lacks pictures {numbers}: frames {frames} show the ones before").format(
            object=image.name, numbers=numbers, frames=frames
        )
        for image, (numbers, frames) in found
    )


def color_of(node):
    """Screen colour (red, green, blue) of a key's node; None if the user has removed the input."""
    place = settings.place_of_input(node, settings.COLOR)
    return tuple(getattr(*place))[:3] if place else None


def apply_measured(node, noted, found, levels):
    """Set the screen colour and the clip levels of a key's node, store the report, and update the plane that shows the key.

    noted: chroma settings of the scene. found: (colour, report) of analysis.measure(). levels: (black, white).
    """
    color, report = found
    note(noted, report)
    place = settings.place_of_input(node, settings.COLOR)
    if place is not None:
        setattr(*place, (*color, 1.0))  # type: ignore[call-arg]
    for name, level in zip(("black", "white"), levels):
        settings.assign(node, settings.BY_KEYWORD[name], level)
    shown = pointed(noted, "plane")
    if shown is not None and node == compositor.key_of(noted.id_data):
        plane.update(shown, _shown(node))


def _shown(node):
    """Return the values of a key's node that the plane in front of the camera needs, as a plane.Key."""
    return plane.Key(color_of(node), *(settings.value(node, name) for name in ("black", "white", "balance", "gain")))


def image_of(scene):
    """Return the footage of a scene's key. Raises Refused if its node or image is missing."""
    source = compositor.node_of(scene, compositor.FOREGROUND)
    if source is None or source.image is None:
        raise Refused(tr("The key has lost its footage"))
    return source.image


def measure(scene, color=None):
    """Measure the screen in the footage of a scene's key again, and set the key's colour and clip levels.

    color: the screen's colour; None to search for it. Returns (colour, report).
    """
    node, image = key(scene), image_of(scene)
    found = analysis.measure(image, color, settings.value(node, "balance"), settings.value(node, "gain"))
    apply_measured(node, scene.motus.chroma, found, analysis.clip_levels(found[1]))
    background = compositor.node_of(scene, compositor.BACKGROUND)
    note_gaps(scene, image, background.image if background else None)
    compositor.show_image(scene, compositor.node_of(scene, compositor.FOREGROUND), image)
    return found


def add_key(scene, color=None):
    """Add a further key to a scene, for a different colour of the screen in its footage; returns the key's node.

    color: the colour; None to search for a screen that the present keys do not make transparent.
    """
    first, image = key(scene), image_of(scene)
    if color is not None:
        analysis.check_color(color)
    there = [(color_of(node), *(settings.value(node, name) for name in ("black", "balance", "gain"))) for node in compositor.keys_of(scene)]
    if color is None:
        color = analysis.another_color(image, [one for one in there if one[0] is not None])
    if color is None:
        color = color_of(first)
    node = compositor.add_key(scene, group.build(footage.size(image)[0]))
    found = analysis.measure(image, color)
    scene.motus.chroma.active_key = len(compositor.keys_of(scene)) - 1
    scene.motus.chroma.view = scene.motus.chroma.view
    apply_measured(node, scene.motus.chroma, found, analysis.clip_levels(found[1]))
    return node


def upgrade(scene):
    """Replace the node groups of keys of older Motus versions by the present group, keep the settings, and measure the levels again."""
    for node in compositor.keys_of(scene):
        if not group.is_of_older_version(node.node_tree):
            continue
        older, view = node.node_tree, group.view(node.node_tree)
        values = [(one, settings.value(node, one.keyword), settings.place(node, one)) for one in settings.OF_KEYING]
        inputs = [(name, settings.place_of_input(node, name)) for name in (settings.COLOR, settings.MASK, settings.WRAP)]
        inputs = [(name, _copied(getattr(*place))) for name, place in inputs if place]
        compositor.exchange(scene, node, group.build(footage.size(image_of(scene))[0]))
        for one, value, place in values:
            settings.assign(node, one, value)
            _keep_animation(place, settings.place(node, one))
        for name, value in inputs:
            node.inputs[name].default_value = value
        group.show(node.node_tree, view or group.COMPOSITE)
        compositor.drop_group(older)
    measure(scene, color_of(key(scene)))


def _keep_animation(before, now):
    """Copy the keys and the driver of a setting from an old node group to the present one.

    before, now: results of settings.place() for the two groups; None for either copies nothing.
    """
    if before is not None and now is not None:
        holder, name = before
        copied_animation.copy_all(holder.id_data, f"{holder.path_from_id()}.{name}", *now)


def _copied(value):
    return value if isinstance(value, float) else tuple(value)


def add_plane(scene):
    """Add a plane in front of the scene's camera that shows the key's footage with the key's colour and levels."""
    check_own(scene)
    node, image = compositor.key_of(scene), image_of(scene)
    if color_of(node) is None:
        raise Refused(tr("The key has lost its footage"))
    deleted = pointed(scene.motus.chroma, "plane")
    scene.motus.chroma.plane = plane.add(scene, scene.camera, image, _shown(node), plane.DISTANCE)
    if deleted is not None and group.KEY in deleted:
        datablocks.remove_objects([deleted])


def remove(scene):
    """Remove the chroma key of a scene with its plane and its unused images, and restore the scene's settings."""
    noted = scene.motus.chroma
    others = [other for other in bpy.data.scenes if other != scene]
    # A copied scene may use the plane too.
    shown = pointed(noted, "plane")
    if shown is not None and group.KEY in shown and all(pointed(other.motus.chroma, "plane") != shown for other in others):
        datablocks.remove_objects([shown])
    compositor.remove(scene, noted)
    noted.background = None
    footage.drop_unused()
    scene_settings.restore(scene, noted)
    scene.motus.property_unset("chroma")
