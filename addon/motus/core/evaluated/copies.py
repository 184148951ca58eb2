"""Data that was read from an evaluated datablock, kept for as long as Blender keeps that evaluated copy.

Blender evaluates copies of datablocks. If somebody edits, undoes or relinks a datablock, Blender makes a new evaluated copy of it;
animation and drivers alone write into the existing copy. Therefore a number is written into a custom property of the evaluated
copy (KEY), which is 0 on the original. A copy with a number was read before, and all its properties without animation are unchanged.
"""

from __future__ import annotations

import itertools
import random
import threading
from collections.abc import Iterable
from typing import Any, NamedTuple, TypeVar

import bpy
from bpy.app.handlers import persistent

from .. import keeping
from ..blender import actions
from ..file import stored

T = TypeVar("T")
KEY = "motus_copy"
"""Name of the marker: a custom property, an array of one integer, which is 0 on the original and the copy's number on an evaluated copy.

It is an array because the memory of an array's element can be written in place.
"""
# The first number is random, so that an add-on that was enabled again does not assign numbers that are still in use.
_first = random.randrange(1, 2**30)
_numbers = itertools.count(_first)
_latest = [_first - 1]


def original_of(evaluated: Any, originals: Any, depsgraph: bpy.types.Depsgraph) -> Any:
    """The original of a datablock from depsgraph.updates; None if another handler has removed the original.

    originals: the collection that holds the original, such as bpy.data.objects. The search goes by name, since `original` and `library`
    of the evaluated datablock may point to memory that Blender has freed since the evaluation.
    """
    name = evaluated.name
    found = (originals.get((name, path)) for path in (None, *(library.filepath for library in bpy.data.libraries)))
    return next((one for one in found if one is not None and one.evaluated_get(depsgraph) == evaluated), None)


class _OfCopies(keeping.OfEvaluation):
    """Data about evaluated datablocks, each kept until Blender makes a new evaluated copy of the datablock.

    Blender writes a new evaluated copy to the same memory address as the copy before.
    """

    FEW = 64
    """Up to this many copies are kept without a search for copies that Blender has freed."""

    def __init__(self, what: str) -> None:
        super().__init__(what, "unique number of the evaluated copy", "one for each evaluated copy that Blender has")
        self.known: dict[int | None, Any] = {}  # number of an evaluated copy -> data about the copy
        self._places: dict[int, tuple[Any, int]] = {}  # address of an evaluated datablock -> (datablock, number)
        self._most = self.FEW
        self._changing = threading.Lock()

    def add(self, evaluated: Any, number: int, found: T) -> T:
        """Keep `found`, data about an evaluated copy, in place of the data about the copy before it; returns `found`.

        number: the number of the evaluated copy.
        """
        place = evaluated.as_pointer()
        with self._changing:
            self._forget(place)
            self._places[place] = evaluated, number
            self.known[number] = found
            if len(self._places) > self._most:
                for gone in [place for place, (datablock, _) in self._places.items() if is_gone(datablock)]:
                    self._forget(gone)
                self._most = 2 * max(len(self._places), self.FEW)
        return found

    def _forget(self, place: int) -> None:
        _, number = self._places.pop(place, (None, 0))
        self.known.pop(number, None)

    def clear(self) -> None:
        """Remove the data about all evaluated datablocks."""
        with self._changing:
            self._places.clear()
            self.known.clear()
            self._most = self.FEW


def is_gone(datablock: Any) -> bool:
    """Whether Blender has freed an evaluated datablock."""
    try:
        datablock.as_pointer()
    except ReferenceError:
        return True
    return False


_copies = _OfCopies(
    "for each evaluated object, armature, curve or scene: its number of drivers, its action, and the values that other declarations keep with it"
)
_found = _OfCopies("for each evaluated action: the values that other declarations keep with it")
_REACH = keeping.OfEvaluation("settings and bones that an action animates (Reach)", "the evaluated action", "one for each evaluated action")


class Reach(NamedTuple):
    """Which properties animation sets.

    settings: whether any setting of Motus. splines: whether any property of a curve's splines or their points. bones: names of the bones
    whose own transform (location, rotation or scale) is set; None if it may be any bone.
    """

    settings: bool
    splines: bool
    bones: frozenset[str] | None

    def poses(self, names: frozenset[str] | None) -> bool:
        """Whether the animation sets the own transform of one of the bones named in `names`; None stands for all bones."""
        if self.bones is None or names is None:
            return self.bones is None or len(self.bones) > 0
        return not self.bones.isdisjoint(names)


_NOTHING, _ANYTHING = Reach(False, False, frozenset()), Reach(True, True, None)


