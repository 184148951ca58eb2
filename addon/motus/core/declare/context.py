"""Context: the argument of every solve function, with what it reads in addition to its declared inputs, and the arrays that it fills."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ..file.pointers import pointed
from ..measures import scene_time


@dataclass
class Context:
    """First argument of a system's solve(), for one group of an owner's members; see docs/systems.md.

    The owner is the object whose settings are solved, its members are the objects and bones that are driven.

    To read: settings, owner: the settings and the object, evaluated. copy: the owner's Copy (core/evaluated/copies.py), None if it has
    none. frame: of the scene, with its fraction. depsgraph: dependency graph that is evaluated. member_data: (members,) numbers that
    System.member_data returned. group, data: Group.key and Group.data.
    To fill: locations, rotations, scales: (members, 3 or 4) arrays with a row for each member, preset to neutral values, which leave a
    member alone. outputs: list of numbers in the order of the declared names. offsets: (points, 3), if the system moves points.
    points(count): for a system that makes points, returns {name of an attribute: array with room for `count` points}. solve() has to
    fill all of them. The arrays are shorter if there is no room for so many, and are Blender's own memory, valid until solve() returns.
    wants_to_settle: solve() sets it to have System.settle() called after the evaluation.
    poses: PoseBuffer of the native module, whose memory locations, rotations and scales are, for native functions that fill it; None if the
    native module is missing, or nothing is to be filled.
    memo, targets: see begin().
    """

    settings: Any
    owner: Any
    frame: float = 0.0
    depsgraph: Any = None
    locations: Any = None
    rotations: Any = None
    scales: Any = None
    outputs: Any = field(default_factory=list)
    member_data: Any = None
    group: str = ""
    data: Any = field(default_factory=dict)
    offsets: Any = None
    points: Any = None
    wants_to_settle: bool = False
    memo: Any = None
    targets: Any = None
    copy: Any = None
    poses: Any = None
    _fps: float = 0.0  # 0 until it is asked for

    def __post_init__(self) -> None:
        if self.poses is not None:
            self.locations, self.rotations, self.scales = self.poses.locations, self.poses.rotations, self.poses.scales

    def begin(self, frame: float, depsgraph: Any, memo: Any, targets: Any = None) -> None:
        """Prepare the context for a call of solve() at a frame.

        memo: dictionary in which kept() stores results; None while the settings are animated. targets: {name of a pointer setting:
        evaluated object}; None if target() is to read the settings.
        """
        self.frame, self.depsgraph, self.memo, self.targets = frame, depsgraph, memo, targets
        self._fps = 0.0
        self.wants_to_settle = False

    def target(self, name: str) -> Any:
        """The evaluated object to which a pointer property of the settings points; None if there is none. name: of the property."""
        return pointed(self.settings, name) if self.targets is None else self.targets[name]

    @property
    def is_still(self) -> bool:
        """Whether neither keys nor drivers animate the settings, so that they change by edits alone."""
        return self.memo is not None

    def kept(self, name: str, key: Any, make: Callable[[], Any]) -> Any:
        """Result of `make()`, cached under `name` until `key` differs; while the settings are animated, `make` is called each time.

        make: function whose result depends on nothing but the settings and `key`; an edit of the settings empties the cache.
        """
        memo = self.memo
        if memo is None:
            return make()
        if name not in memo or memo[name][0] != key:
            memo[name] = key, make()
        return memo[name][1]

    @property
    def fps(self) -> float:
        """Frame rate of the scene that is evaluated, in frames per second."""
        if not self._fps:
            self._fps = scene_time.fps(self.depsgraph.scene)
        return self._fps
