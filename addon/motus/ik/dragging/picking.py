"""Find the bone under the mouse, and the place along the bone."""

from typing import NamedTuple

from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from . import grab

NEAR = 20.0
"""Distance from the mouse within which a bone is picked, in pixels at a resolution scale of 1."""


class Picked(NamedTuple):
    """Point on a bone that lies under the mouse.

    bone: its name. factor: place along the bone, 0 at its head, 1 at its tail. place: the point in the window's region, pixels.
    """

    bone: str
    factor: float
    place: Vector


def pick(context, rig, region, view, mouse):
    """Picked point on the shown bone that is nearest to the mouse; None if no bone is near. mouse: pixels in the region."""
    matrix = view.perspective_matrix
    depsgraph = context.view_layer.depsgraph
    found, least = None, NEAR * context.preferences.system.ui_scale
    for bone in shown_bones(context, rig):
        ends = [grab.point_on(rig, depsgraph, bone.name, share) for share in (0.0, 1.0)]
        depths = [(matrix @ end.to_4d()).w for end in ends]
        if min(depths) <= 0.0:
            continue
        head, tail = (location_3d_to_region_2d(region, view, end) for end in ends)
        if head is None or tail is None:
            continue
        along = tail - head
        share = (mouse - head).dot(along) / along.length_squared if along.length_squared else 0.0
        share = min(max(share, 0.0), 1.0)
        place = head + share * along
        if (mouse - place).length < least:
            least = (mouse - place).length
            # In perspective, a share of the drawn length of a bone is not the share of its real length.
            nearer = share / depths[1]
            found = Picked(bone.name, nearer / (nearer + (1.0 - share) / depths[0]), place)
    return found


def shown_bones(context, rig):
    """List of the rig's pose bones that the viewport draws."""
    if context.mode == 'POSE':
        return [bone for bone in context.visible_pose_bones or () if bone.id_data == rig]
    return [bone for bone in rig.pose.bones if not _is_hidden(rig.data, bone)]


def _is_hidden(armature, bone):
    # Since Blender 5, `hide` is a property of the pose bone.
    if bone.hide if hasattr(bone, "hide") else bone.bone.hide:
        return True
    if not hasattr(armature, "collections"):
        return not any(on and shown for on, shown in zip(bone.bone.layers, armature.layers))
    return bool(bone.bone.collections) and not any(one.is_visible for one in bone.bone.collections)
