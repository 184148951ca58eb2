"""From a system's solve function to the scene: solver driver, outbox, sinks.

The only module that knows how results reach Blender. A system never looks inside; it is attached, refreshed and
detached here. See docs/wiring.md for the way of the data and docs/gotchas.md for why it is this way.
"""

from ..system import is_owner as is_attached
from .attaching import attach, detach, refresh, set_muted, touch
from .drivers import driven_bones
from .geometry_sink import place as points_place
from .geometry_sink import set_collection as set_points_collection
from .geometry_sink import set_material as set_points_material
from .geometry_sink import set_object as set_points_object
from .healing import evaluation
from .order import waited_for
from .outputs import output, output_path, outputs_of
from .problems import problem, report_problems
from .property_sink import check as check_property
from .property_sink import driven as driven_properties
from .property_sink import place as property_place
from .readers import absent_path, targets_on
from .sinks import abandoned, has_sinks, is_sink, on_object, release, sinks
from .solver import register, unregister

__all__ = (
    "abandoned", "absent_path", "attach", "check_property", "detach", "driven_bones", "driven_properties", "evaluation", "has_sinks", "is_attached",
    "is_sink", "on_object", "output", "output_path", "outputs_of", "points_place", "problem", "property_place", "refresh", "register", "release", "set_muted",
    "set_points_collection", "set_points_material", "set_points_object", "sinks", "targets_on", "touch", "unregister",
)
