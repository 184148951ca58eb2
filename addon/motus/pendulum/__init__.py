"""Pendulums: single pendulums, double pendulums and fans of double pendulums, on pivots that may be moved.

A fan is a number of double pendulums on one pivot that differ slightly in their starting angles. A pendulum has one or two rods with
a bob at the end of each.
"""

from ..core.declare import System
from . import build, drag, operators, over_time, overlay, panel, parts, presets, properties, solve, trail

SYSTEM = System(
    name="pendulum",
    label="Pendulum",
    page="pendulums",
    hand_over='KEYS',
    settings=properties.MOTUS_PG_pendulum,
    classes=(
        # Blender has to know a property group before the property group that contains it is registered.
        properties.MOTUS_PG_pendulum_rod,
        properties.MOTUS_PG_pendulum,
        *operators.classes,
        *drag.classes,
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
    channels=lambda settings: frozenset({"rotation"}),
    members=parts.members,
    member_data=parts.numbers,
    is_relative=True,
    same_bits=True,
    over_time=over_time.over_time,
    load=lambda settings: max(1, settings.count) if parts.rods_each(settings) == 2 else 1,
    owner_of=parts.pivot_of,
    rebuild=build.rebuild,
    overlay=overlay.overlay,
    add_menu=("motus.pendulum_add",),
    object_menu=("motus.pendulum_add", "motus.pendulum_play", "motus.pendulum_drag", "motus.pendulum_remove"),
)

TRAILS = System(
    name="pendulum_trail",
    label="Pendulum Trails",
    page="pendulums",
    hand_over='POINTS',
    settings=properties.MOTUS_PG_pendulum_trail,
    classes=(properties.MOTUS_PG_pendulum_trail, *panel.trail_classes),
    inputs=trail.INPUTS,
    solve=trail.make,
    problems=trail.PROBLEMS,
    reads_keys=True,
    makes_points=trail.POINTS,
    dress=trail.dress,
    unbakeable=trail.UNBAKEABLE.sentence,
)
