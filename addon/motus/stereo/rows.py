"""Rows of a rig's settings and the conditions under which they are shown, for the panel and Adjust Last Operation."""

from ..core.interface.rows import Row, Rows, is_not, is_one_of

_is_budget = is_one_of("convergence", 'BUDGET')
EYES = Rows(
    (
        "convergence",
        Row("interocular", when=is_not("convergence", 'BUDGET')),
        Row("distance", when=is_one_of("convergence", 'DISTANCE')),
        Row("near", when=_is_budget),
        Row("far", when=_is_budget),
        Row("near_parallax", when=_is_budget),
        Row("far_parallax", when=_is_budget),
    ),
    title="Eyes",
)
SCREEN = Rows(
    (
        "screen",
        Row("screen_width", when=is_one_of("screen", 'CUSTOM')),
        Row("screen_distance", when=is_one_of("screen", 'CUSTOM')),
        "eye_separation",
    ),
    title="Screen",
)
OBJECT = Rows((Row("focus", when=is_one_of("convergence", 'OBJECT')),))
WINDOW = Rows(("window_left", "window_right"))
INFLUENCE = Rows(("influence",))
ADDING = (EYES, SCREEN)
