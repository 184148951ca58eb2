"""Switch a camera to a stereo panorama of 360 or 180 degrees, and later restore its previous type."""

import math

import bpy

ANGLES = "latitude_min", "latitude_max", "longitude_min", "longitude_max"
"""Properties of a panorama that limit what it shows."""
_QUARTER = 0.5 * math.pi
FULL, HALF = math.pi, _QUARTER
"""Largest longitude of a panorama that shows all around, and of one that shows the half in front (VR180), in radians."""


def begin(settings, scene, camera, longitude):
    """Make a camera render a stereo panorama whose pixels are square, and store what it was before.

    settings: of the camera's rig. longitude: FULL or HALF.
    """
    panorama, stereo, render = _panorama(camera), camera.stereo, scene.render
    if not settings.before_type:
        settings.before_type, settings.before_spherical, settings.before_merge = (
            camera.type,
            stereo.use_spherical_stereo,
            stereo.use_pole_merge,
        )
        settings.before_panorama = panorama.panorama_type if panorama.is_property_set("panorama_type") else ""
        settings.before_angles = [getattr(panorama, name) for name in ANGLES]
    if not scene.motus.stereo.before_height:
        scene.motus.stereo.before_height = render.resolution_y
    camera.type, panorama.panorama_type = 'PANO', 'EQUIRECTANGULAR'
    stereo.use_spherical_stereo = stereo.use_pole_merge = True
    for name, angle in zip(ANGLES, (-_QUARTER, _QUARTER, -longitude, longitude)):
        setattr(panorama, name, angle)
    render.resolution_y = round(render.resolution_x * render.pixel_aspect_x / render.pixel_aspect_y * _QUARTER / longitude)


def end(settings, camera):
    """Restore the camera type that begin() has stored in `settings`, and the height of pictures; nothing happens if none is stored."""
    if not settings.before_type:
        return
    panorama = _panorama(camera)
    if not put(panorama, "panorama_type", settings.before_panorama):
        panorama.property_unset("panorama_type")
    for name, angle in zip(ANGLES, settings.before_angles):
        if math.isclose(angle, panorama.bl_rna.properties[name].default, abs_tol=1e-6):
            panorama.property_unset(name)
        else:
            setattr(panorama, name, angle)
    if panorama != camera and not panorama.keys():
        camera.property_unset("cycles")
    put(camera, "type", settings.before_type)
    stereo = camera.stereo
    stereo.use_spherical_stereo, stereo.use_pole_merge = settings.before_spherical, settings.before_merge
    settings.before_type = ""
    for scene in bpy.data.scenes:
        _give_height_back(scene)


def _give_height_back(scene):
    """Restore the height of a scene's pictures if none of its rigs is a panorama any more."""
    noted = scene.motus.stereo
    rigs = (obj for obj in scene.objects if obj.type == 'CAMERA' and obj.is_property_set("motus"))
    if not noted.before_height or scene.library or any(obj.motus.stereo.before_type for obj in rigs):
        return
    scene.render.resolution_y = noted.before_height
    noted.property_unset("before_height")


def is_used(camera):
    """Whether a camera renders a stereo panorama."""
    return camera.type == 'PANO' and camera.stereo.use_spherical_stereo


def eyes(camera):
    """Describe the eyes with which Cycles renders a stereo panorama, as keyword arguments of the native parallax_around()."""
    stereo = camera.stereo
    found = {
        "interaxial": stereo.interocular_distance,
        "convergence": math.inf if stereo.convergence_mode == 'PARALLEL' else stereo.convergence_distance,
    }
    if stereo.use_pole_merge and stereo.pole_merge_angle_from <= stereo.pole_merge_angle_to:
        found |= {"merge_from": stereo.pole_merge_angle_from, "merge_to": min(stereo.pole_merge_angle_to, _QUARTER)}
    return found


def width(camera):
    """Angle that the width of a panorama shows, in radians."""
    panorama = _panorama(camera)
    return panorama.longitude_max - panorama.longitude_min


def put(holder, name, value):
    """Assign an item's identifier, read from a file, to an enum property; returns False if the enum has no such item."""
    is_known = value in holder.bl_rna.properties[name].enum_items
    if is_known:
        setattr(holder, name, value)
    return is_known


def _panorama(camera):
    # Before Blender 5.0 the panorama settings belong to Cycles.
    return camera if hasattr(camera, "panorama_type") else camera.cycles
