"""Presets of snow: those that Motus brings, and those that users save."""

import math

from ..core.interface import presets
from ..core.measures import scene_time
from ..core.settings import lists
from .properties import KEYWORDS, WHITE

PLAIN = 'PLAIN'
_STILL = {"start_speed": 0.0, "looping": True, "random_size": True, "random_lifetime": True}
_DRIFTING = _STILL | {"use_steering": True, "steering_per_flake": True}

KINDS = (  # identifier, label, description, settings, gradient
    (PLAIN, "Plain", "All settings at their defaults: flakes that fly straight", {}, ((0.0, WHITE),)),
    (
        'GENTLE',
        "Gentle Snow",
        "Large flakes that come down slowly on a calm evening",
        _DRIFTING
        | {
            "start_speed": 1.1,
            "lifetime": 9.0,
            "rate": 220.0,
            "emitter_radius": 6.0,
            "random_speed": False,
            "max_angle": math.radians(60.0),
            "steering_frequency": 0.35,
            "tumble": 2.0,
            "flake_width": 0.05,
            "turbulence": 0.15,
            "turbulence_size": 3.0,
        },
        ((0.0, WHITE),),
    ),
    (
        'BLIZZARD',
        "Blizzard",
        "Small flakes that gusts drive across",
        _DRIFTING
        | {
            "start_speed": 4.0,
            "random_speed": True,
            "lifetime": 4.0,
            "rate": 4000.0,
            "emitter_radius": 10.0,
            "drag": 1.5,
            "wind": (9.0, 2.0, -3.0),
            "gusts": 0.5,
            "gust_frequency": 0.4,
            "max_angle": math.radians(35.0),
            "steering_frequency": 1.5,
            "turbulence": 1.2,
            "turbulence_size": 4.0,
            "tumble": 8.0,
            "flake_width": 0.03,
        },
        ((0.0, WHITE),),
    ),
    (
        'WET',
        "Wet Snow",
        "Heavy flakes that fall fast and nearly straight",
        _DRIFTING
        | {
            "start_speed": 3.2,
            "random_speed": True,
            "lifetime": 4.0,
            "rate": 500.0,
            "emitter_radius": 6.0,
            "max_angle": math.radians(15.0),
            "steering_frequency": 0.8,
            "tumble": 3.0,
            "flake_width": 0.045,
        },
        ((0.0, (0.86, 0.90, 0.95, 1.0)),),
    ),
    (
        'DUST',
        "Indoor Dust",
        "Specks that hang in the light of a room",
        _DRIFTING
        | {
            "start_speed": 0.03,
            "shape": 'BOX',
            "emitter_radius": 2.0,
            "lifetime": 12.0,
            "rate": 120.0,
            "max_angle": math.pi,
            "steering_frequency": 0.2,
            "turbulence": 0.06,
            "turbulence_size": 1.0,
            "tumble": 0.5,
            "flake_width": 0.006,
            "look": 'SPECK',
        },
        ((0.0, (1.0, 0.93, 0.80, 1.0)),),
    ),
    (
        'PETALS',
        "Petals",
        "Blossom that tumbles down in a light breeze",
        _DRIFTING
        | {
            "start_speed": 0.9,
            "lifetime": 7.0,
            "rate": 60.0,
            "emitter_radius": 4.0,
            "drag": 0.8,
            "wind": (0.8, 0.2, -0.8),
            "gusts": 0.6,
            "max_angle": math.radians(75.0),
            "steering_frequency": 0.5,
            "tumble": 5.0,
            "flake_width": 0.04,
            "random_color": True,
            "look": 'PETAL',
        },
        ((0.0, (1.0, 0.60, 0.70, 1.0)), (1.0, (1.0, 0.90, 0.93, 1.0))),
    ),
    (
        'SPARKS',
        "Sparks",
        "Glowing specks that fly up from a fire and fall back",
        _STILL
        | {
            "start_speed": 4.5,
            "random_speed": True,
            "shape": 'DISC',
            "emitter_radius": 0.2,
            "cone_angle": math.radians(25.0),
            "random_orientation": True,
            "lifetime": 1.6,
            "rate": 200.0,
            "gravity": True,
            "drag": 0.6,
            "turbulence": 0.5,
            "turbulence_size": 0.6,
            "flake_width": 0.015,
            "random_color": True,
            "look": 'SPARK',
        },
        ((0.0, (1.0, 0.22, 0.02, 1.0)), (1.0, (1.0, 0.75, 0.25, 1.0))),
    ),
)
ITEMS = tuple((identifier, label, told) for identifier, label, told, _, _ in KINDS)
NUMBERS = {identifier: numbers for identifier, _, _, numbers, _ in KINDS}
_GRADIENTS = {identifier: gradient for identifier, _, _, _, gradient in KINDS}

