"""Public functions of the wiring, which brings the results of a system's solve function to objects, bones and properties in Blender.

Only this package knows how results reach Blender: a driver calls the solver, the solver writes an array of results (the outbox), and
constraints, drivers or modifiers (the sinks) read that array. Systems call the functions listed in __all__ and never look inside the
package. docs/wiring.md describes the way of the data, docs/gotchas.md the reasons for the design.
"""

from ..blender.drivers import driven_bones, targets_on
from ..declare import is_owner as is_attached
from .attaching.attach import attach, detach, refresh, set_muted, touch
from .attaching.levels import depends, hanging, levels
from .attaching.readers import absent_path
from .attaching.waiting import waited_for
from .healing.watch import evaluation
from .hubs.outputs import output, output_path, outputs_of
from .problems import problem, report_problems
from .sinks.finding import abandoned, has_sinks, is_sink, on_object, release, sinks
from .sinks.geometry_sink import points_place, set_points_collection, set_points_material, set_points_object
from .sinks.property_sink import check_property, driven_properties, property_place
from .solving.namespace import register, unregister

__all__ = (
    "abandoned",
    "absent_path",
    "attach",
    "check_property",
    "depends",
    "detach",
    "driven_bones",
    "driven_properties",
    "evaluation",
    "hanging",
    "has_sinks",
    "is_attached",
    "is_sink",
    "levels",
    "on_object",
    "output",
    "output_path",
    "outputs_of",
    "points_place",
    "problem",
    "property_place",
    "refresh",
    "register",
    "release",
    "report_problems",
    "set_muted",
    "set_points_collection",
    "set_points_material",
    "set_points_object",
    "sinks",
    "targets_on",
    "touch",
    "unregister",
    "waited_for",
)
