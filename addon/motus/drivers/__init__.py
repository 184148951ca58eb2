"""Motion drivers: functions for any driver expression, and operators that put them on any property."""

from ..core import graph
from ..core.system import Feature
from . import functions, menu, operators, panel

FEATURE = Feature(
    name="drivers",
    label="Motion Drivers",
    classes=(*operators.classes, *panel.classes),
    extras=(functions, menu, graph),
    object_menu=("motus.driver_add", "motus.driver_remove"),
)
