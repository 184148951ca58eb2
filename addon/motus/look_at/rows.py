"""Rows that draw the settings of a head: in the panels, and in the redo panel of the operator that adds a head."""

from ..core.file.pointers import pointed
from ..core.interface.rows import Row, Rows
from ..core.translations import OWN_SENSE
from .properties import SIDE_LIMITS


def _jumps(head):
    return head.use_saccades


def _blinks(head):
    return head.use_blinks


def shape_keys(head):
    """Shape keys of the face of a head's entry; None if there is no face, or it has none."""
    face = pointed(head, "shut_object")
    return face and getattr(face.data, "shape_keys", None)


def _has_keys(head):
    return shape_keys(head) is not None


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
EYES = Rows(
    (
        "use_saccades",
        Row("saccade_amplitude", when=_jumps),
        Row("saccade_rate", when=_jumps),
        "use_blinks",
        Row("blink_rate", when=_blinks),
        Row("blink_angle", when=_blinks),
        Row("eyes_seed", when=lambda head: head.use_saccades or head.use_blinks),
    ),
    title="Eyes by Themselves",
)
SHUT = Rows(("shut_object", Row("shut_key", when=_has_keys, search=lambda head: (shape_keys(head), "key_blocks"))), when=_blinks)
FACING = Rows(("forward", "up"), title="Facing")
AXES = Rows(("head_forward", "eyes_forward"), title="Bones")
ALL = (WEIGHTS, FACING, LIMITS, SIDES, EYES, AXES)
