"""Data paths to the bones of a rig's pose, and poses that Blender has not brought up to date with their armatures yet."""

import re
from typing import Any

import bpy

TO_BONE = r'pose\.bones\[(?:"(?P<bone>(?:[^"\\]|\\.)*)"|(?P<number>\d+))\]'
"""Pattern for how a data path to a pose bone begins: group "bone" is the escaped name of the bone, or "number" the bone's index."""


def bone_named(rig: Any, match: re.Match[str] | None) -> str:
    """Name of the bone to which a data path from a rig leads; "" if it leads to none. match: of a pattern with TO_BONE in it."""
    if match is None:
        return ""
    if match["number"] is None:
        return bpy.utils.unescape_identifier(match["bone"] or "")
    bones, number = rig.pose.bones if rig.pose else (), int(match["number"])
    return bones[number].name if number < len(bones) else ""


def is_pose_outdated(obj: Any) -> bool:
    """Whether an object is a rig whose pose lacks bones of the armature, or has bones that the armature lacks.

    If the users of one armature are given another (ID.user_remap, a reloaded library), Blender makes their poses anew when they are next
    evaluated. A rig that is in no scene is not evaluated; a new rig has no pose at all.
    """
    if obj.type != 'ARMATURE':
        return False
    return obj.pose is None or len(obj.pose.bones) != len(obj.data.bones) or not all(posed.bone for posed in obj.pose.bones)
