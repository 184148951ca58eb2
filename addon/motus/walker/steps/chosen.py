"""Change steps of a walker: the entries in its settings, which the plan follows, and the steps of the plan that they belong to.

Places are in the space that the steps are planned in: the world, or the space of the walker's carrier.
"""

import math
from typing import Any, NamedTuple

from mathutils import Matrix, Quaternion, Vector

from ...core import wiring
from ...core.declare import Problem
from ...core.lazy import numpy as np
from ...core.measures import axes, scene_time
from ...core.refusals import Refused
from ...core.settings import lists
from ...core.translations import tr
from .. import carrier, legs, plan, setup, told

CHANGED = "offset", "turn", "is_locked", "place", "rotation", "use_touch", "touch", "use_lift", "lift"
"""Names of the properties of an entry that say what was changed of its step."""


class Step(NamedTuple):
    """A step of the plan. leg: index of the leg. middle: of the foot's stand, s.

    end, turn: place of the foot, and rotation of its flat sole from the body's space. entry: index of the entry that chose the step; -1 if
    the step is as it was planned. planned: the middle of the stand if no step were timed, s, by which an entry chooses the step. touch, lift:
    when the foot touches the ground and when it lifts again, s; -inf if it was put there, inf if it stays.
    """

    leg: int
    middle: float
    end: Any
    turn: Any
    entry: int
    planned: float
    touch: float
    lift: float


def plan_again(context, owner):
    """Have a walker planned by its settings as they are: a script that has changed the list of its steps has not told Blender so."""
    wiring.touch(setup.system(), owner)
    context.view_layer.update()


def planned(context, owner):
    """The steps of a walker as it is planned now, as of the native Walker. Raises Refused if it does not walk."""
    found = told.found(context, owner)
    if isinstance(found, Problem):
        raise Refused(tr(found.sentence))
    return found.walker.steps


def _step(arrays, row):
    leg, touch = arrays["leg"][row], float(arrays["touch"][row])
    goes_on = row + 1 < len(arrays["leg"]) and arrays["leg"][row + 1] == leg
    return Step(
        int(leg),
        float(arrays["middle"][row]),
        arrays["end"][row],
        arrays["turn"][row],
        int(arrays["chosen"][row]),
        float(arrays["planned"][row]),
        -math.inf if arrays["lift"][row] == touch else touch,
        float(arrays["lift"][row + 1]) if goes_on else math.inf,
    )


def near(context, owner, seconds, most):
    """List the Steps of a walker, the middle of whose stands is at most so many seconds from a time. owner: original object that walks.

    Raises Refused if it does not walk.
    """
    arrays = planned(context, owner)
    return [_step(arrays, row) for row in np.flatnonzero(np.abs(arrays["middle"] - seconds) <= most)]


def between(context, owner, first, last):
    """List the Steps of a walker on which a foot stands at some time from `first` to `last`, s, in the order of legs and times.

    owner: original object that walks. Raises Refused if it does not walk.
    """
    arrays = planned(context, owner)
    found = [_step(arrays, row) for row in np.flatnonzero(arrays["touch"] <= last)]
    return [step for step in found if step.lift >= first]


def changed(context, owner):
    """{index of an entry in a walker's settings: the Step that it chooses}; an entry without effect chooses none.

    owner: original object that walks. Raises Refused if it does not walk.
    """
    arrays = planned(context, owner)
    return {int(arrays["chosen"][row]): _step(arrays, row) for row in np.flatnonzero(arrays["chosen"] >= 0)}


def step_of_entry(context, owner, index):
    """Return the Step that an entry of a walker's settings chooses. Raises Refused if it chooses none, or the owner does not walk."""
    found = changed(context, owner).get(index)
    if found is None:
        raise Refused(tr("{object} has no such step").format(object=owner.name))
    return found


def step_at(context, owner, leg, frame):
    """Return the Step of a leg on which its foot stands at a frame, or to which it swings then. owner: original object that walks.

    Raises Refused if it does not walk.
    """
    arrays = planned(context, owner)
    rows = np.flatnonzero(arrays["leg"] == leg)
    begun = int(arrays["lift"][rows].searchsorted(frame / scene_time.fps(context.scene), "right"))
    return _step(arrays, rows[max(begun - 1, 0)])


def leg_named(owner, name):
    """Index of the leg whose foot has this name. Raises Refused if there is none."""
    found = next((index for index, leg in enumerate(owner.motus.walker.legs) if legs.label(leg) == name), None)
    if found is None:
        raise Refused(tr("{object} has no foot {foot}").format(object=owner.name, foot=name))
    return found


