"""View and projection matrices that bring a box into a picture, for views that are drawn off-screen."""

from mathutils import Matrix, Vector

LENS = 2.4
"""Focal length of such a view, in units of half the picture's height."""
BORDER = 1.1
"""Margin around the shown box, as a factor on the size of the box in the picture."""


def camera(rotation, corners, aspect):
    """Return (view matrix, projection matrix) of a perspective view, as near as possible with all corners of a box in the picture.

    rotation: quaternion of the view; the viewer looks along its negative Z axis. corners: world positions. aspect: width / height of the
    picture.
    """
    toward = rotation @ Vector((0.0, 0.0, 1.0))
    center = sum(corners, Vector()) / len(corners)
    radius = max(1e-6, *((corner - center).length for corner in corners))
    seen = [rotation.inverted() @ (corner - center) for corner in corners]
    distance = max(place.z + BORDER * LENS * max(abs(place.x) / aspect, abs(place.y), 0.1 * radius) for place in seen)
    view = Matrix.LocRotScale(center + distance * toward, rotation, None).inverted()
    near, far = max(distance - 2.0 * radius, distance * 0.01), distance + 50.0 * radius
    projection = Matrix(
        (
            (LENS / aspect, 0.0, 0.0, 0.0),
            (0.0, LENS, 0.0, 0.0),
            (0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)),
            (0.0, 0.0, -1.0, 0.0),
        )
    )
    return view, projection
