"""The rows in which the panels show an entry's settings and the redo panel shows the operator's keywords."""

from ..core.interface.rows import Row, Rows, is_one_of
from ..core.translations import OWN_SENSE


def _is_thing(settings):
    """Whether the entry or operator is for an object or bone instead of a single property."""
    return not settings.data_path


def _has_channels(settings):
    """Whether the entry's channels can be chosen: it is on an object, or on a bone whose own transform it follows, not its tail."""
    return _is_thing(settings) and (settings.follow == 'OWN' or not getattr(settings, "name", ""))


_CHANNELS = Row("channels", when=_has_channels, expand=True, stacks=True)
FOLLOW = Rows((Row("follow", when=_is_thing), _CHANNELS), title="Follow")
BY_FREQUENCY = Rows(("frequency", "damping", "response"), title="Motion")
MOTION = Rows(
    (
        Row("frequency", when=is_one_of("shape", 'FREQUENCY')),
        Row("damping", when=is_one_of("shape", 'FREQUENCY')),
        Row("overshoot", when=is_one_of("shape", 'OVERSHOOT')),
        Row("settling", when=is_one_of("shape", 'OVERSHOOT')),
        Row("response", when=is_one_of("shape", 'FREQUENCY', 'OVERSHOOT')),
        Row("mass", when=is_one_of("shape", 'SPRING')),
        Row("stiffness", when=is_one_of("shape", 'SPRING')),
        Row("resistance", when=is_one_of("shape", 'SPRING')),
    ),
    title="Motion",
)
AMOUNT = Rows((Row("weight", text="Weight", text_ctxt=OWN_SENSE), "delay"), title="Amount")
LOOP = Rows(
    (Row("loop_start", when=lambda settings: settings.use_loop), Row("loop_end", when=lambda settings: settings.use_loop)), title="Loop"
)
JUMP = Rows(("jump",))
ADDING = (
    Rows(("style",), title="Style"),
    Rows((*BY_FREQUENCY.rows,), title="Motion", when=lambda operator: operator.style == 'CUSTOM'),
    # If `follow` is not given, it is chosen for each object or bone separately, and shown in its panel instead.
    Rows((Row("follow", when=lambda operator: _is_thing(operator) and operator.is_given("follow")), _CHANNELS), title="Follow"),
    Rows(("whole_chains", "chain_delay"), title="Bones", when=_is_thing),
    Rows((*AMOUNT.rows, "use_loop", *LOOP.rows, *JUMP.rows), title="Amount"),
)
"""Rows of the redo panel of the operator that adds dynamics."""
