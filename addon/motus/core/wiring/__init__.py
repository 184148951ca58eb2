"""From a system's solve function to the scene: solver driver, outbox, sinks.

The only module that knows how results reach Blender. A system never looks inside; it is attached, refreshed and
detached here. See docs/architecture.md for the way of the data and docs/gotchas.md for why it is this way.
"""

from .attach import attach, detach, is_attached, refresh, set_muted, sinks, touch
from .outbox import output, output_path, problem
from .solver import register, unregister

__all__ = (
    "attach", "detach", "is_attached", "output", "output_path", "problem", "refresh", "register",
    "set_muted", "sinks", "touch", "unregister",
)
