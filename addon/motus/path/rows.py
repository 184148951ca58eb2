"""Rows of a follower's settings, drawn in the panels and in the operators' Adjust Last Operation panels."""

from ..core.interface.rows import Row, Rows, is_not, is_one_of, is_positive
from ..core.translations import OWN_SENSE

_IS_TURNED = is_not("orientation", 'NONE')
_HAS_RAIL = is_one_of("orientation", 'RAIL')

PATH = Rows((Row("spline", text="Spline", text_ctxt=OWN_SENSE), "influence", "extend", "space"), title="Path")
TIMING = Rows(
    (
        "timing",
        Row("start_frame", when=is_one_of("timing", 'DURATION', 'SPEED', 'PLACES')),
        Row("duration", when=is_one_of("timing", 'DURATION')),
        Row("ease_in", when=is_one_of("timing", 'DURATION')),
        Row("ease_out", when=is_one_of("timing", 'DURATION')),
        Row("speed", when=is_one_of("timing", 'SPEED')),
        Row("distance_factor", when=is_one_of("timing", 'MANUAL')),
        Row("distance", when=is_one_of("timing", 'DISTANCE')),
        Row("pins_by", when=is_one_of("timing", 'PINS')),
        Row("offset", text="Offset", text_ctxt=OWN_SENSE),
    ),
    title="Timing",
)
ORIENTATION = Rows(
    (
        Row("orientation", text="Mode"),
        Row("forward_axis", when=_IS_TURNED),
        Row("up_axis", when=_IS_TURNED),
        Row("rail_spline", when=_HAS_RAIL),
        Row("rail_by", when=_HAS_RAIL),
        Row("rail_side", when=_HAS_RAIL),
        Row("curvature_outward", when=is_one_of("orientation", 'CURVATURE')),
        Row("bank_strength", when=is_one_of("orientation", 'BANKING')),
        Row("bank_limit", when=is_one_of("orientation", 'BANKING')),
        Row("bank_smoothing", when=is_one_of("orientation", 'BANKING', 'CURVATURE')),
        Row("gravity", when=is_one_of("orientation", 'BANKING')),
        Row("lag_rate", when=_IS_TURNED),
        Row("lag_by", when=_IS_TURNED, active=is_positive("lag_rate")),
    ),
    title="Orientation",
)
PLACEMENT = Rows(
    ("wheelbase", "side", "height", Row("side_by", when=_IS_TURNED)),
    title="Placement",
)
ALL = (PATH, TIMING, ORIENTATION, PLACEMENT)
