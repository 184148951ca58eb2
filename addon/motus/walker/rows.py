"""Rows of a walker's settings, as the panels and the operators' redo panel draw them."""

from ..core.interface.rows import Row, Rows


def _is_on(name):
    return lambda settings: getattr(settings, name)


def _has_duty(settings):
    return settings.use_duty or settings.gait == 'OWN'


GAIT = Rows(
    (
        "gait",
        Row("use_duty", when=lambda settings: settings.gait != 'OWN'),
        Row("duty", when=_has_duty),
        "use_natural",
        Row("hip_height", when=_is_on("use_natural")),
        Row("stride", when=lambda settings: not settings.use_natural),
        "cadence",
        "clearance",
        "minimum_step",
    ),
    title="Gait",
)
GROUND = Rows(("use_plane", Row("plane_height", when=_is_on("use_plane")), "reach_up", "reach_down"), title="Ground")
SOLES = Rows(("ankle", "use_soles", *(Row(name, when=_is_on("use_soles")) for name in ("heel", "toe", "strike", "push"))), title="Soles")
BODY = Rows(("body_height", "body_tilt", "frequency", "damping"), title="Body")
WHOLE = Rows(("forward_axis", "up_axis", "jump", "transition", "influence"), title="Walker")
ALL = (GAIT, GROUND, SOLES, BODY, WHOLE)
