"""Which bone lies under the mouse, and where along it."""

from typing import NamedTuple

from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from . import grab

NEAR = 20.0
"""Pixels, at the interface's normal size."""


class Picked(NamedTuple):
    """factor: place along the bone, 0 to 1. place: the same in the window's region, pixels."""

    bone: str
    factor: float
    place: Vector


def view_at(window, x, y):
    """(region, its RegionView3D) of the 3D viewport at a place of the window; None where there is another thing."""
    for area in window.screen.areas:
        if area.type != 'VIEW_3D' or not _contains(area, x, y):
            continue
        # The sidebar and the toolbar may lie over the viewport.
        found = [region for region in area.regions if _contains(region, x, y)]
        if found and all(region.type == 'WINDOW' for region in found):
            return found[0], found[0].data
    return None


def _contains(part, x, y):
    return part.x <= x < part.x + part.width and part.y <= y < part.y + part.height


def pick(context, rig, region, view, mouse):
    """The shown bone that is nearest to the mouse, a place in the region; None where none is near."""
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
            # A share of the picture of a line is not that of the line where it recedes.
            nearer = share / depths[1]
            found = Picked(bone.name, nearer / (nearer + (1.0 - share) / depths[0]), place)
    return found


def shown_bones(context, rig):
    """The rig's bones that are drawn."""
    if context.mode == 'POSE':
        return [bone for bone in context.visible_pose_bones or () if bone.id_data == rig]
    return [bone for bone in rig.pose.bones if not _is_hidden(rig.data, bone)]


def _is_hidden(armature, bone):
    # The switch is the pose bone's own since Blender 5.
    if bone.hide if hasattr(bone, "hide") else bone.bone.hide:
        return True
    if not hasattr(armature, "collections"):
        return not any(on and shown for on, shown in zip(bone.bone.layers, armature.layers))
    return bool(bone.bone.collections) and not any(one.is_visible for one in bone.bone.collections)
