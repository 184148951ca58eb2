"""What the names of a rig's bones tell: which are the head and the eyes, in rigs of several makers."""

import re

HEADS = {"head"}
RIGIFY_NECK = "spines.super_head"
RIGIFY_SPINE = re.compile(r"(?:ORG-|DEF-)?spine(?:\.(\d{3}))?$")
SHORTEST_METARIG = 5
"""So many bones of the spine a metarig has at least, its neck and head among them."""
ENDS = {"top", "end", "nub", "tip"}
"""Words of bones that only mark where another one ends."""
HELPERS = ("DEF-", "ORG-", "MCH-", "VIS_", "WGT-")
"""Rigify's prefixes of bones that its controls move, the most useful first for a rig that has no controls."""
EYES = {"eye", "eyes", "eyeball"}
NOT_EYES = {"lid", "lids", "lash", "lashes", "brow", "brows", "socket", "corner", "bag", "target", "aim"}


FACE = {"nose", "snout", "muzzle", "beak", "jaw", "chin", "mouth", "lip", "lips", "teeth", "tongue"}
FEET = {"foot", "feet", "toe", "toes", "ball", "ankle", "paw", "hoof"}
LEFT, RIGHT = {"l", "left"}, {"r", "right"}
NOT_PARTS = {"ik", "pole", "target", "roll", "heel", "parent", "spin"}
"""Words of controls, which stand anywhere and point anywhere."""


def words(name):
    """The words of a bone's name, small: "mixamorig:LeftEye" has mixamorig, left, eye."""
    return {word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)}


def parts(bones, wanted):
    """The bones whose names have one of these words, without control bones and markers of ends."""
    return [bone for bone in bones if words(bone.name) & wanted and not words(bone.name) & (NOT_PARTS | ENDS)]


def head_of(rig):
    """Name of the one bone that is called head, or that Rigify takes for it; "" where there is none, or more than one."""
    found = _controls([bone for bone in rig.data.bones if words(bone.name) & HEADS and not words(bone.name) & ENDS])
    plain = [bone for bone in found if bone.name.lower() == "head"]
    best = plain or topmost(found) or _rigify_heads(rig)
    return best[0].name if len(best) == 1 else ""


def eyes_of(bones, head):
    """Names of the eyes below the head, found by their names. bones: of the armature."""
    found = [bone for bone in bones[head].children_recursive if words(bone.name) & EYES and not words(bone.name) & (NOT_EYES | ENDS)]
    return [bone.name for bone in topmost(_controls(found))]


def _controls(bones):
    """The bones of a list that are the furthest from being helpers, by the prefixes of their names (HELPERS)."""
    ranks = [next((rank for rank, prefix in enumerate(HELPERS, 1) if bone.name.startswith(prefix)), 0) for bone in bones]
    return [bone for bone, rank in zip(bones, ranks) if rank == min(ranks)]


def topmost(bones):
    """The bones of a list that are below none of the others."""
    return [bone for bone in bones if not any(parent in bones for parent in bone.parent_recursive)]


def _rigify_heads(rig):
    """A metarig's bones are numbered, such as spine.006. Where the neck begins it says so, and the head is its end.

    From Blender 5 on what a bone says is known only while Rigify is enabled; without it the last number of the spine counts.
    """
    necks = [bone for bone in rig.pose.bones if _rigify_type(bone) == RIGIFY_NECK]
    if necks:
        return [_end_of_row(bone.bone) for bone in necks]
    spine = [bone for bone in rig.data.bones if RIGIFY_SPINE.match(bone.name)]
    return [max(spine, key=lambda bone: bone.name)] if len(spine) >= SHORTEST_METARIG else []


def _rigify_type(bone):
    # A property of the bone while Rigify is on; without it Blender 3 and 4 still have it among the custom ones.
    return getattr(bone, "rigify_type", "") or bone.get("rigify_type", "")


def _end_of_row(bone):
    """The last bone of a row of connected bones, which Rigify follows in the same way."""
    connected = [bone]
    while len(connected) == 1:
        bone = connected[0]
        connected = [child for child in bone.children if child.use_connect]
    return bone
