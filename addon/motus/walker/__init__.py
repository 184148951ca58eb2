"""Walker: legs that step by themselves under a body that the artist moves. All steps of the shot are planned in advance."""

from ..core.declare import System
from . import groups, operators, over_time, overlay, panel, presets, properties, solve
from .spider import operators as spider_operators
from .steps import gizmo, operators as step_operators

SYSTEM = System(
    name="walker",
    label="Walker",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_walker,
    classes=(
        *properties.classes,
        *operators.classes,
        *spider_operators.classes,
        *step_operators.classes,
        *gizmo.classes,
        *presets.classes,
        *panel.classes,
    ),
    inputs=solve.INPUTS,
    solve=solve.solve,
    copied_settings=properties.KEYWORDS,
    shot_settings=frozenset(presets.OF_THE_SHOT),
    problems=solve.PROBLEMS,
    reads_keys=True,
    groups=groups.groups,
    entries=groups.entries,
    bone_renamed=groups.bone_renamed,
    over_time=over_time.over_time,
    overlay=overlay.overlay,
    add_menu=("motus.spider_add",),
    object_menu=("motus.walker_add", "motus.walker_remove"),
)
