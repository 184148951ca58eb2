"""What of a camera's lens counts for parallax: focal length, and the part of the sensor behind the image's width."""

from typing import NamedTuple

from ..core.tracks import moving_numbers

ANIMATED = ("lens", "sensor_width", "sensor_height")


class Lens(NamedTuple):
    """focal_length, sensor_width: mm, the latter behind the image's width. aspect: of the image, its width / its height.

    off_axis: what a convergence distance is multiplied by, so that Blender's shift makes the images meet there: Blender divides
    the shift by the sensor's width, also where the sensor's height is what is fitted.
    """

    focal_length: float
    sensor_width: float
    aspect: float
    off_axis: float


def of(camera, render, frame=None):
    """The Lens of a camera for the images of the render settings; frame: at which its keys count, else its present values."""
    # The solver does not wait for what Blender makes of the keys.
    moving = {} if frame is None else moving_numbers(camera, ANIMATED, frame)
    focal_length, width, height = (moving[name] if name in moving else getattr(camera, name) for name in ANIMATED)
    pixel_aspect = render.pixel_aspect_x / render.pixel_aspect_y
    aspect = render.resolution_x * pixel_aspect / render.resolution_y
    fits_width = camera.sensor_fit == 'HORIZONTAL' or (camera.sensor_fit == 'AUTO' and aspect >= 1.0)
    if fits_width:
        return Lens(focal_length, width, aspect, 1.0)
    fitted = height if camera.sensor_fit == 'VERTICAL' else width
    return Lens(focal_length, fitted * aspect, aspect, fitted / width)
