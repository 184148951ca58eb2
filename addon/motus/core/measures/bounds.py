"""How much work a solver may do at once. Work is priced before it is done, and what is left out is said in the panel.

A price counts numbers that are computed, such as those of a transform at one time, or what takes as long: about a microsecond. It
follows from the file alone, so that no result depends on how fast a machine is, or on what it has found before.
"""

from __future__ import annotations

AT_ONCE = 1_500_000
"""The price of what may be done while Blender waits for a frame."""


def times(price: float) -> int:
    """How many computations fit into the limit for one frame. price: of one computation, in numbers computed (about 1 microsecond each)."""
    return int(AT_ONCE // max(price, 1))
