"""Focal length of a camera, and the width of its sensor that the image covers; parallax depends on both."""

from typing import NamedTuple

from ..core.tracks import moving_numbers

ANIMATED = ("lens", "sensor_width", "sensor_height")


class Lens(NamedTuple):
    """Lens of a camera for an image of a given aspect ratio.

    focal_length: mm. sensor_width: mm of the sensor that the image's width covers. aspect: image width divided by image height.
    off_axis: factor on the convergence distance in Blender's off-axis mode. Blender divides the shift by the sensor's width even if the
    sensor fit is by its height.
    """

    focal_length: float
    sensor_width: float
    aspect: float
    off_axis: float


def of(camera, render, frame=None):
    """Return the Lens of a camera for the render settings of a scene.

    frame: frame at which the camera's keys are read; None for the present values.
    """
    # The solver may run before Blender has evaluated the keys of the camera's data.
    moving = {} if frame is None else moving_numbers(camera, ANIMATED, frame)
    focal_length, width, height = (moving[name] if name in moving else getattr(camera, name) for name in ANIMATED)
    pixel_aspect = render.pixel_aspect_x / render.pixel_aspect_y
    aspect = render.resolution_x * pixel_aspect / render.resolution_y
    fits_width = camera.sensor_fit == 'HORIZONTAL' or (camera.sensor_fit == 'AUTO' and aspect >= 1.0)
    if fits_width:
        return Lens(focal_length, width, aspect, 1.0)
    fitted = height if camera.sensor_fit == 'VERTICAL' else width
    return Lens(focal_length, fitted * aspect, aspect, fitted / width)
