"""Set a scene's size, frame range, frame rate and colour management for footage, and restore the previous values."""

from . import footage

_NEUTRAL = {
    "view_transform": "Standard",
    "look": "None",
    "exposure": 0.0,
    "gamma": 1.0,
    "use_curve_mapping": False,
    "use_white_balance": False,
}
"""Colour management settings with which colours stay unchanged."""


def take(scene, image, noted):
    """Store a scene's render and colour management settings in `noted`, and change them to suit the footage `image`."""
    render, view = scene.render, scene.view_settings
    noted.is_scene_set = True
    noted.before_resolution = render.resolution_x, render.resolution_y, render.resolution_percentage
    noted.before_aspect = render.pixel_aspect_x, render.pixel_aspect_y
    noted.before_frames = scene.frame_start, scene.frame_end
    noted.before_fps, noted.before_fps_base = render.fps, render.fps_base
    noted.before_transform, noted.before_look = view.view_transform, view.look
    noted.before_exposure, noted.before_gamma, noted.before_curves = view.exposure, view.gamma, view.use_curve_mapping
    noted.before_white_balance = getattr(view, "use_white_balance", False)

    render.resolution_x, render.resolution_y = footage.size(image)
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1.0
    frames = footage.duration(image)
    if frames > 1:
        scene.frame_start, scene.frame_end = 1, frames
        _set_rate(render, footage.rate(image))
    # Different view settings would change the colours of the footage.
    for name, value in _NEUTRAL.items():
        _assign(view, name, value)


def restore(scene, noted):
    """Restore the scene settings that take() has stored in `noted`; nothing happens if none are stored."""
    if not noted.is_scene_set:
        return
    render, view = scene.render, scene.view_settings
    render.resolution_x, render.resolution_y, render.resolution_percentage = noted.before_resolution
    render.pixel_aspect_x, render.pixel_aspect_y = noted.before_aspect
    scene.frame_start, scene.frame_end = noted.before_frames
    render.fps, render.fps_base = noted.before_fps, noted.before_fps_base
    _assign(view, "view_transform", noted.before_transform)
    _assign(view, "look", noted.before_look)
    if not noted.is_property_set("before_exposure"):
        return  # keys of older Motus versions did not change the view settings
    _assign(view, "exposure", noted.before_exposure)
    _assign(view, "gamma", noted.before_gamma)
    _assign(view, "use_curve_mapping", noted.before_curves)
    _assign(view, "use_white_balance", noted.before_white_balance)


def changes(scene):
    """Return the labels of a scene's colour management settings that change the footage's colours in the viewport or in renders."""
    view = scene.view_settings
    return [view.bl_rna.properties[name].name for name, value in _NEUTRAL.items() if getattr(view, name, value) != value]


def _set_rate(render, rate):
    if rate is None:
        return
    render.fps = max(1, round(rate))
    render.fps_base = render.fps / rate


def _assign(view, name, value):
    """Set a colour management setting, if this Blender has it and, for an enum, if the colour configuration has the item."""
    if not hasattr(view, name):
        return
    try:
        setattr(view, name, value)
    except TypeError:
        return
