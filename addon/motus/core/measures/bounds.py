"""Limit for the work that the solvers of a system may do while Blender waits for a frame.

Work is priced before it is done. A panel says what a solver leaves out because of the limit. A price counts computed numbers, such as those
of one transform at one time, or work that takes as long: about a microsecond for each number. A price follows from the file alone, so that
no result depends on the speed of a machine or on kept results. All owners in a scene share the limit (core/evaluated/shares.py).
"""

from __future__ import annotations

AT_ONCE = 1_500_000
"""Largest price of the work that is done while Blender waits for a frame, in computed numbers (about 1 microsecond each)."""

MANY_AT_ONCE = 10 * AT_ONCE
"""Largest price of work that the native module does for thousands of times at once: about 0.1 microseconds for each number."""


def times(price: float, share: float = 1.0) -> int:
    """How many computations of one price fit into an owner's share of the limit for one frame.

    price: of one computation, in computed numbers (about 1 microsecond each). share: from core/evaluated/shares.py.
    """
    return int(AT_ONCE * share // max(price, 1))
