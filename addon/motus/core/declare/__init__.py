"""What a system declares: its settings, inputs, members, problems and solve function; and which systems are registered."""

from .context import Context
from .inputs import BonesOwn, Deformed, Geometries, Geometry, Matrix, OwnMatrix, Setting, Splines, Transform, Variable, Vertices
from .members import Entry, Group, Member, Points, Property
from .problem import OK, Problem
from .registry import (
    can_own,
    described,
    entries_on,
    groups_of,
    has_settings,
    input_variables,
    is_owner,
    laying_systems,
    leader_of,
    of_owner,
    offered,
    registered,
    systems,
    title,
    wired_on,
)
from .system import Feature, System

__all__ = (
    "OK",
    "BonesOwn",
    "Context",
    "Deformed",
    "Entry",
    "Feature",
    "Geometries",
    "Geometry",
    "Group",
    "Matrix",
    "Member",
    "OwnMatrix",
    "Points",
    "Problem",
    "Property",
    "Setting",
    "Splines",
    "System",
    "Transform",
    "Variable",
    "Vertices",
    "can_own",
    "described",
    "entries_on",
    "groups_of",
    "has_settings",
    "input_variables",
    "is_owner",
    "laying_systems",
    "leader_of",
    "of_owner",
    "offered",
    "registered",
    "systems",
    "title",
    "wired_on",
)
