"""Look At: spine, head and eyes of a rig share the turn to a target, each by its weight and within its limits."""

from ..core.declare import System
from . import groups, operators, over_time, overlay, panel, presets, properties, solve

SYSTEM = System(
    name="look_at",
    label="Look At",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_look_at,
    classes=(
        # Blender requires that a property group is registered before the group that contains it.
        properties.MOTUS_PG_look_at_eye,
        properties.MOTUS_PG_look_at_lid,
        properties.MOTUS_PG_look_at_target,
        properties.MOTUS_PG_look_at_entry,
        properties.MOTUS_PG_look_at,
        *operators.classes,
        *presets.classes,
        *panel.classes,
    ),
    owner_types=frozenset({'ARMATURE'}),
    solve=solve.solve,
    copied_settings=properties.KEYWORDS,
    shot_settings=frozenset(presets.OF_THE_HEAD),
    problems=solve.PROBLEMS,
    reads_keys=groups.has_blinks,
    members=groups.members,
    groups=groups.groups,
    entries=groups.entries,
    bone_renamed=groups.bone_renamed,
    over_time=over_time.over_time,
    overlay=overlay.overlay,
    object_menu=("motus.look_at_add", "motus.look_at_remove"),
    pose_menu=("motus.look_at_add", "motus.look_at_remove"),
)
