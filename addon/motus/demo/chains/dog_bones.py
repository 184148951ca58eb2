"""The armature of the dog: it faces +Y, its origin is on the ground below its middle, and its tail and ears are rows of bones."""

from ..stage import bones

NAME = "Dog"
BODY, NECK, HEAD, WAG, TAIL, LEASH = "body", "neck", "head", "wag", "tail", "leash"
EARS = ("ear.L", "ear.R")
FOOT, LOWER, UPPER = "foot", "lower", "upper"
"""First words of the names of a leg's bones; a name of LEGS follows."""
KNEES = "knees"

BODY_BONE = (0.0, -0.21, 0.40), (0.0, 0.17, 0.41)
NECK_BONE = (0.0, 0.17, 0.42), (0.0, 0.30, 0.58)
HEAD_BONE = (0.0, 0.30, 0.58), (0.0, 0.48, 0.62)
WAG_BONE = (0.0, -0.27, 0.445), (0.0, -0.31, 0.485)
TAIL_WAY = ((0.0, -0.31, 0.485), (0.0, -0.365, 0.555), (0.0, -0.395, 0.645), (0.0, -0.385, 0.745), (0.0, -0.345, 0.825))
EAR_WAY = ((0.088, 0.310, 0.700), (0.130, 0.312, 0.690), (0.158, 0.322, 0.635), (0.166, 0.335, 0.565), (0.160, 0.350, 0.490))
TAIL_BONES, EAR_BONES = 7, 5
# Of each leg on the right, at +X: root, knee and ankle. The legs on the left are mirrored.
FORELEG = (0.088, 0.140, 0.340), (0.094, 0.082, 0.205), (0.094, 0.140, 0.068)
HIND_LEG = (0.090, -0.200, 0.360), (0.102, -0.138, 0.215), (0.100, -0.225, 0.070)
LEGS = {" 1.L": (FORELEG, -1.0), " 1.R": (FORELEG, 1.0), " 2.L": (HIND_LEG, -1.0), " 2.R": (HIND_LEG, 1.0)}


def leg(name):
    """Return the places of the root, the knee and the ankle of a leg in rest pose. name: of LEGS."""
    places, side = LEGS[name]
    return [(side * x, y, z) for x, y, z in places]


def ear_way(name):
    """Return the points that an ear hangs along in rest pose. name: of EARS."""
    side = -1.0 if name == EARS[0] else 1.0
    return [(side * x, y, z) for x, y, z in EAR_WAY]


def build(context, collection, leash):
    """Make the dog's armature object. leash: places of the leash's bones in rest pose, (count + 1, 3), from the collar on."""
    armature = bones.Armature(context, collection, NAME)
    with armature:
        armature.add(BODY, "", *BODY_BONE)
        armature.add(NECK, BODY, *NECK_BONE)
        armature.add(HEAD, NECK, *HEAD_BONE)
        armature.add(WAG, BODY, *WAG_BONE)
        armature.add_row(TAIL, WAG, bones.along(TAIL_WAY, TAIL_BONES + 1))
        armature.add_row(LEASH, NECK, leash)
        for ear in EARS:
            armature.add_row(ear, HEAD, bones.along(ear_way(ear), EAR_BONES + 1))
        for name in LEGS:
            root, knee, ankle = leg(name)
            armature.add(UPPER + name, BODY, root, knee)
            armature.add(LOWER + name, UPPER + name, knee, ankle)
            x, y, z = ankle
            armature.add(FOOT + name, "", ankle, (x, y + 0.06, z))
    return armature.object
