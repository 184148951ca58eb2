"""What a rig's bones are, as far as names and the rest pose tell: head, spine, eyes, and where they look."""

import re

from mathutils import Vector

FRONT = Vector((0.0, -1.0, 0.0))
"""A character faces -Y in its rig's own space: Blender's convention."""

LONGEST_SPINE = 4  # the neck and three bones of the spine
LEG_REACH = 0.25  # of a bone's height above the lowest one: limbs that hang lower are legs
EYE_CONE = 0.5  # cosine: an eye bone that points within 60 degrees of the front is the eye's own axis

HEADS = {"head"}
RIGIFY_NECK = "spines.super_head"
EYES = {"eye", "eyes", "eyeball"}
NOT_EYES = {"lid", "lids", "lash", "lashes", "brow", "brows", "socket", "corner", "bag", "target", "aim", "mch", "org"}
SIGNS = {"POS": 1.0, "NEG": -1.0}


def words(name):
    """The words of a bone's name, small: "mixamorig:LeftEye" has mixamorig, left, eye."""
    return {word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)}


def head_of(rig):
    """Name of the one bone that is called head, or that Rigify takes for it; "" where there is none, or more than one."""
    found = [bone.name for bone in rig.data.bones if words(bone.name) & HEADS]
    plain = [name for name in found if name.lower() == "head"]
    best = plain or found or _rigify_heads(rig)
    return best[0] if len(best) == 1 else ""


def _rigify_heads(rig):
    """A metarig's bones are numbered, such as spine.006; where the neck begins it says so, and the head is its end."""
    necks = [bone for bone in rig.pose.bones if _rigify_type(bone) == RIGIFY_NECK]
    return [_end_of_row(bone.bone).name for bone in necks]


def _rigify_type(bone):
    # A property of the bone while Rigify is on; without it Blender 3 and 4 still have it among the custom ones.
    return getattr(bone, "rigify_type", "") or bone.get("rigify_type", "")


def _end_of_row(bone):
    """The last bone of those that are connected one by one, as Rigify itself follows them."""
    connected = [bone]
    while len(connected) == 1:
        bone = connected[0]
        connected = [child for child in bone.children if child.use_connect]
    return bone


def below(rig, head, count):
    """Names of the `count` bones below the head, from the lowest to the one the head stands on."""
    names = []
    bone = rig.data.bones[head].parent
    while bone and len(names) < count:
        names.append(bone.name)
        bone = bone.parent
    return names[::-1]


def spine_length(rig, head):
    """How many bones below the head are neck and spine: not the root, nor what legs hang from."""
    lowest = min(min(bone.head_local.z, bone.tail_local.z) for bone in rig.data.bones)
    count = 0
    above, bone = rig.data.bones[head], rig.data.bones[head].parent
    while bone and bone.parent and count < LONGEST_SPINE and not _has_legs(bone, above, lowest):
        count += 1
        above, bone = bone, bone.parent
    return count


def _has_legs(bone, above, lowest):
    ground = lowest + LEG_REACH * (bone.head_local.z - lowest)
    limbs = [child for child in bone.children if child != above]
    return any(part.tail_local.z < ground for limb in limbs for part in (limb, *limb.children_recursive))


def eyes_of(rig, head):
    """Names of the eyes below the head, found by their names."""
    found = [bone for bone in rig.data.bones[head].children_recursive
             if words(bone.name) & EYES and not words(bone.name) & NOT_EYES]
    return [bone.name for bone in found if not any(parent in found for parent in bone.parent_recursive)]


def head_forward(rig, name, choice):
    """Unit vector, in the head bone's own space, along which the face looks."""
    return _front_of(rig.data.bones[name]) if choice == 'AUTO' else _axis(choice)


def eyes_forward(rig, names, choice):
    """Unit vector, in the eye bones' own space, along which they look; one for all eyes of a head."""
    if choice != 'AUTO':
        return _axis(choice)
    fronts = [_front_of(rig.data.bones[name]) for name in names]
    if all(front.y > EYE_CONE for front in fronts):
        return Vector((0.0, 1.0, 0.0))
    return sum(fronts, Vector()).normalized()


def _front_of(bone):
    # Exactly the front, not the nearest axis: a head bone that leans would else be turned by as much at rest.
    return (bone.matrix_local.to_3x3().inverted_safe() @ FRONT).normalized()


def _axis(choice):
    sign, letter = choice.split("_")
    return SIGNS[sign] * Vector((letter == "X", letter == "Y", letter == "Z"))
