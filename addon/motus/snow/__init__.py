"""Snow: flakes that are computed anew on each frame, without a cache, in any order of frames."""

from ..core.system import System
from . import cover, gizmo, landings, look, operators, overlay, panel, presets, properties, solve

SYSTEM = System(
    name="snow",
    label="Snow",
    settings=properties.MOTUS_PG_snow,
    classes=(
        # The group before the one that holds it.
        properties.MOTUS_PG_snow_stop, properties.MOTUS_PG_snow,
        *operators.classes, *presets.classes, *panel.classes, *gizmo.classes,
    ),
    inputs=solve.INPUTS,
    solve=solve.solve,
    problems=solve.PROBLEMS,
    makes_points=solve.POINTS,
    dress=look.dress,
    settle=landings.settle,
    unbakeable=solve.UNBAKEABLE.sentence,
    overlay=overlay.overlay,
    extras=(landings,),
    add_menu=("motus.snow_add",),
    object_menu=("motus.snow_remove",),
)

COVER = cover.SYSTEM
