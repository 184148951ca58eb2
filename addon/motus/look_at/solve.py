"""Solver of Look At: it reads the heads of a group from the evaluated scene, and turns their bones by one call of the native module."""

import math

from ..core import native, rigs
from ..core.declare import Problem
from ..core.file import deleted, stored
from ..core.lazy import numpy as np
from ..core.tracks.inputs import NEEDS_RECORDING, NOT_KNOWN, of_unknown
from . import blinks, reasons
from .groups import LOOPED, OUTPUTS, PLAN, goals, weights
from .properties import SIDE_LIMITS

SOME_ARE_OFF = Problem("Some heads have nothing to look at: the list says why", blocking=False)
TARGET_LOOPS = Problem("The target moves with the head that looks at it: choose another one", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")
PROBLEMS = (SOME_ARE_OFF, TARGET_LOOPS, BONES_CHANGED, NEEDS_RECORDING, NOT_KNOWN)

ANGLE, REASON = OUTPUTS.index("angle"), OUTPUTS.index("reason")
NUMBERS = ("weight", "body_weight", "head_weight", "eyes_weight", "clamp", "body_limit", "head_limit", "eyes_limit", *SIDE_LIMITS)


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
            "blinks?": {"rate": float, "seed": int, "angle": float, "lids": [float]},
            "saccades?": lambda value: stored.fits(value, (float, int)) and value[0] >= 0.0 and 0 <= value[1] < 1 << 31,
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
        self.saccades = [(row, *head["saccades"]) for row, head in enumerate(heads) if "saccades" in head]
        self.up = np.array([head.get("up", (0.0, 0.0, 1.0)) for head in heads], dtype=float).reshape(-1, 3)
        self.plan = native.module.LookAtPlan(
            rigs.parents(rig, list(rows)),
            [[rows[name] for name in head["body"]] for head in heads],
            [rows[head["name"]] for head in heads],
            [[rows[name] for name in head["eyes"]] for head in heads],
        )
        self.columns = {name: column for column, name in enumerate(native.module.LookAtPlan.SETTINGS)}
        self.bones = [[*head["body"], head["name"], *head["eyes"]] for head in heads]
        self.blinks = [(row, head["blinks"]) for row, head in enumerate(heads) if "blinks" in head]
        self.lids = [(index, angle) for index, (_, blink) in enumerate(self.blinks) for angle in blink["lids"]]
        self.turning = len(self.plan.rows)
        self.members = self.turning + len(self.lids)
        self.numbers = len(heads) * len(OUTPUTS) + len(self.blinks)
        report = native.module.LookAtPlan.REPORT
        self.told = np.array([report.index(name) for name in OUTPUTS])

    def beside(self, seconds, amplitudes):
        """How far the eyes of each head look beside its target at a time, (heads, 2), radians to the left and up.

        amplitudes: of the heads' saccades, (heads,), in radians.
        """
        found = np.zeros((len(self.names), 2))
        for row, rate, seed in self.saccades:
            found[row] = native.module.saccades(seconds, amplitudes[row], rate, seed)
        return found


def _eye_axes(head):
    axes, eyes = head["eyes_forward"], head["eyes"]
    if stored.fits(axes, _AXIS):
        return [axes] * len(eyes)
    if len(axes) != len(eyes):
        raise stored.Damaged("another number of eyes")
    return axes


class _Source:
    """Entries of a group of heads in an evaluated copy of the rig. Raises KeyError if one of them no longer exists."""

    def __init__(self, rig, copy, wired):
        self.wired, self.reader = wired, rigs.Reader(rig, copy, wired.still)
        every = rig.motus.look_at.entries
        self.places = [every.find(name) for name in wired.names]
        if -1 in self.places:
            raise KeyError
        entries = [every[place] for place in self.places]
        found = [goals(entry) for entry in entries]
        self.target_counts = [len(targets) for targets in found]
        self.targets = [(row, number > 0, *one) for row, targets in enumerate(found) for number, one in enumerate(targets)]


def solve(context):
    """Compute the turns of a group's bones at the present frame, into context.rotations and context.outputs.

    Returns a Problem, or None if there is none. A user's error never raises an exception.
    """
    text, looped = context.data.get(PLAN), context.data.get(LOOPED)
    try:
        source = rigs.source(context.owner, context.copy, text, lambda rig, rows: Wired(rig, rows, text), _Source)
    except (KeyError, ValueError):  # bones were removed, or have different parents
        return BONES_CHANGED
    if source.targets:
        problem = _solve(context, source)
        if problem:
            return problem
    return TARGET_LOOPS if looped else None


def _solve(context, source):
    wired, count = source.wired, len(source.target_counts)
    if (wired.members, wired.numbers) != (len(context.rotations), len(context.outputs)):
        raise stored.Damaged("another number of members or outputs")
    points, off, absent = _places(source.targets)
    settings, target_weights, muted, amplitudes = context.kept("heads", source, lambda: _settings(context.settings, source.places, wired))
    if absent:
        target_weights = target_weights.copy()
        target_weights[absent] = 0.0
    if off:
        settings = settings.copy()
        settings[list(off), wired.columns["is_on"]] = 0.0
    report = wired.plan.solve(
        wired.still.rest,
        source.reader.poses(),
        source.reader.basis(),
        wired.still.inheritance,
        rigs.world(context.owner),
        settings,
        points,
        wired.head_forward,
        wired.eyes_forward,
        rotations=context.rotations[: wired.turning] if wired.lids else context.rotations,
        up=wired.up,
        target_weights=target_weights,
        target_counts=source.target_counts,
        eyes_beside=wired.beside(context.frame / context.fps, amplitudes) if wired.saccades else None,
    )
    unknown = _blink(context, source, muted) if wired.blinks else None
    told = (context.outputs[: count * len(OUTPUTS)] if wired.blinks else context.outputs).reshape(count, len(OUTPUTS))
    report.take(wired.told, axis=1, out=told, mode='clip')  # mode 'raise' would copy the array first
    reason = told[:, REASON]
    if off:
        reason[list(off)] = list(off.values())
    if muted:
        reason[muted] = reasons.MUTED
    if reason[reason.argmin()] >= 0.0:  # argmin() is the fastest way to the lowest number
        return unknown
    told[reason < 0.0, ANGLE] = 0.0
    return SOME_ARE_OFF if ((reason < 0.0) & (reason != reasons.MUTED)).any() else unknown


def _blink(context, source, muted):
    """Shut the eyes of the heads that blink: turn their lids, and fill their outputs. A muted head leaves its lids and shape key alone.

    Returns the Problem of a gaze that is not known at other frames, whose turns no blinks go along with; None if there is none.
    """
    wired, seconds, problem = source.wired, context.frame / context.fps, None
    outputs = context.outputs[len(wired.names) * len(OUTPUTS) :]
    shut = np.zeros(len(wired.blinks))
    for index, (row, blink) in enumerate(wired.blinks):
        if row in muted:
            continue
        shut[index] = native.module.blinks(seconds, blink["rate"], blink["seed"])
        if blink["angle"] < math.pi:
            gaze = blinks.Gaze(context.owner, source.places[row], wired.bones[row], context.depsgraph.scene)
            if gaze.is_known:
                shut[index] = max(shut[index], gaze.closed(context.frame, blink["angle"]))
            else:
                problem = of_unknown(gaze)
        outputs[index] = shut[index]
    influence = context.settings.influence
    for place, (index, angle) in enumerate(wired.lids, wired.turning):
        half = 0.5 * angle * shut[index] * influence
        context.rotations[place] = math.cos(half), math.sin(half), 0.0, 0.0
    return problem


def _settings(settings, places, wired):
    """(settings of the heads, weights of all their targets, list of the muted heads, amplitudes of the heads' saccades or None).

    Settings are as LookAtPlan.solve() reads them, (heads, len(LookAtPlan.SETTINGS)) float64; so are weights, (targets,) float64.
    places: index of each head's entry.
    """
    entries, columns = settings.entries, wired.columns
    values = np.zeros((len(places), len(columns)))
    column = np.empty(len(entries), np.float32)
    for name in NUMBERS:
        entries.foreach_get(name, column)
        values[:, columns[name]] = column[places]
    muted = np.empty(len(entries), bool)
    entries.foreach_get("is_muted", muted)
    muted = muted[places]
    values[:, columns["is_on"]] = ~muted
    values[:, columns["weight"]] *= settings.influence
    target_weights = np.array([weight for place in places for weight in weights(entries[place])])
    amplitudes = None
    if wired.saccades:
        entries.foreach_get("saccade_amplitude", column)
        amplitudes = column[places].astype(float).tolist()
    return values, target_weights, np.flatnonzero(muted).tolist(), amplitudes


def _places(targets):
    """World positions of all heads' targets, (targets, 3); {row of a head without its first target: reason}; rows of further targets that are missing.

    targets: (row of the head, whether it is a further target, evaluated object or None, name of its bone or "") of each.
    """
    points, off, absent = np.zeros((len(targets), 3)), {}, []
    for place, (row, is_further, target, bone) in enumerate(targets):
        points[place], reason = _place(target, bone)
        if reason and is_further:
            absent.append(place)
        elif reason:
            off[row] = reason
    return points, off, absent


def _place(target, bone):
    """(world position of a target, reason why the target is missing or 0.0)."""
    if target is None:
        return (0.0, 0.0, 0.0), reasons.NO_TARGET
    if deleted.is_deleted(target):
        return (0.0, 0.0, 0.0), reasons.TARGET_DELETED
    if not bone or target.pose is None:  # on an object without bones, a bone's name is left from an earlier target
        return target.matrix_world.translation, 0.0
    if bone in target.pose.bones:
        return target.matrix_world @ target.pose.bones[bone].head, 0.0
    return (0.0, 0.0, 0.0), reasons.NO_TARGET_BONE
