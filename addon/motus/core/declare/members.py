"""Declarations of what a solver drives or makes: objects, bones, properties and points, in groups that one call of the solver computes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

import bpy

from .inputs import Transform


@dataclass(frozen=True)
class Member:
    """Declaration of an Object or PoseBone (`thing`) that a solver drives.

    channels: those that are driven, of "location", "rotation" and "scale". space: in which solve() gives the transform, as a constraint's
    space, if is_relative is false. is_relative: location, rotation and scale act on top of the thing's own transform, each channel by
    itself and along the axes of that transform; neutral values (no move, no rotation, scale 1) leave the thing alone.
    """

    thing: Any
    channels: frozenset[str] = frozenset({"location", "rotation"})
    space: str = 'WORLD'
    is_relative: bool = False

    @property
    def owner_space(self) -> str:
        """Owner space of the constraints that apply the solver's result to the driven object or bone."""
        if not self.is_relative:
            return self.space
        # The Local Space of an object without a parent is turned as the object is.
        stands_alone = isinstance(self.thing, bpy.types.Object) and self.thing.parent is None
        return 'WORLD' if stands_alone else 'LOCAL'


@dataclass(frozen=True)
class Property:
    """Declaration of a FLOAT property that an output of a Group drives, in place of its own value and keys.

    output: name of the number in Group.outputs. path: data path from the object, as Object.path_resolve() takes it; it may lead
    through the object's data or its materials. index: of the component of an array; -1 if the property is no array.
    """

    output: str
    object: Any
    path: str
    index: int = -1


@dataclass(frozen=True)
class CopyOf:
    """Input of a Group: Blender calls the solver after it has copied an object or its data, which the solver reads as they are over time.

    For members that are objects: the solver cannot wait for their transforms, to which it brings its results. Edits of what is copied call
    the solver again. The input is no argument of solve().
    """

    object: Any
    bone: str = ""


@dataclass(frozen=True)
class Group:
    """Declaration of what one call of a solver computes: its members, inputs and outputs. An owner may have several groups of a system.

    key: letters and digits that name the group; "" for the first. members: objects and bones that are driven. inputs: Transforms,
    BonesOwn and CopyOfs that the solver waits for. outputs: names of the numbers that solve() sets. properties: driven by these numbers; the wiring
    blends them by the influence, and a number that solve() does not set leaves the property at its own value.
    data: {name: string, number or list of numbers} that is known when the owner is wired, and that solve() reads as Context.data.
    """

    key: str = ""
    members: tuple[Member, ...] = ()
    inputs: tuple[Any, ...] = ()
    outputs: tuple[str, ...] = ()
    properties: tuple[Property, ...] = ()
    data: dict[str, Any] = field(default_factory=dict)

    @property
    def reads(self) -> list[tuple[Any, str]]:
        """(object, name of the bone or "") for each transform that the solver waits for, without repetitions."""
        return [(one.object, one.bone) for one in dict.fromkeys(self.inputs) if isinstance(one, Transform)]


@dataclass(frozen=True)
class Entry:
    """Declaration of what an entry, an item in an owner's list of settings, reads and drives; it sorts entries by their dependencies.

    name: of the entry. reads: (object, name of the bone or "") of each transform that the entry needs evaluated. drives: names of the
    owner's bones, and other objects. core/wiring/attaching/levels.py computes the order. yields: what of `drives` an entry of a different
    system may take over, after which this entry drives it no more.
    """

    name: str
    reads: tuple[tuple[Any, str], ...] = ()
    drives: tuple[Any, ...] = ()
    yields: tuple[Any, ...] = ()

    @property
    def keeps(self) -> tuple[Any, ...]:
        """What of `drives` no entry of a different system may drive."""
        return tuple(one for one in self.drives if one not in self.yields)


@dataclass(frozen=True)
class Points:
    """Declaration of the points that a system makes on its owner, by a Geometry Nodes modifier.

    attributes: (name, kind) of the point attributes in addition to the position. kind: 'FLOAT', 'INT', 'VECTOR', 'COLOR', or
    'QUATERNION' (w, x, y, z), which is stored as Euler angles before Blender 4.0. Blender itself uses these names: the FLOAT "radius" of
    points and curves; the VECTOR "velocity", in metres per second, for motion blur; the INT "id", by which an instance on a point is the
    same from one frame to the next.
    shape: 'POINTS'; 'CURVES' through consecutive points that have the same INT "curve"; or 'TUBES' around such curves.
    space: 'WORLD' if the points stay in place while the owner moves, or 'LOCAL' for the owner's space.
    capacity: largest number of points.
    unneeded: function of the settings that returns names of attributes which the points need not have, to save time. It may depend only
    on settings whose change wires the owner again (`update=rewire`).
    """

    attributes: tuple[tuple[str, str], ...] = ()
    shape: str = 'POINTS'
    space: str = 'WORLD'
    capacity: int = 1 << 22
    unneeded: Callable[[Any], Iterable[str]] = lambda _settings: ()
