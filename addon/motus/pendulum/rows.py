"""The rows in which the panels show a pendulum's settings and the redo panel shows the operator's keywords."""

from ..core.interface.rows import Row, Rows, is_one_of


def _is_fan(settings):
    if hasattr(settings, "rods"):
        return settings.kind == 'DOUBLE' and settings.count > 1
    return settings.kind in {'FAN', 'CHAOS'}  # `settings` are the operator's keywords


def _has_one(settings):
    return settings.kind in {'SINGLE', 'SPHERICAL'}


def _has_two(settings):
    return not _has_one(settings)


def _of_rods(name, text):
    """Make the panel rows of a setting that each rod has: one with the label `text` for a pendulum of one rod, two for a double pendulum."""
    return Row(f"{name}1", when=_has_one, text=text), Row(f"{name}1", when=_has_two), Row(f"{name}2", when=_has_two)


SWING = Rows(
    (
        *_of_rods("length", text="Length"),
        *_of_rods("mass", text="Mass")[1:],
        *_of_rods("angle", text="Angle"),
        Row("heading", when=is_one_of("kind", 'SPHERICAL')),
        Row("angle_step", when=_is_fan),
        *_of_rods("velocity", text="Velocity"),
        Row("velocity_sideways", when=is_one_of("kind", 'SPHERICAL'), text="Sideways"),
    ),
    title="Pendulum",
)
FORCES = Rows(
    (
        "use_scene_gravity",
        Row("gravity", when=lambda settings: not settings.use_scene_gravity),
        "damping",
        "use_pivot_motion",
        Row("use_limits", when=_has_two),
        Row("most_velocity", when=lambda settings: _has_two(settings) and settings.use_limits),
        Row("most_acceleration", when=lambda settings: _has_two(settings) and settings.use_limits),
    ),
    title="Forces",
)
TIME = Rows(("start_frame", "speed", "is_playing", "influence"), title="Time")
TRAIL = Rows(("seconds", "fade", "thickness"), title="Trails")
ALL = (SWING, FORCES, TIME)
