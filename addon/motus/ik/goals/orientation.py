"""Orientations as the solver reads them from matrices, which may be scaled, sheared and mirrored."""

from mathutils import Matrix, Quaternion

ACROSS = 1e-5  # of its length: a Z axis that has less across Y shows no side


def frame_of(matrix):
    """Right-handed orientation of a matrix: Y along its second axis, Z on the side of its third axis. The library's turns.hpp has the same rule.

    For any linear map M, frame_of(M @ matrix) is the frame that the map makes of frame_of(matrix).
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
