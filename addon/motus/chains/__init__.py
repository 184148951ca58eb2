"""Chains: bones, objects in a row and points of curves that hang, swing and touch, solved once for the whole scene."""

from ..core.declare import System
from . import along, groups, naming, operators, over_time, overlay, panel, presets, properties, setup, solve, steps

SYSTEM = System(
    name="chains",
    label="Chains",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_chains,
    classes=(*properties.classes, *operators.classes, *presets.classes, *panel.classes),
    inputs=solve.INPUTS,
    solve=solve.solve,
    problems=solve.PROBLEMS,
    reads_keys=True,
    copied_settings=(*properties.KEYWORDS, "weight", "hold_end"),
    shot_settings=frozenset({"weight", "hold_end"}),
    adder="motus.chains_add",
    groups=groups.groups,
    entries=groups.entries,
    prepare=setup.prepare,
    take_over=along.take_over,
    bone_renamed=naming.bone_renamed,
    over_time=over_time.over_time,
    settle=steps.settle,
    load=groups.load,
    overlay=overlay.overlay,
    extras=(steps,),
    object_menu=("motus.chains_add", "motus.chains_remove"),
    pose_menu=("motus.chains_add", "motus.chains_mirror", "motus.chains_remove"),
)
