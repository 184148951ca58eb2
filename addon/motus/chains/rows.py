"""The rows in which the panels show settings of chains and the redo panel shows the operator's keywords."""

from ..core.interface.rows import Row, Rows, is_positive
from ..core.translations import OWN_SENSE


def _has_tip(settings):
    return any(getattr(settings, name) != 1.0 for name in ("tip_frequency", "tip_mass", "tip_thickness"))


def _is_of_bones(settings):
    return not getattr(settings, "links", ())  # an operator has none


AMOUNT = Rows((Row("weight", text="Weight", text_ctxt=OWN_SENSE),), title="Amount")
SPRING = Rows(
    (
        "frequency",
        Row("tip_frequency", active=is_positive("frequency")),
        Row("damping", active=is_positive("frequency")),
        Row("response", active=is_positive("frequency")),
    ),
    title="Spring",
)
FORCES = Rows(
    (
        "gravity",
        "drag",
        "tip_mass",
        Row("tip_shape", active=lambda settings: _has_tip(settings) and not settings.use_curve),
        Row("use_curve", active=_has_tip),
    ),
    title="Forces",
)
LIMITS = Rows(
    ("stretch", Row("squash", active=_is_of_bones), "bend_limit", "side_limit", "thickness", "tip_thickness", "hold_end"),
    title="Limits",
)
WORLD = Rows(
    ("wind", "gusts", Row("gust_frequency", active=is_positive("gusts")), "wind_from", "colliders", "use_touch", "friction", "inherit"),
    title="Surroundings",
)
TIME = Rows(("settle", "use_loop", Row("use_cuts", active=lambda settings: not settings.use_loop)), title="Time")
PINNING = Rows((Row("weight", text="Weight", text_ctxt=OWN_SENSE),))
ADDING = (SPRING, FORCES, LIMITS, AMOUNT)
"""Rows of the redo panel of the operator that adds chains."""