class Copy:
    """Data about one evaluated copy of a datablock: which properties its animation sets, and what solvers have read from the copy.

    number: different for every copy. found: the values that were read from the copy, by the keeping.OfEvaluation that declares them.
    """

    def __init__(self, evaluated: Any, number: int) -> None:
        self.number = number
        self.found: dict[Any, Any] = {}
        animation = evaluated.animation_data
        self.drivers = drivers_on(evaluated)
        self._driven = _reach(animation.drivers) if self.drivers else _NOTHING
        self._action = animation and animation.action
        self._has_strips = animation is not None and bool(animation.nla_tracks)
        self._acted: tuple[int | None, Reach] = None, _NOTHING  # number of the action's copy that was read, and what it sets
        self._is_acted_on = bool(self._action or self._has_strips)

    @property
    def _acting(self) -> Reach:
        """What the copy's action sets, in any slot, as a Reach; with NLA tracks, possibly everything.

        The action's number is compared at each use, since after an edit of keys Blender copies the action anew, but not the datablocks
        that use it.
        """
        if self._has_strips:
            return _ANYTHING
        action = self._action
        if action is None:
            return _NOTHING
        number = action.get(KEY)
        if number is None or number != self._acted[0]:
            reach = _reach_of_action(action)
            self._acted = number_of_action(action), reach
        return self._acted[1]

    @property
    def has_animated_settings(self) -> bool:
        """Whether an action, the NLA or a driver sets any setting of Motus on the datablock."""
        return self._driven.settings or (self._is_acted_on and self._acting.settings)

    @property
    def has_animated_splines(self) -> bool:
        """Whether an action, the NLA or a driver sets a property of a curve's splines or their points."""
        return self._driven.splines or (self._is_acted_on and self._acting.splines)

    @property
    def has_driven_poses(self) -> bool:
        """Whether a driver sets the own transform or the rotation mode of any bone."""
        return self._driven.poses(None)

    def has_animated_poses(self, names: frozenset[str] | None) -> bool:
        """Whether an action, the NLA or a driver sets the own transform of a bone among `names`, a frozenset; None stands for all bones."""
        return self._driven.poses(names) or (self._is_acted_on and self._acting.poses(names))


def prepare(owner: Any) -> None:
    """Add to an owner the marker property by which its evaluated copies are told apart. Called when the owner's drivers are added.

    A rig's armature and the scenes that use the rig get the marker too.
    """
    mark(owner, *((owner.data, *owner.users_scene) if owner.type == 'ARMATURE' else ()))


def mark(*datablocks: Any) -> None:
    """Add to datablocks the marker property by which their evaluated copies are told apart. Linked datablocks are skipped."""
    for datablock in datablocks:
        if not datablock.library and _mark(datablock) is None:
            datablock[KEY] = [0]
            datablock.update_tag()


def unmark(datablock: Any) -> None:
    """Remove the marker property of a datablock, so that its evaluated copies are no longer told apart. A linked datablock is skipped."""
    if not datablock.library:
        datablock.pop(KEY, None)


def release(owner: Any) -> None:
    """Remove the marker property of an owner.

    For a rig it is also removed from the armature, unless another rig with the marker uses it, and from scenes without such a rig.
    """
    if owner.pop(KEY, None) is None or owner.type != 'ARMATURE':
        return
    data = owner.data
    objects: Any = bpy.data.objects
    if not data.library and all(KEY not in other for other in objects if other.data == data):
        data.pop(KEY, None)
    scene: Any
    for scene in bpy.data.scenes:
        if not scene.library and not any(other.type == 'ARMATURE' and KEY in other for other in scene.objects):
            scene.pop(KEY, None)


def of(evaluated: Any) -> Copy | None:
    """The Copy of an evaluated datablock; None if the datablock has no marker property (KEY), as in a file of an older version."""
    mark = evaluated.get(KEY)
    try:  # without a check of the property's type: only numbers that were assigned are keys of `known`
        return _copies.known[mark[0]]
    except (KeyError, TypeError, IndexError):
        number = _number_of(evaluated)
    found = _copies.known.get(number)
    return _copies.add(evaluated, number, Copy(evaluated, number)) if number and found is None else found


def stamp_of_data(evaluated: Any) -> int | None:
    """A number that changes whenever Blender makes a new evaluated copy of an object's data; None if that cannot be detected."""
    copy = of(evaluated.data)
    if copy is None and evaluated.data.library:  # linked data change only with their library: then the object is copied anew too
        copy = of(evaluated)
    return None if copy is None else copy.number


def _number_of(evaluated: Any) -> int:
    """The number of an evaluated datablock, which no other evaluated copy has had; 0 for an original, or without a marker property."""
    mark = _mark(evaluated)
    if mark is None or not evaluated.is_evaluated:  # all evaluated copies would inherit a number that is written into the original
        return 0
    return _number_in(mark)


def _number_in(mark: Any) -> int:
    if not _is_given(mark[0]):
        mark[0] = _new_number()
    return mark[0]


