"""Motion drivers: functions for any driver expression, and operators that put them on any property."""

from ..core.declare import Feature
from ..core.interface.view import graph
from . import functions, menu, operators, panel

FEATURE = Feature(
    name="drivers",
    label="Motion Drivers",
    classes=(*operators.classes, *panel.classes),
    extras=(functions, menu, graph),
    object_menu=("motus.driver_add", "motus.driver_remove"),
)
