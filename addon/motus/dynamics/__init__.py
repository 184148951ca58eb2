"""Dynamics: objects and bones follow their animation as a mass on a spring does, exact at any frame."""

from ..core.declare import System
from . import groups, menu, operators, over_time, panel, presets, properties, solve

SYSTEM = System(
    name="dynamics",
    label="Dynamics",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_dynamics,
    classes=(*properties.classes, *operators.classes, *presets.classes, *panel.classes),
    solve=solve.solve,
    problems=solve.PROBLEMS,
    reads_keys=True,
    copied_settings=(*properties.KEYWORDS, "mass", "shape"),
    adder="motus.dynamics_add",
    groups=groups.groups,
    entries=groups.entries,
    bone_renamed=groups.bone_renamed,
    over_time=over_time.over_time,
    load=lambda settings: len(settings.entries),
    extras=(menu,),
    object_menu=("motus.dynamics_add", "motus.dynamics_remove"),
    pose_menu=("motus.dynamics_add", "motus.dynamics_remove"),
)
