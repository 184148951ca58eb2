"""Inverse kinematics: chains of bones that reach for targets, with weights, poles, limits, softness and stretch."""

from ..core.declare import System
from . import groups, offers, operators, over_time, overlay, panel, presets, properties, solve
from .checking import operators as checking_operators
from .dragging import operators as dragging_operators, tool as dragging_tool
from .goals import pole_operator
from .matching import operators as matching_operators
from .switching import operators as switching_operators

SYSTEM = System(
    name="ik",
    label="Inverse Kinematics",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_ik,
    classes=(
        # Blender requires that a property group is registered before the group that contains it.
        *properties.classes,
        *operators.classes,
        *presets.classes,
        *panel.classes,
        *matching_operators.classes,
        *switching_operators.classes,
        *dragging_operators.classes,
        *checking_operators.classes,
        *pole_operator.classes,
    ),
    owner_types=frozenset({'ARMATURE'}),
    solve=solve.solve,
    copied_settings=presets.COPIED,
    shot_settings=frozenset(presets.COPIED) - set(presets.STYLE),
    problems=solve.PROBLEMS,
    groups=groups.groups,
    entries=groups.entries,
    bone_renamed=groups.bone_renamed,
    over_time=over_time.over_time,
    overlay=overlay.overlay,
    offers=offers,
    extras=(dragging_tool,),
    object_menu=("motus.ik_add", "motus.ik_remove"),
    pose_menu=(
        "motus.ik_add",
        "motus.ik_remove",
        "motus.ik_drag",
        None,
        "motus.ik_match_fk",
        "motus.fk_match_ik",
        "motus.ik_switch_target",
        "motus.ik_check",
        None,
    ),
)