# Settings that presets of the user leave out, as they belong to one shot and not to a style.
_OF_TIME = {"start_frame", "time_speed", "use_loop", "loop_start", "loop_end"}
OF_THE_SHOT = _OF_TIME | {"delay", "use_ground", "ground", "all_attributes", "preview", "influence", "seed", "look"}
LEFT_ALONE = _OF_TIME | {
    "emitter_velocity",
    "use_local",
    "use_scale",
    "all_attributes",
    "preview",
    "influence",
    "seed",
    "use_ground",
    "ground",
    "collision",
    "melt_time",
    "friction",
    "closest",
    "farthest",
}
"""Settings that the presets of KINDS leave unchanged."""
CHOSEN = 'OBJECT', 'COLLECTION', 'POINTS'
"""Looks that the presets of KINDS leave unchanged, together with the flakes' width: the user has chosen them."""


def put(settings, identifier, scene):
    """Set an emitter's settings to the values of a preset; settings that the preset does not name get their defaults.

    The start frame is set so that flakes are already in the air on the scene's first frame, except for the preset Plain.
    identifier: of the preset. Raises Refused if an override has more colours from its library than the preset.
    """
    lists.replace(settings.stops, [{"position": position, "color": color} for position, color in _GRADIENTS[identifier]], "Color")
    numbers = NUMBERS[identifier]
    for name in _of_a_kind(settings):
        _set(settings, name, numbers.get(name, _default(settings.bl_rna.properties[name])))
    if identifier != PLAIN:
        fps = scene_time.fps(scene)
        settings.start_frame = math.floor(scene_time.first(scene)) - math.ceil((settings.lifetime + 1.0) * fps)


def kind_of(settings):
    """Label of the preset whose values an emitter's settings have; "" if the settings match no preset."""
    for _, label, _, numbers, gradient in KINDS:
        if all(
            _is_alike(getattr(settings, name), numbers.get(name, _default(settings.bl_rna.properties[name])))
            for name in _of_a_kind(settings)
        ) and _is_gradient(settings.stops, gradient):
            return label
    return ""


def _of_a_kind(settings):
    """Names of the settings that a preset sets on such an emitter: it keeps its shape if that names a mesh or camera, and its look if chosen."""
    left_alone = LEFT_ALONE | ({"shape"} if settings.shape in {'SURFACE', 'CAMERA'} else set())
    left_alone |= {"look", "flake_width"} if settings.look in CHOSEN else set()
    return [name for name in KEYWORDS if name not in left_alone]


def _set(settings, name, value):
    """Set a setting if its value differs: each setting that was ever set makes the file larger."""
    present = getattr(settings, name)
    if (tuple(present) if isinstance(value, tuple) else present) != value:
        setattr(settings, name, value)


def _is_alike(present, wanted):
    """Whether the present value of a setting equals a wanted one within single precision, in which Blender keeps it."""
    if isinstance(wanted, float):
        return math.isclose(present, wanted, rel_tol=1e-6, abs_tol=1e-9)
    if isinstance(wanted, tuple):
        return all(map(_is_alike, present, wanted))
    return present == wanted


def _is_gradient(stops, wanted):
    return len(stops) == len(wanted) and all(
        _is_alike((stop.position, *stop.color), (place, *color)) for stop, (place, color) in zip(stops, wanted)
    )


def _default(prop):
    return tuple(prop.default_array) if getattr(prop, "is_array", False) else prop.default


SETTINGS = "bpy.context.object.motus.snow"
classes = OPERATOR, PANEL = presets.classes(
    "snow", "Snow", (f"{SETTINGS}.{name}" for name in (*KEYWORDS, "stops") if name not in OF_THE_SHOT)
)
