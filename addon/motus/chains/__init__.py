"""Chains: bones that hang, swing and touch, solved once for the whole scene."""

from ..core.declare import System
from . import groups, operators, over_time, overlay, panel, presets, properties, solve, steps

SYSTEM = System(
    name="chains",
    label="Chains",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_chains,
    classes=(*properties.classes, *operators.classes, *presets.classes, *panel.classes),
    owner_types=frozenset({'ARMATURE'}),
    inputs=solve.INPUTS,
    solve=solve.solve,
    problems=solve.PROBLEMS,
    reads_keys=True,
    entry_settings=properties.KEYWORDS,
    groups=groups.groups,
    entries=groups.entries,
    bone_renamed=groups.bone_renamed,
    over_time=over_time.over_time,
    settle=steps.settle,
    load=lambda settings: len(settings.entries),
    overlay=overlay.overlay,
    extras=(steps,),
    object_menu=("motus.chains_add", "motus.chains_remove"),
    pose_menu=("motus.chains_add", "motus.chains_remove"),
)
