"""Orientation of a matrix, which may be scaled, sheared or mirrored, by the rule of the native solver."""

from mathutils import Matrix, Quaternion

ACROSS = 1e-5  # share of its length: a Z axis with a smaller part perpendicular to Y does not show a side


def frame_of(matrix):
    """Right-handed orientation of a matrix, a Quaternion: Y along the matrix's second axis, Z on the side of its third axis.

    The native library (turns.hpp) has this rule, too. For any linear map M, frame_of(M @ matrix) depends only on M and on
    frame_of(matrix).
    """
    x, y, z = (axis.normalized() for axis in matrix.to_3x3().transposed())
    if y.length == 0.0:
        y = z.cross(x).normalized()
    z -= z.dot(y) * y
    if z.length < ACROSS:
        z = x.cross(y)
    if y.length == 0.0 or z.length < ACROSS:
        return Quaternion()
    z.normalize()
    return Matrix((y.cross(z), y, z)).transposed().to_quaternion()
