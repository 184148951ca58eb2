"""Hand Over: writes a copy of the file that plays the same without Motus, for render farms and other programs."""

from ..core.declare import Feature
from . import operators, panel

FEATURE = Feature(name="hand_over", label="Hand Over", classes=(*operators.classes, *panel.classes), extras=(operators.ExportMenu,))
