"""Find the head, the eyes and other parts of a rig by the names of its bones, as several rigging programs name them."""

import re

HEADS = {"head"}
RIGIFY_NECK = "spines.super_head"
RIGIFY_SPINE = re.compile(r"(?:ORG-|DEF-)?spine(?:\.(\d{3}))?$")
SHORTEST_METARIG = 5
"""Least number of bones in the spine of a Rigify metarig, with neck and head."""
ENDS = {"top", "end", "nub", "tip"}
"""Words in the names of bones that only mark the end of their parent bone."""
HELPERS = ("DEF-", "ORG-", "MCH-", "VIS_", "WGT-")
"""Prefixes of bones that Rigify's control bones move. For a rig without control bones, the first prefix is the most useful."""
EYES = {"eye", "eyes", "eyeball"}
NOT_EYES = {"lid", "lids", "lash", "lashes", "brow", "brows", "socket", "corner", "bag", "target", "aim"}


LIDS = {"lid", "lids", "eyelid", "eyelids"}
LOWER = {"b", "bot", "bottom", "low", "lower", "down"}
"""Words in the names of lower eyelids."""
FACE = {"nose", "snout", "muzzle", "beak", "jaw", "chin", "mouth", "lip", "lips", "teeth", "tongue"}
FEET = {"foot", "feet", "toe", "toes", "ball", "ankle", "paw", "hoof"}
LEFT, RIGHT = {"l", "left"}, {"r", "right"}
NOT_PARTS = {"ik", "pole", "target", "roll", "heel", "parent", "spin"}
"""Words in the names of control bones, whose place and direction tell nothing about the body."""


def words(name):
    """Set of the words in a bone's name, in lower case: "mixamorig:LeftEye" has mixamorig, left, eye."""
    return {word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)}


def parts(bones, wanted):
    """List of the bones whose names have one of the wanted words, without control bones (NOT_PARTS) and end markers (ENDS)."""
    return [bone for bone in bones if words(bone.name) & wanted and not words(bone.name) & (NOT_PARTS | ENDS)]


def head_of(rig):
    """Name of the rig's head bone, found by its name or by Rigify's rules; "" if there is none, or more than one."""
    found = _controls([bone for bone in rig.data.bones if words(bone.name) & HEADS and not words(bone.name) & ENDS])
    plain = [bone for bone in found if bone.name.lower() == "head"]
    best = plain or topmost(found) or _rigify_heads(rig)
    return best[0].name if len(best) == 1 else ""


def lids_of(bones, head):
    """Names of the bones below a head bone that are called eyelids, without those that hang on another eyelid."""
    return [bone.name for bone in topmost(_controls(parts(bones[head].children_recursive, LIDS)))]


def eyes_of(bones, head):
    """Names of the eye bones among the descendants of a head bone, found by their names. bones: the armature's bones."""
    found = [bone for bone in bones[head].children_recursive if words(bone.name) & EYES and not words(bone.name) & (NOT_EYES | ENDS)]
    return [bone.name for bone in topmost(_controls(found))]


def _controls(bones):
    """The bones of a list whose names have no prefix of HELPERS; if all have one, the bones with the earliest such prefix."""
    ranks = [next((rank for rank, prefix in enumerate(HELPERS, 1) if bone.name.startswith(prefix)), 0) for bone in bones]
    return [bone for bone, rank in zip(bones, ranks) if rank == min(ranks)]


def topmost(bones):
    """The bones of a list that have no ancestor in the list."""
    return [bone for bone in bones if not any(parent in bones for parent in bone.parent_recursive)]


def _rigify_heads(rig):
    """List of the head bones of a Rigify metarig; empty if the rig is none.

    The spine bones of a metarig have numbers, such as spine.006. A neck begins at a bone whose Rigify type is RIGIFY_NECK, and the
    last bone connected to it is the head. From Blender 5 on, Rigify types are known only while Rigify is enabled. If no neck is
    found, the head is the spine bone with the highest number.
    """
    necks = [bone for bone in rig.pose.bones if _rigify_type(bone) == RIGIFY_NECK]
    if necks:
        return [_end_of_row(bone.bone) for bone in necks]
    spine = [bone for bone in rig.data.bones if RIGIFY_SPINE.match(bone.name)]
    return [max(spine, key=lambda bone: bone.name)] if len(spine) >= SHORTEST_METARIG else []


def _rigify_type(bone):
    # While Rigify is enabled, rigify_type is a property of pose bones; otherwise Blender 3 and 4 keep it as a custom property.
    return getattr(bone, "rigify_type", "") or bone.get("rigify_type", "")


def _end_of_row(bone):
    """Last bone of the row of connected bones that begins at a bone, without branches. Rigify finds the end of a row by the same rule."""
    connected = [bone]
    while len(connected) == 1:
        bone = connected[0]
        connected = [child for child in bone.children if child.use_connect]
    return bone
