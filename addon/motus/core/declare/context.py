"""What a solve function is given beyond its declared inputs, and what it fills."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ..file.pointers import pointed
from ..measures import scene_time


@dataclass
class Context:
    """What solve() reads beyond its declared inputs, and what it fills; see docs/systems.md.

    common: kept by solve() itself for all owners that are solved at once, from the same inputs at the same frame.
    points(count): arrays for so many points by the names of their attributes, of a system that makes points. All of them are
    to be filled; they are shorter where there is no room for so many, and Blender's own memory, valid until solve() returns.
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
    common: dict[str, Any] = field(default_factory=dict)

    def begin(self, frame: float, depsgraph: Any, memo: Any, common: dict[str, Any] | None = None, targets: Any = None) -> None:
        """Prepare the context for a solve at a frame.

        memo: storage for kept(), None while the settings are animated. common: data shared by owners that are solved at once.
        targets: {pointer setting: evaluated object}, None to read them from the settings.
        """
        self.frame, self.depsgraph, self.memo, self.targets = frame, depsgraph, memo, targets
        self.common = {} if common is None else common
        self.wants_to_settle = False

    def target(self, name: str) -> Any:
        """The evaluated object that a pointer setting names."""
        return pointed(self.settings, name) if self.targets is None else self.targets[name]

    @property
    def is_still(self) -> bool:
        """Whether nothing animates the settings: they are the same until somebody edits them."""
        return self.memo is not None

    def kept(self, name: str, key: Any, make: Callable[[], Any]) -> Any:
        """Result of `make()`, cached under `name` until `key` differs; `make` is called in each solve while the settings are animated.

        `make` may depend on nothing but the settings and `key`.
        """
        if self.memo is None:
            return make()
        found = self.memo.get(name)
        if found is None or found[0] != key:
            found = self.memo[name] = key, make()
        return found[1]

    @property
    def fps(self) -> float:
        """Frames a second."""
        found = self.common.get("fps")
        if found is None:
            found = self.common["fps"] = scene_time.fps(self.depsgraph.scene)
        return found
