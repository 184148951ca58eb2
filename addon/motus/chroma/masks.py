"""Create Mask datablocks with a rectangle, which the user then reshapes."""

import bpy

_WIDE, _SMALL = 0.9, 0.3
"""Sides of the wide and the small rectangle, as shares of the picture's sides."""


def new(name, size, is_outside):
    """Create a Mask datablock with a rectangle, for pictures of `size` (width, height) in pixels.

    is_outside: if True, the mask is white outside a wide rectangle; otherwise white inside a small rectangle.
    """
    mask = bpy.data.masks.new(name)
    layer = mask.layers.new()
    layer.invert = is_outside
    spline = layer.splines.new()
    greatest, share = max(size), 0.5 * (_WIDE if is_outside else _SMALL)
    across, up = (share * side / greatest for side in size)
    corners = ((-across, -up), (across, -up), (across, up), (-across, up))
    spline.points.add(len(corners) - len(spline.points))
    for point, (x, y) in zip(spline.points, corners):
        point.handle_type = 'VECTOR'
        point.co = 0.5 + x, 0.5 + y
    spline.use_cyclic = True
    return mask
