"""Switch a camera to a stereo panorama of 360 degrees and back."""


def begin(settings, camera):
    """Make a camera render a stereo panorama, and store its previous type. settings: of its rig."""
    panorama = _panorama(camera)
    if not settings.before_type:
        settings.before_type, settings.before_spherical = camera.type, camera.stereo.use_spherical_stereo
        settings.before_panorama = panorama.panorama_type if panorama.is_property_set("panorama_type") else ""
    camera.type, panorama.panorama_type, camera.stereo.use_spherical_stereo = 'PANO', 'EQUIRECTANGULAR', True


def end(settings, camera):
    """Restore the camera's type before the panorama, if the camera renders one."""
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
    """Set an enum to a value that was read from a file; returns whether the enum has that item."""
    is_known = value in holder.bl_rna.properties[name].enum_items
    if is_known:
        setattr(holder, name, value)
    return is_known


def _panorama(camera):
    # panorama settings belong to Cycles before 5.0
    return camera if hasattr(camera, "panorama_type") else camera.cycles
