"""Transforms of a walker's body, which rises and leans with the feet in addition to its own animation, and of posed bones."""

from mathutils import Matrix, Quaternion, Vector

IDENTITY = Matrix.Identity(4)


def relative(place, axes, origin, lift, turn):
    """Convert a world motion of an object or bone to (location, rotation) that are added to its own location and rotation.

    The motion is a turn about a point and a lift. place: world matrix by the thing's own animation. axes: 3x3 matrix from the thing's
    location channels to the world. origin: the point, in the world. lift: Vector, in the world. turn: Quaternion, in the world.
    """
    arm, linear = place.translation - origin, place.to_3x3()
    move = lift + turn @ arm - arm
    local = linear.inverted_safe() @ turn.to_matrix() @ linear
    return axes.inverted_safe() @ move, local.to_quaternion().normalized()


def share(lift, turn, weight):
    """Return a share of a body's motion as (Vector, Quaternion). lift, turn: from the native Walker. weight: the share, 0 to 1."""
    return weight * Vector(lift), Quaternion().slerp(Quaternion(turn), weight)


def of_object(obj, basis, parent):
    """Return (world matrix, 3x3 matrix from the object's location channels to the world) of an object.

    basis: matrix of the object's own location, rotation and scale. parent: world matrix of the object's parent.
    """
    above = parent @ obj.matrix_parent_inverse
    return above @ basis, above.to_3x3()


def of_bone(bone, basis, parent, world, channels):
    """Return (world matrix, 3x3 matrix from the bone's location channels to the world) of a PoseBone, without its constraints.

    basis: matrix of the bone's own location, rotation and scale. parent: PoseBone.matrix of the parent bone, None if there is none.
    world: world matrix of the rig. channels: location_channels(bone, parent).
    """
    return world @ posed(bone, basis, parent), world.to_3x3() @ channels


def location_channels(bone, parent):
    """3x3 matrix from the location channels of a PoseBone to the rig's space. parent: PoseBone.matrix of the parent bone, or None."""
    at_rest = posed(bone, IDENTITY, parent)
    columns = [posed(bone, Matrix.Translation(axis), parent).translation - at_rest.translation for axis in IDENTITY.to_3x3().col]
    return Matrix(columns).transposed()


def posed(bone, basis, parent):
    """Matrix, in the rig's space, of a PoseBone without its constraints.

    basis: matrix of the bone's own location, rotation and scale. parent: PoseBone.matrix of the parent bone, None if there is none.
    """
    above = {} if parent is None else {"parent_matrix": parent, "parent_matrix_local": bone.parent.bone.matrix_local}
    return bone.bone.convert_local_to_pose(basis, bone.bone.matrix_local, **above)
