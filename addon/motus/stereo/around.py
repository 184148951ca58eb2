"""Switch a camera to a stereo panorama of 360 degrees, and later restore its previous type."""


def begin(settings, camera):
    """Make a camera render a stereo panorama, and store its previous type in `settings`, the settings of the camera's rig."""
    panorama = _panorama(camera)
    if not settings.before_type:
        settings.before_type, settings.before_spherical = camera.type, camera.stereo.use_spherical_stereo
        settings.before_panorama = panorama.panorama_type if panorama.is_property_set("panorama_type") else ""
    camera.type, panorama.panorama_type, camera.stereo.use_spherical_stereo = 'PANO', 'EQUIRECTANGULAR', True


def end(settings, camera):
    """Restore the camera type that begin() has stored in `settings`; nothing happens if none is stored."""
    if not settings.before_type:
        return
    panorama = _panorama(camera)
    if not put(panorama, "panorama_type", settings.before_panorama):
        panorama.property_unset("panorama_type")
        if panorama != camera and not panorama.keys():
            camera.property_unset("cycles")
    put(camera, "type", settings.before_type)
    camera.stereo.use_spherical_stereo, settings.before_type = settings.before_spherical, ""


def put(holder, name, value):
    """Assign an item's identifier, read from a file, to an enum property; returns False if the enum has no such item."""
    is_known = value in holder.bl_rna.properties[name].enum_items
    if is_known:
        setattr(holder, name, value)
    return is_known


def _panorama(camera):
    # Before Blender 5.0 the panorama settings belong to Cycles.
    return camera if hasattr(camera, "panorama_type") else camera.cycles
