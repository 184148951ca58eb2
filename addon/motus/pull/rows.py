"""Rows of settings of the brush, of pins and of the operators, for panels and for Adjust Last Operation."""

import bpy

from ..core.interface.rows import Row, Rows, is_given, is_one_of


def _vertex_groups(settings):
    """Return (object, name of its collection of vertex groups) to choose from: a pin's object, otherwise the active object."""
    is_pin = isinstance(settings, bpy.types.PropertyGroup) and isinstance(settings.id_data, bpy.types.Object)
    return (settings.id_data if is_pin else bpy.context.object), "vertex_groups"


def _is_limited(settings):
    return settings.use_minimum or settings.use_maximum


def _has_strength(operator):
    return not operator.is_given("displacement") and (not len(operator.dabs) or any(dab.kind != 'DRAG' for dab in operator.dabs))


FORM = ("falloff", Row("scale_factor", when=is_one_of("falloff", 'CLASSIC')), "distance", "weld")
EXTENT = (Row("mirror", expand=True), Row("vertex_group", search=_vertex_groups))
LIMITS = (Row("minimum", switch="use_minimum"), Row("maximum", switch="use_maximum"))
CLAMPED = Row("clamp_axis", when=_is_limited)

PULL = (
    Rows(("radius", Row("strength", when=_has_strength), "unit", *FORM), title="Pull"),
    Rows(
        (
            Row("direction", when=lambda operator: not operator.is_given("displacement") and not len(operator.dabs)),
            Row("displacement", when=is_given("displacement")),
            "accumulate",
            *EXTENT,
        ),
        title="Direction",
    ),
    Rows((*LIMITS, CLAMPED), title="Limits"),
)
"""Rows of settings of the operator motus.pick_pull."""


def _is_new(operator):
    return not operator.from_last


PIN = (
    Rows(("strength",)),
    Rows(("radius", "unit", *FORM), title="Pull", when=_is_new),
    Rows(
        (
            Row("direction", when=lambda operator: not operator.is_given("displacement")),
            Row("displacement", when=is_given("displacement")),
            *EXTENT,
        ),
        title="Direction",
        when=_is_new,
    ),
    Rows((*LIMITS, CLAMPED), title="Limits", when=_is_new),
)
"""Rows of settings of the operator that adds a pin."""
