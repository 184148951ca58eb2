"""From a system's solve function to the scene: solver driver, outbox, sinks.

The only module that knows how results reach Blender. A system never looks inside; it is attached, refreshed and
detached here. See docs/wiring.md for the way of the data and docs/gotchas.md for why it is this way.
"""

from .attaching import attach, detach, is_attached, refresh, touch
from .geometry_sink import place as points_place
from .geometry_sink import set_material as set_points_material
from .outbox import output, output_path, outputs_of, problem
from .readers import absent_path, targets_on
from .sinks import has_sinks, on_object, release, set_muted, sinks
from .solver import register, unregister

__all__ = (
    "absent_path", "attach", "detach", "has_sinks", "is_attached", "on_object", "output", "output_path", "outputs_of", "points_place",
    "problem", "refresh", "register", "release", "set_muted", "set_points_material", "sinks", "targets_on", "touch", "unregister",
)
