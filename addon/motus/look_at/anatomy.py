"""Find the bones of a rig that turn along with a head bone, and the axes of head and eye bones along which they look."""

import math

from mathutils import Vector

from ..core.file.choices import chosen
from ..core.measures import axes
from . import names

LONGEST_SPINE = 4  # bones: the neck and three of the spine
LEG_REACH = 0.25  # share of a bone's height above the rig's lowest point: limbs of the bone that end below it are legs
UPPER_LID, LOWER_LID = math.radians(40.0), math.radians(10.0)  # turns that shut an eye of a person
EYE_CONE = 0.5  # cosine of 60 degrees: an eye bone whose Y axis points within this angle of the front looks along its Y axis


def below(rig, head, count):
    """Names of the bones on which a head bone stands: its nearest `count` ancestors, from the lowest on the body to the head's parent.

    There are fewer names if the head has fewer ancestors.
    """
    names = []
    bone = rig.data.bones[head].parent
    while bone and len(names) < count:
        names.append(bone.name)
        bone = bone.parent
    return names[::-1]


def spine_length(rig, head, up, is_free):
    """Number of ancestors of a head bone that are its neck and spine, at most LONGEST_SPINE.

    Counting up the parents ends before the root bone, a bone from which legs hang, or a bone that is not free.

    up: up axis of the rig, an item of AXES. is_free(name): whether a bone turns by its own animation alone.
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


def lid_angle(rig, entry, name):
    """Turn of an eyelid's bone about its X axis that shuts the eye: over the front, an upper lid's tail down, a lower lid's up."""
    is_lower = bool(names.words(name) & names.LOWER)
    forward, up = (Vector(axes.vector(chosen(entry, axis))) for axis in ("forward", "up"))
    way = forward + (up if is_lower else -up)
    along_z = rig.data.bones[name].matrix_local.to_3x3().col[2]  # the way that a small turn about X takes the tail
    return math.copysign(LOWER_LID if is_lower else UPPER_LID, along_z.dot(way))


def head_forward(rig, entry):
    """Unit vector along which the face looks, in the space of the head bone at rest. entry: settings of the head."""
    choice = chosen(entry, "head_forward")
    if choice == 'AUTO':
        return _front_of(rig.data.bones[entry.name], chosen(entry, "forward"))
    return Vector(axes.vector(choice))


def eyes_forward(rig, entry, eyes):
    """Unit vectors along which the eye bones of a head look, each in the space of its own bone at rest.

    entry: settings of the head. eyes: names of the eye bones, one for each vector.
    """
    bones = [rig.data.bones[name] for name in eyes]
    choice = chosen(entry, "eyes_forward")
    if choice == 'AUTO':
        fronts = [_front_of(bone, chosen(entry, "forward")) for bone in bones]
        return [Vector((0.0, 1.0, 0.0)) if front.y > EYE_CONE else front for front in fronts]
    axis = Vector(axes.vector(choice))
    looks = [bone.matrix_local.to_3x3() @ axis for bone in bones]
    # The bones of the left and right eye may mirror each other: then an axis that points ahead in one bone points backwards in the other.
    return [axis if look.dot(looks[0]) >= 0.0 else -axis for look in looks]


def _front_of(bone, forward):
    # The exact direction, not the nearest axis of the bone: otherwise a leaning head bone would be turned at rest, by its lean.
    return (bone.matrix_local.to_3x3().inverted_safe() @ Vector(axes.vector(forward))).normalized()
