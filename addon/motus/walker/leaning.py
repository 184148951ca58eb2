"""What a body does beyond its own animation, so that it rises and leans with its feet; and where bones are put."""

from mathutils import Matrix, Quaternion, Vector

IDENTITY = Matrix.Identity(4)


def relative(place, axes, origin, lift, turn):
    """(move, turn) on top of its own location and rotation, of a thing that is lifted, and turned about a point, in the world.

    place: world matrix that its own animation gives it. axes: 3x3, from its own location to the world.
    """
    arm, linear = place.translation - origin, place.to_3x3()
    move = lift + turn @ arm - arm
    local = linear.inverted_safe() @ turn.to_matrix() @ linear
    return axes.inverted_safe() @ move, local.to_quaternion().normalized()


def share(lift, turn, weight):
    """A share of what a native Walker says of a body, as Vector and Quaternion."""
    return weight * Vector(lift), Quaternion().slerp(Quaternion(turn), weight)


def of_object(obj, basis, parent):
    """(world matrix, axes) of an object with this own transform, on a parent that stands so."""
    above = parent @ obj.matrix_parent_inverse
    return above @ basis, above.to_3x3()


def of_bone(bone, basis, parent, world):
    """The pose of a PoseBone that rises and leans. parent: pose of its parent bone, None without one; world: matrix of the rig."""
    at_rest = posed(bone, IDENTITY, parent)
    columns = [posed(bone, Matrix.Translation(axis), parent).translation - at_rest.translation for axis in IDENTITY.to_3x3().col]
    return world @ posed(bone, basis, parent), world.to_3x3() @ Matrix(columns).transposed()


def posed(bone, basis, parent):
    """Matrix, in the rig's space, of a PoseBone with the given own transform and its constraints ignored.

    basis: the own transform. parent: pose of the parent bone, None without a parent.
    """
    above = {} if parent is None else {"parent_matrix": parent, "parent_matrix_local": bone.parent.bone.matrix_local}
    return bone.bone.convert_local_to_pose(basis, bone.bone.matrix_local, **above)
