"""Stereo camera rig: sets a camera's eye distances by a depth budget, and checks how the result looks to an audience."""

from ..core.declare import System
from . import checking, combining, floating, measuring, operators, output, overlay, panel, presets, properties, rig, solve, viewing

SYSTEM = System(
    name="stereo",
    label="Stereo Camera",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_stereo,
    scene_settings=properties.MOTUS_PG_stereo_scene,
    classes=(
        properties.MOTUS_PG_stereo,
        properties.MOTUS_PG_stereo_scene,
        *operators.classes,
        *measuring.classes,
        *checking.classes,
        *output.classes,
        *combining.classes,
        *floating.classes,
        *viewing.classes,
        *presets.classes,
        *panel.classes,
    ),
    inputs=solve.INPUTS,
    owner_types=frozenset({'CAMERA'}),
    solve=solve.solve,
    copied_settings=properties.KEYWORDS,
    adder="motus.stereo_rig_add",
    problems=solve.PROBLEMS,
    outputs=rig.OUTPUTS,
    groups=rig.groups,
    overlay=overlay.overlay,
    add_menu=("motus.stereo_rig_add",),
    object_menu=(
        "motus.stereo_rig_add",
        "motus.stereo_measure",
        "motus.stereo_view",
        "motus.stereo_check",
        "motus.stereo_window",
        "motus.stereo_output",
        "motus.stereo_combine",
        "motus.stereo_rig_remove",
    ),
)
