"""The rows of a pendulum's settings: in the panels, and for the keywords in the redo panel."""

from ..core.rows import Row, Rows


def _is_fan(settings):
    if hasattr(settings, "rods"):
        return settings.kind == 'DOUBLE' and settings.count > 1
    return settings.kind in {'FAN', 'CHAOS'}  # of the operator


def _has_two(settings):
    return settings.kind != 'SINGLE'


def _lower(name):
    """Below the same of the upper rod or bob: the whole name would not fit into the sidebar."""
    return Row(name, when=_has_two, text="Lower")


SWING = Rows((
    "length1", _lower("length2"), Row("mass1", when=_has_two), _lower("mass2"),
    "angle1", _lower("angle2"), Row("angle_step", when=_is_fan), "velocity1", _lower("velocity2")), title="Pendulum")
FORCES = Rows((
    "use_scene_gravity",
    Row("gravity", when=lambda settings: not settings.use_scene_gravity),
    "damping", "use_pivot_motion",
    Row("use_limits", when=_has_two),
    Row("most_velocity", when=lambda settings: _has_two(settings) and settings.use_limits),
    Row("most_acceleration", when=lambda settings: _has_two(settings) and settings.use_limits)), title="Forces")
TIME = Rows(("start_frame", "speed", "is_playing", "influence"), title="Time")
TRAIL = Rows(("seconds", "fade", "thickness"), title="Trails")
ALL = (SWING, FORCES, TIME)
