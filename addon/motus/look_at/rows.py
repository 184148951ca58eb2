"""The rows of a head's settings: in the panels, and for the keywords in the redo panel."""

from ..core.interface.rows import Row, Rows
from ..core.translations import OWN_SENSE

WEIGHTS = Rows(
    (
        Row("weight", text="Weight", text_ctxt=OWN_SENSE),
        "body_weight",
        "head_weight",
        # An entry has a list of eyes; the operator finds them, or is given their names.
        Row("eyes_weight", active=lambda head: isinstance(head.eyes, str) or len(head.eyes) > 0),
    ),
    title="Weights",
)
LIMITS = Rows(("clamp", Row("body_limit", text="Body"), Row("head_limit", text="Head"), Row("eyes_limit", text="Eyes")), title="Limits")
FACING = Rows(("forward", "up"), title="Facing")
AXES = Rows(("head_forward", "eyes_forward"), title="Bones")
ALL = (WEIGHTS, FACING, LIMITS, AXES)
