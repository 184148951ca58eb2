"""What the flags that a system declares mean for its wiring.

The other modules of wiring ask these functions and do not read the flags `is_relative`, `same_bits` and `moves_points` themselves.
"""

from ...blender import capabilities
from ...declare import System


def moves_points(system: System) -> bool:
    """Whether the system's modifier moves the points of the owner's mesh; a modifier that makes points, and members, do not."""
    return system.moves_points


def is_read_by_subscript(system: System) -> bool:
    """Whether the driver of a hub reads the result as motus_points[...], in place of a call of motus_solve(...).

    Blender assumes that a driver expression with a call or with `frame` in it changes with time, and then evaluates the mesh anew on every
    frame. Blender does not assume this of a subscript, so that a mesh whose points stay where they are is not evaluated anew.
    """
    return system.moves_points


def watches_drivers(system: System) -> bool:
    """Whether the drivers on the owner decide how its members are wired. A system that moves points has no members."""
    return not system.moves_points


def may_use_attribute(system: System) -> bool:
    """Whether members may get their poses from an attribute of the hub's mesh, in versions of Blender that have a constraint for it.

    The attribute is not used for a system that uses a modifier or that requires equal matrices in all versions of Blender.
    """
    return not (system.has_modifier or system.same_bits)


def uses_attribute(system: System) -> bool:
    """Whether this version of Blender lets members get their poses from an attribute of the hub's mesh, and the system may use it.

    The Geometry Attribute constraint exists in Blender 5 and later. If the attribute is not used, the poses are in the outbox.
    """
    return capabilities.has_geometry_attribute_constraint() and may_use_attribute(system)


def may_use_proxies(system: System) -> bool:
    """Whether an object whose result is applied on top of its own transform may copy it from a proxy, a hidden empty.

    Copy Transforms keeps a negative scale. A system that requires equal matrices in all versions of Blender uses a Transformation
    constraint instead.
    """
    return not system.same_bits


def has_relative_members(system: System) -> bool:
    """Whether results of a system without groups are applied on top of the members' own transforms. Groups tell it of each member."""
    return system.is_relative