def number_given(evaluated: Any) -> int:
    """Number by which an evaluated copy of a datablock is told apart from all copies before and after it; it is assigned if missing.

    The number is stored in a custom property (KEY) of the evaluated copy, which is added if it is missing. Only for datablocks whose
    custom properties no other thread reads at the same time, such as meshes.
    """
    mark = _mark(evaluated)
    if mark is None:
        evaluated[KEY] = [0]
        mark = _mark(evaluated)
    # is_evaluated is not checked: it is False for meshes that modifiers make.
    return _number_in(mark)


@persistent
def forget(*_: Any) -> None:
    """Forget all data about evaluated copies, so that every evaluated copy counts as a new one.

    Called if another file is loaded, or if the property classes to which the data refer are unregistered.
    """
    for known in (_copies, _found):
        known.clear()


def number_of_action(action: Any) -> int | None:
    """The number of an evaluated copy of an action, different for every copy; None for an original action.

    An edit of keys makes Blender copy the action anew, so that the number changes.
    """
    if not action.is_evaluated:  # all evaluated copies would inherit a number that is written into the original
        return None
    number = action.get(KEY)
    if number.__class__ is int and _first <= number <= _latest[0]:  # as _is_given() finds, without a call
        return number
    number = action[KEY] = _new_number()
    return number


def found_of_action(action: Any) -> dict[Any, Any]:
    """Values that were derived from an evaluated action, kept with it for keeping.OfEvaluation.within(); {} for an original action."""
    number = number_of_action(action)
    if number is None:
        return {}
    return _found.known[number] if number in _found.known else _found.add(action, number, {})


def _mark(datablock: Any) -> memoryview[int] | None:
    """View of the memory of the custom property (KEY) that holds an evaluated copy's number; None if it is missing or of a different form."""
    try:
        return stored.whole_numbers(datablock.get(KEY), 1)
    except stored.Damaged:
        return None


def _is_given(number: Any) -> bool:
    """Whether a copy's number was assigned since this module was loaded. A number that came with a file was not."""
    return isinstance(number, int) and _first <= number <= _latest[0]


def _new_number() -> int:
    # If two threads are here at once, the greater number may count as not assigned; its copy then gets another number.
    _latest[0] = number = next(_numbers)
    return number


def has_moving_settings(evaluated: Any) -> bool:
    """Whether an action, the NLA or a driver sets a setting of Motus on an evaluated object.

    If the object has no marker property (KEY), by which evaluated copies are told apart, any animation counts.
    """
    copy = of(evaluated)
    return has_animation(evaluated) if copy is None else copy.has_animated_settings


def has_animated_settings(owner: Any) -> bool:
    """Whether an action, the NLA or a driver sets a setting of Motus on an original object."""
    animation = owner.animation_data
    if animation is None:
        return False
    curves = itertools.chain(animation.drivers, *(actions.all_fcurves(animation.action) if animation.action else ()))
    return bool(animation.nla_tracks) or _reach(curves).settings


def has_driven_settings(owner: Any) -> bool:
    """Whether a driver sets a setting of Motus on an original object."""
    animation = owner.animation_data
    return animation is not None and _reach(animation.drivers).settings


def drivers_on(datablock: Any) -> int:
    """Number of drivers of a datablock."""
    animation = datablock.animation_data
    return len(animation.drivers) if animation else 0


def has_driven_poses(evaluated: Any) -> bool:
    """Whether a driver sets the own transform or the rotation mode of any bone of an evaluated rig, with or without a marker property."""
    copy = of(evaluated)
    if copy is not None:
        return copy.has_driven_poses
    return drivers_on(evaluated) > 0 and _reach(evaluated.animation_data.drivers).poses(None)


def has_animation(evaluated: Any) -> bool:
    """Whether an evaluated object has an action, NLA tracks or drivers. Without them its properties are as Blender has copied them."""
    animation = evaluated.animation_data
    return animation is not None and bool(animation.action or animation.nla_tracks or animation.drivers)


def _reach_of_action(action: Any) -> Reach:
    kept = _REACH.within(found_of_action(action))
    known: Reach | None = kept.get("reach")
    if known is None:
        known = kept["reach"] = _reach(itertools.chain.from_iterable(actions.all_fcurves(action)))
    return known


def _reach(curves: Iterable[Any]) -> Reach:
    paths = {curve.data_path for curve in curves}
    names = {match["bone"] for match in map(actions.OWN_CHANNEL.match, paths) if match}
    # A data path may name a bone by its index too.
    bones = None if None in names else frozenset(map(bpy.utils.unescape_identifier, names))
    return Reach(_any_begins(paths, "motus."), _any_begins(paths, ("splines", "[")), bones)


def _any_begins(paths: Iterable[str], beginning: str | tuple[str, ...]) -> bool:
    return any(path.startswith(beginning) for path in paths)
