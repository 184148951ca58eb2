"""Presets of a snow cover's settings: those that Motus brings, and those that users save."""

import math

from ...core.interface import presets
from ...core.interface.presets import Preset
from .properties import KEYWORDS

# Settings that presets leave unchanged, as they belong to one shot or one surface and not to a style.
OF_THE_SHOT = {"resolution", "viewport_resolution", "depth_group", "influence"}

BROUGHT = (
    Preset(
        'DUSTING',
        "Dusting",
        "A thin veil in which single flakes show, blown off slopes",
        {"lump": 0.05, "repose": math.radians(35.0), "smoothing": 0.1, "thinnest": 0.002},
    ),
    Preset(
        'POWDER',
        "Powder",
        "Loose snow, soft and even, that steep roofs shed",
        {"lump": 0.1, "repose": math.radians(40.0), "smoothing": 0.35, "thinnest": 0.004},
    ),
    Preset(
        'WET',
        "Wet Snow",
        "Sticks in heaps to all that is not quite upright",
        {"lump": 0.12, "repose": math.radians(68.0), "smoothing": 0.15, "thinnest": 0.006},
    ),
    Preset(
        'DEEP',
        "Deep Winter",
        "Grows fast into thick round cushions",
        {"lump": 0.22, "repose": math.radians(50.0), "smoothing": 0.45, "thinnest": 0.006},
    ),
    Preset(
        'FOOTPRINTS',
        "Footprints",
        "Even snow in which feet leave clear prints, packed below",
        {"lump": 0.12, "repose": math.radians(45.0), "smoothing": 0.5, "thinnest": 0.004, "packed": 0.03},
    ),
    Preset(
        'SWEPT',
        "Swept Road",
        "What passes sweeps all snow away, down to the surface",
        {"lump": 0.12, "repose": math.radians(45.0), "smoothing": 0.4, "thinnest": 0.004, "packed": 0.0},
    ),
)
SETTINGS = "bpy.context.object.motus.snow_cover"


def _settings(context):
    settings = context.object and context.object.motus.snow_cover
    return settings if settings and settings.is_active else None


classes = OPERATOR, PANEL, _ = presets.classes(
    "snow_cover", "Snow Cover", (f"{SETTINGS}.{name}" for name in KEYWORDS if name not in OF_THE_SHOT), BROUGHT, _settings
)
