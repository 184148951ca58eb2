"""Pick & Pull: sculpts meshes by pulling vertices, and keeps pulls as pins, which can be animated."""

from ..core.declare import System
from . import grid, operators, panel, presets, properties
from .pins import (
    apply as pins_apply,
    dragging as pins_dragging,
    gizmo as pins_gizmo,
    operators as pins_operators,
    overlay as pins_overlay,
    panel as pins_panel,
    properties as pins_properties,
    setup as pins_setup,
    solve as pins_solve,
)
from .window import adjust, tool

SYSTEM = System(
    name="pull",
    label="Pick & Pull",
    hand_over='POINTS',
    settings=pins_properties.MOTUS_PG_pull,
    scene_settings=properties.MOTUS_PG_brush,
    classes=(
        # A PropertyGroup is registered before the groups that contain it.
        *properties.classes,
        *pins_properties.classes,
        *operators.classes,
        *adjust.classes,
        *grid.classes,
        *pins_operators.classes,
        *pins_apply.classes,
        *pins_dragging.classes,
        *pins_gizmo.classes,
        *presets.classes,
        *panel.classes,
        *pins_panel.classes,
    ),
    inputs=pins_solve.INPUTS,
    owner_types=frozenset({'MESH'}),
    solve=pins_solve.solve,
    problems=pins_solve.PROBLEMS,
    groups=pins_solve.groups,
    moves_points=True,
    unbakeable=pins_solve.UNBAKEABLE,
    settle=pins_setup.settle,
    overlay=pins_overlay.overlay,
    extras=(tool,),
    add_menu=("motus.grid_add",),
    object_menu=("motus.pick_pull", "motus.pin_add"),
)
