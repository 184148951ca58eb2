"""Rows that draw the settings of a chain: in the panels, and in the redo panel of the operator that adds a chain."""

from ..core.file.pointers import pointed
from ..core.interface.rows import Row, Rows, is_positive
from ..core.translations import OWN_SENSE


def _has_pole(chain):
    return bool(pointed(chain, "pole"))


def _has_floor(chain):
    return bool(pointed(chain, "floor"))


CHAIN = Rows((Row("chain_length", text="Length"), "use_tail"), title="Chain")
WEIGHTS = Rows(("position_weight", "rotation_weight"), title="Weights")
OFFSET = Rows((Row("rotation_offset", text="Offset", text_ctxt=OWN_SENSE),))
POLE = Rows((Row("bend", when=_has_pole), "pole_angle", "hinge_angle"), title="Pole")
REACH = Rows(("softness", "stretch", Row("volume", active=is_positive("stretch"))), title="Reach")
FLOOR = Rows(("floor", Row("floor_height", when=_has_floor), Row("floor_margin", when=_has_floor)))
PRECISION = Rows(("tolerance", "iterations"), title="Precision")

ADDING = (
    Rows((*CHAIN.rows, "make_control_bone"), title="Chain"),
    Rows(
        (
            Row("make_pole", when=lambda operator: not operator.pole),
            Row("bend", when=lambda operator: operator.make_pole or bool(operator.pole)),
            "pole_angle",
        ),
        title="Pole",
    ),
    Rows(
        (
            *WEIGHTS.rows,
            Row("keep_rotation", when=is_positive("rotation_weight")),
            Row("rotation_offset", when=lambda operator: operator.rotation_weight > 0.0 and not operator.keep_rotation),
        ),
        title="Weights",
    ),
    Rows((*REACH.rows, "use_limits"), title="Reach"),
    Rows(tuple(Row(name, when=lambda operator: operator.chain_length != 2) for name in PRECISION.rows), title="Precision"),
)
"""Rows of the redo panel of the operator that adds a chain."""
