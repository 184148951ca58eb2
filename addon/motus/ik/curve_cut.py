"""A further key on an F-curve that leaves the curve as it is."""

import math

SAME_FRAME = 1e-3
_EXACT = {'BEZIER', 'LINEAR', 'CONSTANT'}
"""Interpolations of which a part is one of the same kind."""
_AUTOMATIC = {'AUTO', 'AUTO_CLAMPED'}


def around(curve, frame):
    """The last key before a frame, the one on it, and the first after it: lists of one or none."""
    before, here, after = _divided(curve, frame, frame)
    return before[-1:], here[:1], after[:1]


def _divided(curve, first, last):
    """The keys before two frames, from one to the other, and after them."""
    points = curve.keyframe_points
    return (
        [point for point in points if point.co.x < first - SAME_FRAME],
        [point for point in points if first - SAME_FRAME <= point.co.x <= last + SAME_FRAME],
        [point for point in points if point.co.x > last + SAME_FRAME],
    )


def beside(curve, first, last):
    """The keys outside of a range whose automatic handles go by keys within it: the nearest before and after it.

    Where the curve is repeated, its ends as well: Blender takes them for neighbours of one another. None of a curve with
    one key: Blender works out its handles only once there are more.
    """
    if len(curve.keyframe_points) < 2:
        return []
    before, _, after = _divided(curve, first, last)
    nearest = before[-1:] + after[:1]
    if any(modifier.type == 'CYCLES' for modifier in curve.modifiers):
        nearest += before[:1] + after[-1:]
    return nearest


def hold(point):
    """Let the handles of a key stay where they are, whatever becomes of the keys next to it; not those that point at one."""
    types = point.handle_left_type, point.handle_right_type
    moving = _AUTOMATIC | ({'ALIGNED'} if 'VECTOR' in types else set())  # as the other side, which points at a key
    if types[0] in moving:
        point.handle_left_type = 'FREE'
    if types[1] in moving:
        point.handle_right_type = 'FREE'


def cut(curve, frame):
    """Put a key on a curve at a frame; returns it. Handles of the keys next to it are no longer automatic."""
    before, here, after = around(curve, frame)
    if before and after and not here and before[0].interpolation not in _EXACT:
        _key_every_frame(curve, before[0].co.x, after[0].co.x)
        before, here, after = around(curve, frame)
    # Blender divides a segment exactly where its handles are not automatic.
    for point in (*before, *here, *after):
        _free(point)
    if here:
        return here[0]
    if before and not after:
        before[0].interpolation = 'LINEAR'
    value, interpolation = curve.evaluate(frame), before[0].interpolation if before else 'LINEAR'
    point = curve.keyframe_points.insert(frame, value)
    point.interpolation = interpolation
    _free(point)
    return point


def _free(point):
    point.handle_left_type = point.handle_right_type = 'FREE'


def _key_every_frame(curve, start, end):
    """Replace an eased segment by one linear key per frame: no shorter segment can have the same easing."""
    frames = [start, *range(math.floor(start + SAME_FRAME) + 1, math.ceil(end - SAME_FRAME))]
    for frame, value in [(frame, curve.evaluate(frame)) for frame in frames]:
        curve.keyframe_points.insert(frame, value, options={'FAST'}).interpolation = 'LINEAR'
    curve.update()
