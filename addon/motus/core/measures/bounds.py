"""Limit for the work that a solver may do while Blender waits for a frame.

Work is priced before it is done. A panel says what a solver leaves out because of the limit. A price counts computed numbers, such as those
of one transform at one time, or work that takes as long: about a microsecond for each number. A price follows from the file alone, so that
no result depends on the speed of a machine or on kept results.
"""

from __future__ import annotations

AT_ONCE = 1_500_000
"""Largest price of the work that is done while Blender waits for a frame, in computed numbers (about 1 microsecond each)."""

AT_MOST = 24_000_000
"""Price of the work that may be done in any case, so that everything that dynamics drive moves at all.

A solver that computes many things at once, as that of dynamics does, takes far less time for a number than a price says.
"""


def times(price: float) -> int:
    """How many computations of one price fit into the limit for one frame.

    price: of one computation, in computed numbers (about 1 microsecond each).
    """
    return int(AT_ONCE // max(price, 1))
