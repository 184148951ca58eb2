"""The share that an owner has of the work that a system may do while Blender waits for a frame (core/measures/bounds.py).

All owners of a system in a scene share the limit, so that a frame of a scene with many owners takes no longer than one with a single
owner. Shares follow from the settings of the scene's objects alone, not from what is kept or from which owner is solved first.
"""

from __future__ import annotations

import math
from typing import Any

import bpy
from bpy.app.handlers import persistent

from .. import keeping
from ..blender import handlers
from ..declare import System, is_owner, of_owner

_loads = keeping.OfFile(
    "sums of the loads (System.load) of all owners of a system in a scene",
    "name of the system, address of the scene, number of edits since the add-on was enabled",
    most=64,
)
_edits = [0]
_waits = [False]


def waits_for_all(depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether all work of a frame is waited for, however long it takes: by renders, and while a file is handed over."""
    return depsgraph.mode == 'RENDER' or _waits[0]


def wait_for_all() -> None:
    """Have all work of every frame waited for from now on, as in the Blender that hands a file over."""
    _waits[0] = True


def edits() -> int:
    """Counter that increases whenever the share of any owner may have changed, which playback does not do."""
    return _edits[0]


def share_of(system: System, owner: Any, depsgraph: bpy.types.Depsgraph) -> float:
    """Share, from 0 to 1, that an owner has of the work that its system may do at once for a frame of a dependency graph.

    It is a half, a fourth and so on, so that it rarely changes if owners come and go. system: declares System.load. A render waits for
    all work: each owner has the whole limit there.
    """
    # While a render runs on its own thread, the user may edit the objects that the sum of loads is made from.
    if waits_for_all(depsgraph) or system.load is None:
        return 1.0
    evaluated: Any = depsgraph.scene
    scene = evaluated.original
    total = _loads.made((system.name, scene.as_pointer(), _edits[0]), lambda: _sum(system, scene))
    own = _load(system, owner)
    return 1.0 if total <= own else 2.0 ** -math.ceil(math.log2(total / own))


def _sum(system: System, scene: Any) -> float:
    # Originals are read, because Blender may be making the evaluated copies at this moment.
    return sum(_load(system, obj) for obj in scene.objects if is_owner(system, obj))


def _load(system: System, owner: Any) -> float:
    load: float = system.load(of_owner(system, owner)) if system.load else 1.0
    return max(1.0, load)


@persistent
def forget(*_: Any) -> None:
    """Have the loads summed anew by the next evaluation, since owners may have come or gone, or their settings changed."""
    _edits[0] += 1


def _watched() -> list[handlers.Pair]:
    # Blender calls the handlers before it evaluates an edit, but not before it evaluates a different frame.
    return [(bpy.app.handlers.depsgraph_update_pre, forget)]


def register() -> None:
    """Add the handler that has the loads summed anew after edits."""
    handlers.add(_watched())


def unregister() -> None:
    """Remove the handler that register() has added."""
    handlers.remove(_watched())
