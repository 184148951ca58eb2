"""What a solver drives or makes: objects, bones, properties and points, in groups that are solved at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

import bpy

from .inputs import Transform


@dataclass(frozen=True)
class Member:
    """An Object or PoseBone that is driven, and how.

    space: of what solve() fills, unless is_relative: then location, rotation and scale act on top of the thing's own, channel by
    channel and in the axes of these; neutral values (no move, no rotation, scale 1) leave it alone.
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
    """A decimal number that is driven by one of a group's outputs, in the place of its own value and keys.

    path: from the object, as object.path_resolve() takes it, through its data, materials, ...; index: in an array.
    """

    output: str
    object: Any
    path: str
    index: int = -1


@dataclass(frozen=True)
class Group:
    """Members, inputs and outputs of one solver; a system may have several groups on one owner.

    key: letters and digits, "" for the first. inputs: Transform and BonesOwn that the solver waits for. outputs: names of
    numbers. properties: driven by outputs, on top of which solve() leaves the influence to the wiring; what solve() does not set
    is the property's own. data: what solve needs to know and is known when wired: strings, numbers, and lists of numbers by name.
    """

    key: str = ""
    members: tuple[Member, ...] = ()
    inputs: tuple[Any, ...] = ()
    outputs: tuple[str, ...] = ()
    properties: tuple[Property, ...] = ()
    data: dict[str, Any] = field(default_factory=dict)

    @property
    def reads(self) -> list[tuple[Any, str]]:
        """(object, bone or "") for each transform that the solver reads, each once."""
        return [(one.object, one.bone) for one in dict.fromkeys(self.inputs) if isinstance(one, Transform)]


@dataclass(frozen=True)
class Entry:
    """One item in an owner's list of settings, which drives bones of the owner or objects; used to sort items by their dependencies.

    reads: (object, bone or "") whose evaluated transforms the item needs. drives: names of the owner's bones, and objects.
    The order is computed in core/wiring/attaching/levels.py.
    """

    name: str
    reads: tuple[tuple[Any, str], ...] = ()
    drives: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Points:
    """Points that a system makes on its owner, with a position and `attributes`, which are pairs of name and kind.

    kind: 'FLOAT', 'INT', 'VECTOR', 'COLOR', or 'QUATERNION' (w, x, y, z), which before Blender 4.0 arrives as Euler angles.
    Names that Blender knows: the FLOAT "radius" of points and curves; the VECTOR "velocity", in metres a second, of which
    motion blur is made; the INT "id", by which instances on the points are the same from one frame to the next.
    shape: 'POINTS'; 'CURVES', along points that follow each other and have the same INT "curve"; or 'TUBES' around such.
    space: 'WORLD', in which the points stay where they are while the owner moves, or 'LOCAL', the owner's.
    capacity: more points than that there never are.
    unneeded: says of settings which attributes' names there is no need for: points have them neither, nor the time that they
    take. It may depend on settings alone whose change wires anew (settings.rewire).
    """

    attributes: tuple[tuple[str, str], ...] = ()
    shape: str = 'POINTS'
    space: str = 'WORLD'
    capacity: int = 1 << 22
    unneeded: Callable[[Any], Iterable[str]] = lambda _settings: ()
