"""Solver of Look At: it reads the heads of a group from the evaluated scene, and turns their bones by one call of the native module."""

from ..core import native, rigs
from ..core.declare import Problem
from ..core.file import deleted, stored
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from . import reasons
from .groups import LOOPED, OUTPUTS, PLAN

SOME_ARE_OFF = Problem("Some heads have nothing to look at: the list says why", blocking=False)
TARGET_LOOPS = Problem("The target moves with the head that looks at it: choose another one", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")
PROBLEMS = (SOME_ARE_OFF, TARGET_LOOPS, BONES_CHANGED)

NUMBERS = ("weight", "body_weight", "head_weight", "eyes_weight", "clamp", "body_limit", "head_limit", "eyes_limit")


_AXIS = (float, float, float)
_FORM = {
    "fingerprint": int,
    "heads": [
        {
            "name": str,
            "body": [str],
            "eyes": [str],
            "head_forward": _AXIS,
            "eyes_forward": lambda value: stored.fits(value, [_AXIS]) or stored.fits(value, _AXIS),
            "up?": _AXIS,
        }
    ],
}
"""Form of the JSON text that groups.plan_of() writes.

Older versions of Motus wrote one axis for all eyes of a head, and no up axis, which was Z.
"""


class Wired:
    """Native LookAtPlan of a group of heads, and the axes along which head and eye bones look.

    It is kept between frames, and made anew when the rig's bones change.
    """

    def __init__(self, rig, rows, text):
        heads = stored.parse(text, _FORM)["heads"]
        self.still = rigs.still(rig, tuple(rows))
        self.names = [head["name"] for head in heads]
        self.head_forward = np.array([head["head_forward"] for head in heads], dtype=float).reshape(-1, 3)
        self.eyes_forward = np.array([axis for head in heads for axis in _eye_axes(head)], dtype=float).reshape(-1, 3)
        self.up = np.array([head.get("up", (0.0, 0.0, 1.0)) for head in heads], dtype=float).reshape(-1, 3)
        self.plan = native.module.LookAtPlan(
            rigs.parents(rig, list(rows)),
            [[rows[name] for name in head["body"]] for head in heads],
            [rows[head["name"]] for head in heads],
            [[rows[name] for name in head["eyes"]] for head in heads],
        )
        self.columns = {name: column for column, name in enumerate(native.module.LookAtPlan.SETTINGS)}
        self.members = len(self.plan.rows)
        report = native.module.LookAtPlan.REPORT
        self.told = [report.index(name) for name in OUTPUTS]


def _eye_axes(head):
    axes, eyes = head["eyes_forward"], head["eyes"]
    if stored.fits(axes, _AXIS):
        return [axes] * len(eyes)
    if len(axes) != len(eyes):
        raise stored.Damaged("another number of eyes")
    return axes


class _Source:
    """Entries of a group of heads in an evaluated copy of the rig. Raises KeyError if one of them no longer exists."""

    def __init__(self, rig, wired):
        self.wired = wired
        every = rig.motus.look_at.entries
        self.places = [every.find(name) for name in wired.names]
        if -1 in self.places:
            raise KeyError
        self.entries = [every[place] for place in self.places]


def solve(context):
    """Compute the turns of a group's bones at the present frame, into context.rotations and context.outputs.

    Returns a Problem, or None if there is none. A user's error never raises an exception.
    """
    text, looped = context.data.get(PLAN), context.data.get(LOOPED)
    try:
        source = rigs.source(context.owner, text, lambda rig, rows: Wired(rig, rows, text), _Source)
    except (KeyError, ValueError):  # bones were removed, or have different parents
        return BONES_CHANGED
    if source.entries:
        problem = _solve(context, source)
        if problem:
            return problem
    return TARGET_LOOPS if looped else None


def _solve(context, source):
    wired, count = source.wired, len(source.entries)
    if (wired.members, count * len(OUTPUTS)) != (len(context.rotations), len(context.outputs)):
        raise stored.Damaged("another number of members or outputs")
    points, found = _targets(source.entries)
    settings = context.kept("heads", source, lambda: _settings(context.settings, source.places, wired.columns))
    muted = settings[:, wired.columns["is_on"]] == 0.0
    is_off = found != reasons.REACHED
    if is_off.any():
        settings = settings.copy()
        settings[is_off, wired.columns["is_on"]] = 0.0
    arrays = rigs.read(context.owner, wired.still)
    report = wired.plan.solve(
        arrays.rest,
        arrays.poses,
        arrays.basis,
        arrays.inheritance,
        arrays.world,
        settings,
        points,
        wired.head_forward,
        wired.eyes_forward,
        rotations=context.rotations,
        up=wired.up,
    )
    told = context.outputs.reshape(count, len(OUTPUTS))
    told[:] = report[:, wired.told]
    reason = told[:, OUTPUTS.index("reason")]
    reason[is_off] = found[is_off]
    reason[muted] = reasons.MUTED
    told[reason < 0.0, OUTPUTS.index("angle")] = 0.0
    return SOME_ARE_OFF if ((reason < 0.0) & (reason != reasons.MUTED)).any() else None


def _settings(settings, places, columns):
    """Settings of the heads as LookAtPlan.solve() reads them, (heads, len(LookAtPlan.SETTINGS)) float64.

    places: index of each head's entry. columns: {name of a setting: column}.
    """
    entries = settings.entries
    values = np.zeros((len(places), len(columns)))
    column = np.empty(len(entries), np.float32)
    for name in NUMBERS:
        entries.foreach_get(name, column)
        values[:, columns[name]] = column[places]
    muted = np.empty(len(entries), bool)
    entries.foreach_get("is_muted", muted)
    values[:, columns["is_on"]] = ~muted[places]
    values[:, columns["weight"]] *= settings.influence
    return values


def _targets(entries):
    """World positions of the heads' targets, (heads, 3), and for each head a reason (heads,): REACHED, or why it has no target."""
    points = np.zeros((len(entries), 3))
    found = np.full(len(entries), reasons.REACHED)
    for row, entry in enumerate(entries):
        target = pointed(entry, "target")
        if target is None:
            found[row] = reasons.NO_TARGET
        elif deleted.is_deleted(target):
            found[row] = reasons.TARGET_DELETED
        elif not entry.target_bone or target.pose is None:  # on an object without bones, a bone's name is left from an earlier target
            points[row] = target.matrix_world.translation
        elif entry.target_bone in target.pose.bones:
            points[row] = target.matrix_world @ target.pose.bones[entry.target_bone].head
        else:
            found[row] = reasons.NO_TARGET_BONE
    return points, found
