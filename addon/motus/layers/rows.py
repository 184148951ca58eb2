"""The rows in which the panels show a layer's settings and the redo panel shows the operator's keywords."""

from ..core.interface.rows import Row, Rows, is_one_of
from ..core.translations import OWN_SENSE

BLENDING = Rows(
    (
        Row("mode", expand=True),
        Row("weight", text="Weight", text_ctxt=OWN_SENSE),
        Row("reference", when=is_one_of("mode", 'ADDITIVE')),
        Row("reference_frame", when=lambda layer: layer.mode == 'ADDITIVE' and layer.reference in {'FRAME', 'ACTION'}),
    ),
    title="Blending",
)
TIMING = Rows(
    (
        "start",
        "speed",
        "after",
        "blend_in",
        Row("blend_out", when=is_one_of("after", 'STOP')),
        "use_range",
        Row("first_frame", when=lambda layer: layer.use_range),
        Row("last_frame", when=lambda layer: layer.use_range),
    ),
    title="Timing",
)
BORDER = Rows(("feather", "in_armature"), title="Border of the Mask")
ALL = (BLENDING, TIMING, BORDER)
