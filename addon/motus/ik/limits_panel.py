"""Part of the IK panel that draws Blender's limits for inverse kinematics of a chain's bones."""

from . import chains

MOST_BONES = 4
"""Number of bones at the end of a chain whose limits are drawn. If a bone of the chain is active, only its limits are drawn."""


def draw(layout, context, entry):
    """Draw the switches and the least and largest angles of the limits of a chain's bones. entry: the chain's entry."""
    rig = context.object
    chain = chains.find(rig, entry)
    if chain is None:
        return
    layout.active = entry.use_limits
    for name in _shown(rig, chain):
        _draw_bone(layout, rig.pose.bones[name])


def _shown(rig, chain):
    active = rig.data.bones.active
    if rig.mode == 'POSE' and active and active.name in chain.bones:
        return [active.name]
    return chain.bones[-MOST_BONES:]


def _draw_bone(layout, bone):
    column = layout.box().column(align=True)
    column.use_property_split = False
    column.label(text=bone.name, icon='BONE_DATA', translate=False)
    for letter in "xyz":
        is_locked, is_limited = getattr(bone, f"lock_ik_{letter}"), getattr(bone, f"use_ik_limit_{letter}")
        row = column.row(align=True)
        row.prop(bone, f"lock_ik_{letter}", text="", icon='LOCKED' if is_locked else 'UNLOCKED')
        limited = row.row(align=True)
        limited.enabled = not is_locked
        limited.prop(bone, f"use_ik_limit_{letter}", text=letter.upper(), toggle=True, translate=False)
        if is_limited and not is_locked:
            # The angles have a row of their own: beside the switches there is no room for three digits.
            angles = column.row(align=True)
            angles.prop(bone, f"ik_min_{letter}", text="")
            angles.prop(bone, f"ik_max_{letter}", text="")
