"""Motion drivers: functions that any driver expression can call, and operators that add such drivers to properties."""

from ..core.declare import Feature
from ..core.interface.view import graph
from . import functions, menu, operators, panel

FEATURE = Feature(
    name="drivers",
    label="Motion Drivers",
    hand_over='PLAIN',
    classes=(*operators.classes, *panel.classes),
    extras=(functions, menu, graph),
    object_menu=("motus.driver_add", "motus.driver_write_out", "motus.driver_remove"),
)
