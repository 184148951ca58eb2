"""Presets of the pull brush."""

from ..core.interface import presets
from ..core.interface.presets import Preset
from .properties import KEYWORDS

OF_THE_OBJECT = {"vertex_group", "weld"}
NAMES = (*(name for name in KEYWORDS if name not in OF_THE_OBJECT), "use_pressure_strength", "use_pressure_size")

# Radius and strength depend on the object, so that no preset sets them.
BROUGHT = (
    Preset('SOFT', "Soft", "Rounded bumps and dents", {}),
    Preset('GRAB', "Grab", "Takes the surface along with the cursor", {"direction": 'CURSOR'}),
    Preset('HILL', "Hill", "A wide bell, straight up", {"falloff": 'GAUSSIAN', "direction": 'Z'}),
    Preset('PLATEAU', "Plateau", "Moves all vertices within the radius alike", {"falloff": 'CONSTANT', "direction": 'Z'}),
    Preset('THORN', "Thorn", "A sharp tip on a wide foot", {"falloff": 'SHARP'}),
    Preset('SKIN', "Skin", "Measured along the surface, so that lips and fingers stay apart", {"distance": 'SURFACE'}),
    Preset('FACE', "Face", "Pulls along the surface, on both sides of X", {"distance": 'SURFACE', "mirror": {'X'}}),
)

classes = OPERATOR, PANEL, _ = presets.classes(
    "pull", "Pull Brush", (f"bpy.context.scene.motus.pull.{name}" for name in NAMES), BROUGHT, lambda context: context.scene.motus.pull
)