def space(context, owner):
    """Matrix of the space that the steps of a walker are planned in, on the present frame."""
    evaluated = owner.evaluated_get(context.evaluated_depsgraph_get())
    found = carrier.of(evaluated.motus.walker)
    if found is None:
        return Matrix.Identity(4)
    return Matrix(carrier.space_of(found.evaluated_get(context.evaluated_depsgraph_get()).matrix_world).tolist())


class Edit:
    """A change of one step of a walker: move(), turn(), time() and lock() write it into the settings, restore() takes all of it back.

    owner: original object that walks. step: Step of its plan. The entry of the step is added when the step is first changed.
    """

    def __init__(self, context, owner, step):
        self._owner, self._step = owner, step
        self._pose = _pose(context, owner, step.middle)
        self._up = Vector(axes.vector(owner.motus.walker.up_axis))
        self._frame = step.planned * scene_time.fps(context.scene)
        self._before = _values(owner.motus.walker.steps[step.entry]) if step.entry >= 0 else None
        self._offset = Vector(self._before["offset"]) if self._before else Vector()
        self._index = step.entry

    @property
    def _entry(self):
        """The entry of the step in the walker's settings."""
        entries = self._owner.motus.walker.steps
        if self._index < 0:
            self._index = len(entries)
            made = lists.add_numbered(entries, "Step")
            made.leg, made.frame = self._step.leg, self._frame
        if self._index >= len(entries):
            raise ReferenceError(f"{self._owner.name} has no such step any more")
        return entries[self._index]

    def move(self, place):
        """Have the foot stand at a place, or below or above it on the ground if the step is not locked."""
        moved = Vector(place) - Vector(self._step.end)
        linear = self._pose.to_3x3()
        if linear.determinant() == 0.0:
            raise Refused(tr("{object} is scaled to nothing in a direction").format(object=self._owner.name))
        entry = self._entry
        if entry.is_locked:
            entry.place = place
        else:
            entry.offset = self._offset + linear.inverted() @ moved

    def turn(self, angle):
        """Turn the sole of the foot about the ground's normal, by an angle from where it is planned: rad, counter-clockwise from above."""
        self._entry.turn = angle

    def time(self, name, frame):
        """Have the foot touch the ground on a frame (name "touch"), or stand until a frame (name "lift"); the frame is in the keys' time."""
        entry = self._entry
        setattr(entry, name, frame)
        setattr(entry, f"use_{name}", True)

    def lock(self):
        """Have the foot stand where it stands now, whatever body and ground do."""
        entry = self._entry
        if not entry.is_locked:
            entry.place = self._step.end
            entry.rotation = Quaternion(self._step.turn) @ Quaternion(self._up, -entry.turn)
            entry.is_locked = True

    def unlock(self):
        """Have the foot go along with body and ground again, from where it stands now."""
        entry = self._entry
        if entry.is_locked:
            rest = self._owner.motus.walker.legs[self._step.leg].rest
            self._offset = entry.offset = self._pose.inverted_safe() @ Vector(self._step.end) - Vector(rest)
            entry.is_locked = False

    def restore(self):
        """Take back all changes of the step."""
        if self._before is None:
            if 0 <= self._index < len(self._owner.motus.walker.steps):
                remove(self._owner, self._index)
        else:
            entry = self._entry
            for name, value in self._before.items():
                setattr(entry, name, value)


def _values(entry):
    return {name: _plain(getattr(entry, name)) for name in CHANGED}


def _plain(value):
    return tuple(value) if hasattr(value, "__len__") else value


def _pose(context, owner, seconds):
    """Matrix of a walker's body at a time, in the space that its steps are planned in; at present if its motion is not known."""
    evaluated = owner.evaluated_get(context.evaluated_depsgraph_get())
    track = plan.way_track(evaluated, context.scene)
    if not track.is_known:
        return space(context, owner).inverted_safe() @ evaluated.matrix_world
    return Matrix(track.values(np.array([seconds * scene_time.fps(context.scene)]))[0].tolist())


def entry_at(owner, index):
    """Return the entry of a chosen step. Raises Refused if there is none."""
    entries = owner.motus.walker.steps
    if not 0 <= index < len(entries):
        raise Refused(tr("{object} has no such step").format(object=owner.name))
    return entries[index]


def remove(owner, index):
    """Remove the entry of a chosen step, which is planned again then. Raises Refused if the entry is from a library."""
    lists.remove(owner.motus.walker.steps, index)
    wiring.touch(setup.system(), owner)
