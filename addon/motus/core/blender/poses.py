"""Poses of rigs that Blender has not brought up to date with their armatures yet."""

from typing import Any


def is_pose_outdated(obj: Any) -> bool:
    """Whether an object is a rig whose pose lacks bones of the armature, or has bones that the armature lacks.

    If the users of one armature are given another (ID.user_remap, a reloaded library), Blender makes their poses anew when they are next
    evaluated. A rig that is in no scene is not evaluated; a new rig has no pose at all.
    """
    if obj.type != 'ARMATURE':
        return False
    return obj.pose is None or len(obj.pose.bones) != len(obj.data.bones) or not all(posed.bone for posed in obj.pose.bones)
