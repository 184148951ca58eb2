"""Rows that draw the settings of a head: in the panels, and in the redo panel of the operator that adds a head."""

from ..core.interface.rows import Row, Rows
from ..core.translations import OWN_SENSE
from .properties import SIDE_LIMITS


def _jumps(head):
    return head.use_saccades


WEIGHTS = Rows(
    (
        Row("weight", text="Weight", text_ctxt=OWN_SENSE),
        "body_weight",
        "head_weight",
        # The eyes of an entry are a collection. The operator's keyword `eyes` is a text; if it is empty, the operator may find eyes.
        Row("eyes_weight", active=lambda head: isinstance(head.eyes, str) or len(head.eyes) > 0),
    ),
    title="Weights",
)
LIMITS = Rows(("clamp", Row("body_limit", text="Body"), Row("head_limit", text="Head"), Row("eyes_limit", text="Eyes")), title="Limits")
SIDES = Rows(SIDE_LIMITS, title="Limits by Direction")
SACCADES = Rows(
    (
        "use_saccades",
        Row("saccade_amplitude", when=_jumps),
        Row("saccade_rate", when=_jumps),
        Row("eyes_seed", when=_jumps),
    ),
    title="Eyes by Themselves",
)
FACING = Rows(("forward", "up"), title="Facing")
AXES = Rows(("head_forward", "eyes_forward"), title="Bones")
ALL = (WEIGHTS, FACING, LIMITS, SIDES, SACCADES, AXES)
