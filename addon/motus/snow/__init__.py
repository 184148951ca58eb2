"""Snow: falling flakes that are computed anew on each frame, without a cache, so that frames can be shown in any order."""

from ..core.declare import System
from . import air, build, colliders, cover, gizmo, landings, look, operators, overlay, panel, presets, properties, solve

SYSTEM = System(
    name="snow",
    label="Snow",
    hand_over='POINTS',
    settings=properties.MOTUS_PG_snow,
    former_names=properties.FORMER_NAMES,
    classes=(
        # Blender has to register property groups before the group that contains them.
        properties.MOTUS_PG_snow_stop,
        properties.MOTUS_PG_snow_recorded,
        properties.MOTUS_PG_snow_collider,
        properties.MOTUS_PG_snow,
        *operators.classes,
        *presets.classes,
        *panel.classes,
        *gizmo.classes,
    ),
    inputs=solve.INPUTS,
    groups=build.groups,
    solve=solve.solve,
    copied_settings=properties.KEYWORDS,
    shot_settings=frozenset(presets.OF_THE_SHOT),
    problems=solve.PROBLEMS,
    reads_keys=True,
    makes_points=solve.POINTS,
    dress=look.dress,
    settle=build.settle,
    rebuild=build.rebuild,
    unbakeable=solve.UNBAKEABLE.sentence,
    load=lambda settings: 1 if colliders.are_any(settings) else 0,
    overlay=overlay.overlay,
    offers=air,
    extras=(landings,),
    add_menu=("motus.snow_add",),
    object_menu=("motus.snow_remove",),
)

COVER = cover.SYSTEM
