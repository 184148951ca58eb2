"""Presets for the settings of a chain."""

import math

from ..core.interface import presets
from ..core.interface.bone_entries import selected
from ..core.interface.presets import Preset
from .properties import KEYWORDS

ENTRY = "bpy.context.object.motus.chains.entries[bpy.context.object.motus.chains.active_entry]"


def _preset(identifier, label, description, **values):
    return Preset(identifier, label, description, values)


BROUGHT = (
    _preset(
        'TAIL',
        "Dog's Tail",
        "Stiff at its root, loose at its tip",
        frequency=2.5,
        tip_frequency=0.4,
        damping=0.25,
        gravity=0.4,
        drag=0.5,
        bend_limit=math.radians(40.0),
    ),
    _preset(
        'PONYTAIL',
        "Ponytail",
        "Hangs, with a little of its shape",
        frequency=0.6,
        tip_frequency=0.3,
        damping=0.5,
        drag=1.5,
        bend_limit=math.radians(60.0),
    ),
    _preset('ROPE', "Rope", "Limp: hangs by its weight alone", frequency=0.0, drag=0.3),
    _preset(
        'ANTENNA',
        "Antenna",
        "Springs back, and trembles for long",
        frequency=4.0,
        tip_frequency=0.7,
        damping=0.08,
        response=0.5,
        gravity=0.3,
        drag=0.2,
    ),
    _preset(
        'CAPE',
        "Cape Strip",
        "Hangs, and is carried by the air",
        frequency=0.3,
        damping=0.6,
        drag=4.0,
        bend_limit=math.radians(70.0),
    ),
    _preset('EARRING', "Earring", "Limp, with a heavy end", frequency=0.0, drag=0.6, tip_mass=4.0),
    _preset(
        'TENTACLE',
        "Tentacle",
        "Follows slowly, as in water",
        frequency=0.9,
        tip_frequency=0.5,
        damping=0.8,
        gravity=0.1,
        drag=3.0,
        bend_limit=math.radians(50.0),
    ),
    _preset(
        'JELLY',
        "Jelly",
        "Single bones that bounce in place and keep their volume: bellies, cheeks, slime",
        frequency=2.5,
        damping=0.15,
        gravity=0.3,
        drag=0.2,
        stretch=1.0,
        squash=1.0,
    ),
)

classes = OPERATOR, PANEL, _ = presets.classes(
    "chains", "Chains", (f"{ENTRY}.{name}" for name in KEYWORDS), BROUGHT, lambda context: selected(context, "chains")
)
