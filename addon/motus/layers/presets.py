"""Presets for the settings of an animation layer."""

from ..core.interface import presets
from ..core.interface.presets import Preset
from ..core.settings.entries import active

ENTRY = "bpy.context.object.motus.layers.entries[bpy.context.object.motus.layers.active_entry]"
OF_A_STYLE = "mode", "speed", "after", "blend_in", "blend_out", "reference", "in_armature", "feather"
"""Settings of a layer that a preset stores: those that do not depend on the action or shot."""

BROUGHT = (
    Preset('PLAIN', "Plain", "Takes the place of what lies beneath, from its first frame to its last", {}),
    Preset(
        'GESTURE',
        "Gesture",
        "Comes and goes softly, and is held steady over hips that swing",
        {"blend_in": 6.0, "blend_out": 10.0, "in_armature": True, "feather": 2},
    ),
    Preset('POSE', "Pose to Keep", "Grows over twelve frames, and the last pose stays", {"after": 'HOLD', "blend_in": 12.0, "feather": 1}),
    Preset('CYCLE', "Cycle", "Repeats without an end", {"after": 'REPEAT', "blend_in": 6.0}),
    Preset(
        'ON_TOP', "On Top", "Adds what the action does beyond its first frame, again and again", {"mode": 'ADDITIVE', "after": 'REPEAT'}
    ),
)

classes = OPERATOR, PANEL, _ = presets.classes(
    "layers", "Animation Layers", (f"{ENTRY}.{name}" for name in OF_A_STYLE), BROUGHT, lambda context: active(context.object, "layers")
)
