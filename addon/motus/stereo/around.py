"""A camera that sees all around, in stereo; and how it sees without."""


def begin(settings, camera):
    """Let a camera see all around, and note how it has seen. settings: of its rig."""
    panorama = _panorama(camera)
    if not settings.before_type:
        settings.before_type, settings.before_spherical = camera.type, camera.stereo.use_spherical_stereo
        settings.before_panorama = panorama.panorama_type if panorama.is_property_set("panorama_type") else ""
    camera.type, panorama.panorama_type, camera.stereo.use_spherical_stereo = 'PANO', 'EQUIRECTANGULAR', True


def end(settings, camera):
    """Let a camera see as it did before, if it sees all around."""
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
    """Set an enum to a value that was read from a file, which may say anything; tells whether it is one of its values."""
    is_known = value in holder.bl_rna.properties[name].enum_items
    if is_known:
        setattr(holder, name, value)
    return is_known


def _panorama(camera):
    # Cycles' own until 5.0.
    return camera if hasattr(camera, "panorama_type") else camera.cycles
