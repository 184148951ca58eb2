"""What of a scene is set after the footage: size, frames, frame rate and colours; and taken back."""

from . import footage


def take(scene, image, noted):
    """Note what the scene has, and give it what the image has."""
    render, view = scene.render, scene.view_settings
    noted.is_scene_set = True
    noted.before_resolution = render.resolution_x, render.resolution_y, render.resolution_percentage
    noted.before_aspect = render.pixel_aspect_x, render.pixel_aspect_y
    noted.before_frames = scene.frame_start, scene.frame_end
    noted.before_fps, noted.before_fps_base = render.fps, render.fps_base
    noted.before_transform, noted.before_look = view.view_transform, view.look

    render.resolution_x, render.resolution_y = footage.size(image)
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1.0
    frames = footage.duration(image)
    if frames > 1:
        scene.frame_start, scene.frame_end = 1, frames
        _set_rate(render, footage.rate(image))
    # Any other would change the colours that the footage has.
    _assign(view, "view_transform", "Standard")
    _assign(view, "look", "None")


def restore(scene, noted):
    """Give the scene back what was noted."""
    if not noted.is_scene_set:
        return
    render, view = scene.render, scene.view_settings
    render.resolution_x, render.resolution_y, render.resolution_percentage = noted.before_resolution
    render.pixel_aspect_x, render.pixel_aspect_y = noted.before_aspect
    scene.frame_start, scene.frame_end = noted.before_frames
    render.fps, render.fps_base = noted.before_fps, noted.before_fps_base
    _assign(view, "view_transform", noted.before_transform)
    _assign(view, "look", noted.before_look)


def _set_rate(render, rate):
    if rate is None:
        return
    render.fps = max(1, round(rate))
    render.fps_base = render.fps / rate


def _assign(view, name, value):
    """Set an enumeration whose items are those of the colour configuration, if it has this one."""
    try:
        setattr(view, name, value)
    except TypeError:
        return
