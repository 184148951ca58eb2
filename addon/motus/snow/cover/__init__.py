"""Snow cover: a layer of snow on surfaces, which grows with the flakes that land there."""

from ...core.declare import System
from . import build, look, operators, panel, presets, properties, solve

SYSTEM = System(
    name="snow_cover",
    label="Snow Cover",
    page="snow",
    hand_over='FACES',
    settings=properties.MOTUS_PG_snow_cover,
    classes=(
        # Blender has to register property groups before the group that contains them.
        properties.MOTUS_PG_snow_cover_entry,
        properties.MOTUS_PG_snow_cover,
        *operators.classes,
        *presets.classes,
        *panel.classes,
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
    rebuild=build.wire,
    load=lambda settings: 1,
    unbakeable=solve.UNBAKEABLE.sentence,
    object_menu=("motus.snow_cover_add", "motus.snow_cover_remove"),
)
