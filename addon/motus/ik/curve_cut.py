"""Insert a key into an F-curve without changing the shape of the curve."""

import math

SAME_FRAME = 1e-3
_EXACT = {'BEZIER', 'LINEAR', 'CONSTANT'}
"""Interpolations whose segments a key can divide into segments of the same interpolation, without changing the curve."""
_AUTOMATIC = {'AUTO', 'AUTO_CLAMPED'}


def around(curve, frame):
    """Nearest key before a frame, key on the frame, and nearest key after it: three lists, each with one keyframe or none."""
    before, here, after = _divided(curve, frame, frame)
    return before[-1:], here[:1], after[:1]


def _divided(curve, first, last):
    """Keys of an F-curve before, within and after a range of frames: three lists of keyframes."""
    points = curve.keyframe_points
    return (
        [point for point in points if point.co.x < first - SAME_FRAME],
        [point for point in points if first - SAME_FRAME <= point.co.x <= last + SAME_FRAME],
        [point for point in points if point.co.x > last + SAME_FRAME],
    )


def beside(curve, first, last):
    """Keys outside of a range of frames whose automatic handles depend on keys within it: the nearest key before and after it.

    If the curve has a Cycles modifier, its first and last key are included: Blender treats these as neighbours. The
    list is empty for a curve with one key, since Blender computes automatic handles only if there are several keys.
    """
    if len(curve.keyframe_points) < 2:
        return []
    before, _, after = _divided(curve, first, last)
    nearest = before[-1:] + after[:1]
    if any(modifier.type == 'CYCLES' for modifier in curve.modifiers):
        nearest += before[:1] + after[-1:]
    return nearest


def hold(point):
    """Free the handles of a key that would move with the keys next to it, so that they stay where they are.

    Handles of type Vector, which point at the next key, are left as they are.
    """
    types = point.handle_left_type, point.handle_right_type
    moving = _AUTOMATIC | ({'ALIGNED'} if 'VECTOR' in types else set())  # Aligned handles turn with a Vector handle
    if types[0] in moving:
        point.handle_left_type = 'FREE'
    if types[1] in moving:
        point.handle_right_type = 'FREE'


def cut(curve, frame):
    """Insert a key into an F-curve at a frame without changing the curve; returns the key.

    Handles of the keys next to it become free. A segment with easing is first replaced by linear keys on every frame.
    """
    before, here, after = around(curve, frame)
    if before and after and not here and before[0].interpolation not in _EXACT:
        _key_every_frame(curve, before[0].co.x, after[0].co.x)
        before, here, after = around(curve, frame)
    # Blender divides a segment exactly only if its handles are not automatic.
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
    """Replace an eased segment of an F-curve by one linear key per frame, since no shorter segment can have the same easing."""
    frames = [start, *range(math.floor(start + SAME_FRAME) + 1, math.ceil(end - SAME_FRAME))]
    for frame, value in [(frame, curve.evaluate(frame)) for frame in frames]:
        curve.keyframe_points.insert(frame, value, options={'FAST'}).interpolation = 'LINEAR'
    curve.update()
