"""Rows of snow's settings, as the panels and the operators' redo panel draw them."""

import bpy

from ..core.interface.rows import Row, Rows, is_not, is_one_of, is_positive


def _is_on(name):
    return lambda settings: getattr(settings, name)


def _leans(settings):
    return settings.shape == 'CONE' or settings.random_orientation


def _repeats_not(settings):
    return not settings.use_loop


def _moves_alone(settings):
    return settings.shape != 'CAMERA' and not settings.use_local


def _is_bound(settings):
    return settings.shape == 'CAMERA' and any(marker.camera for marker in bpy.context.scene.timeline_markers)


EMISSION = Rows(
    (
        "start_speed",
        "lifetime",
        "start_size",
        "rate",
        "time_speed",
        Row("start_frame", when=_repeats_not),
        Row("delay", when=_repeats_not),
        "looping",
        Row("duration", when=lambda settings: not settings.looping),
        "burst",
        Row("burst_time", when=lambda settings: settings.burst > 0),
    ),
    title="Emission",
)
LOOP = Rows((Row("loop_start", when=_is_on("use_loop")), Row("loop_end", when=_is_on("use_loop"))))
REPEAT = Rows(("use_loop", *LOOP.rows), title="Loop")
SHAPE = Rows(("shape",))
EXTENT = Rows(
    (
        Row("emitter_radius", when=is_not("shape", 'SURFACE', 'CAMERA')),
        Row("cone_angle", when=_leans),
        Row("closest", when=is_one_of("shape", 'CAMERA')),
        Row("farthest", when=is_one_of("shape", 'CAMERA')),
        Row("follow_markers", when=_is_bound),
        Row("emitter_velocity", when=_moves_alone),
        Row("use_local", when=is_not("shape", 'CAMERA')),
        Row("use_scale", when=is_not("shape", 'CAMERA')),
    )
)
EMITTER = Rows((*SHAPE.rows, *EXTENT.rows), title="Emitter")
SOURCE = Rows((Row("surface", when=is_one_of("shape", 'SURFACE')), Row("camera", when=is_one_of("shape", 'CAMERA'))))
RANDOM = Rows(("random_speed", "random_orientation", "random_lifetime", "random_size", "random_color", "seed"), title="Random")
STEERING = Rows(
    (
        Row("max_angle", when=_is_on("use_steering")),
        Row("steering_frequency", when=_is_on("use_steering")),
        Row("steering_per_flake", when=_is_on("use_steering")),
        "tumble",
    ),
    title="Steering",
)
SNOW = Rows(("use_steering", *STEERING.rows), title="Steering")
AIR = Rows(
    (
        "gravity",
        "drag",
        Row("wind", when=is_positive("drag")),
        Row("gusts", when=is_positive("drag")),
        Row("gust_frequency", when=lambda settings: settings.drag > 0.0 and settings.gusts > 0.0),
        "turbulence",
        Row("turbulence_size", when=is_positive("turbulence")),
    ),
    title="Forces",
)
LANDING = Rows(
    (
        "use_ground",
        Row("ground", when=_is_on("use_ground")),
        "collision",
        Row("melt_time", when=is_one_of("collision", 'MELT')),
        Row("friction", when=is_one_of("collision", 'SLIDE')),
    ),
    title="Collision",
)
COLLIDERS = Rows(("collider", "colliders"))
_WIDTH = Row("flake_width", when=is_not("look", 'OBJECT', 'COLLECTION'))
FLAKES = Rows(
    (
        "look",
        Row("flake", when=is_one_of("look", 'OBJECT')),
        Row("flakes", when=is_one_of("look", 'COLLECTION')),
        _WIDTH,
        "all_attributes",
        "preview",
        "influence",
    ),
    title="Flakes",
)
LOOK = Rows(("look", _WIDTH, "all_attributes", "preview", "influence"), title="Flakes")
"""Rows of the look in the redo panel of the operator, which has no pointers to objects but properties with their names."""
ALL = (EMISSION, REPEAT, EMITTER, RANDOM, SNOW, AIR, LANDING, LOOK)
