"""Which bones of a rig turn along with a head, and along which of their axes head and eyes look."""

from mathutils import Vector

from ..core.file.choices import chosen
from ..core.measures import axes

LONGEST_SPINE = 4  # the neck and three bones of the spine
LEG_REACH = 0.25  # of a bone's height above the lowest one: limbs that hang lower are legs
EYE_CONE = 0.5  # cosine: an eye bone that points within 60 degrees of the front is the eye's own axis


def below(rig, head, count):
    """Names of the `count` bones below the head, from the lowest to the one the head stands on."""
    names = []
    bone = rig.data.bones[head].parent
    while bone and len(names) < count:
        names.append(bone.name)
        bone = bone.parent
    return names[::-1]


def spine_length(rig, head, up, is_free):
    """How many bones below the head are neck and spine: not the root, nor what legs hang from, nor what something else turns.

    up: item of AXES. is_free(name): whether a bone turns by its own animation alone.
    """
    vertical = Vector(axes.vector(up))
    lowest = min(min(bone.head_local.dot(vertical), bone.tail_local.dot(vertical)) for bone in rig.data.bones)
    count = 0
    above, bone = rig.data.bones[head], rig.data.bones[head].parent
    while bone and bone.parent and count < LONGEST_SPINE and is_free(bone.name) and not _has_legs(bone, above, vertical, lowest):
        count += 1
        above, bone = bone, bone.parent
    return count


def _has_legs(bone, above, vertical, lowest):
    ground = lowest + LEG_REACH * (bone.head_local.dot(vertical) - lowest)
    limbs = [child for child in bone.children if child != above]
    return any(part.tail_local.dot(vertical) < ground for limb in limbs for part in (limb, *limb.children_recursive))


def head_forward(rig, entry):
    """Unit vector, in the head bone's own space, along which the face looks."""
    choice = chosen(entry, "head_forward")
    if choice == 'AUTO':
        return _front_of(rig.data.bones[entry.name], chosen(entry, "forward"))
    return Vector(axes.vector(choice))


def eyes_forward(rig, entry, eyes):
    """Unit vectors, in the eye bones' own spaces, along which they look: one for each of these eyes of a head."""
    bones = [rig.data.bones[name] for name in eyes]
    choice = chosen(entry, "eyes_forward")
    if choice == 'AUTO':
        fronts = [_front_of(bone, chosen(entry, "forward")) for bone in bones]
        return [Vector((0.0, 1.0, 0.0)) if front.y > EYE_CONE else front for front in fronts]
    axis = Vector(axes.vector(choice))
    looks = [bone.matrix_local.to_3x3() @ axis for bone in bones]
    # Bones of the two sides may mirror each other: then one axis points ahead for one eye, and backwards for the other.
    return [axis if look.dot(looks[0]) >= 0.0 else -axis for look in looks]


def _front_of(bone, forward):
    # Exactly the front, not the nearest axis: a head bone that leans would else be turned by as much at rest.
    return (bone.matrix_local.to_3x3().inverted_safe() @ Vector(axes.vector(forward))).normalized()
