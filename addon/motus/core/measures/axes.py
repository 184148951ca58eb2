"""The six directions along an object's axes, as items of an EnumProperty."""

from __future__ import annotations

AXES = (
    ('POS_X', "X", ""),
    ('POS_Y', "Y", ""),
    ('POS_Z', "Z", ""),
    ('NEG_X', "-X", ""),
    ('NEG_Y', "-Y", ""),
    ('NEG_Z', "-Z", ""),
)
LABELS = {name: label for name, label, _ in AXES}
IDENTIFIERS = frozenset(LABELS)


def vector(identifier: str) -> tuple[float, float, float]:
    """Unit vector (x, y, z) of an axis. identifier: of an item of AXES, such as 'NEG_Y'."""
    length = 1.0 if identifier.startswith("POS") else -1.0
    x, y, z = (length * (axis == identifier[-1]) for axis in "XYZ")
    return x, y, z
