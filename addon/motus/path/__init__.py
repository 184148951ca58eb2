"""Follow Path: moves objects along curves by arc length, with easing, banking, trains, and pins that set the place at given frames."""

from ..core.declare import System
from . import bends, bezier, edit_views, lists, members, operators, over_time, overlay, panel, presets, properties, solve, train

SYSTEM = System(
    name="path",
    label="Follow Path",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_path,
    classes=(
        # A PropertyGroup is registered before the groups that contain it.
        properties.MOTUS_PG_path_pin,
        properties.MOTUS_PG_path_speed,
        properties.MOTUS_PG_path_wagon,
        properties.MOTUS_PG_path,
        *operators.classes,
        *lists.classes,
        *bends.classes,
        *train.classes,
        *bezier.classes,
        *edit_views.classes,
        *presets.classes,
        *panel.classes,
    ),
    inputs=solve.INPUTS,
    solve=solve.solve,
    copied_settings=properties.KEYWORDS,
    shot_settings=frozenset(presets.OF_THE_SHOT),
    problems=solve.PROBLEMS,
    reads_keys=True,
    outputs=solve.OUTPUTS,
    channels=members.channels,
    members=members.members,
    member_data=members.offsets,
    over_time=over_time.over_time,
    shared=solve.SHARED,
    solve_rows=solve.solve_rows,
    overlay=overlay.overlay,
    extras=(edit_views,),
    add_menu=("motus.path_new_bezier",),
    object_menu=("motus.path_follow_add", "motus.path_train_add", "motus.path_follow_remove", "motus.path_edit_views"),
)
