"""Look At: what a group's solver reads of Blender, and the one call of the native module."""

from ..core import deleted, native, rigs, stored
from ..core.lazy import numpy as np
from ..core.system import Problem
from . import reasons
from .groups import LOOPED, OUTPUTS, PLAN

SOME_ARE_OFF = Problem("Some heads have nothing to look at: the list says why", blocking=False)
TARGET_LOOPS = Problem("The target moves with the head that looks at it: choose another one", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")
PROBLEMS = (SOME_ARE_OFF, TARGET_LOOPS, BONES_CHANGED)

NUMBERS = (
    "weight", "body_weight", "head_weight", "eyes_weight", "clamp", "body_limit", "head_limit", "eyes_limit")


_AXIS = (float, float, float)
_FORM = {"fingerprint": int, "heads": [
    {"name": str, "body": [str], "eyes": [str], "head_forward": _AXIS, "eyes_forward": _AXIS}]}
"""Of what groups.py notes."""


class Wired:
    """What is known of a group between two changes of the rig: the plan, and which bones look where."""

    def __init__(self, rig, rows, text):
        heads = stored.parse(text, _FORM)["heads"]
        self.still = rigs.still(rig, tuple(rows))
        self.names = [head["name"] for head in heads]
        self.head_forward = np.array([head["head_forward"] for head in heads], dtype=float).reshape(-1, 3)
        self.eyes_forward = np.array([head["eyes_forward"] for head in heads], dtype=float).reshape(-1, 3)
        self.plan = native.module.LookAtPlan(
            rigs.parents(rig, list(rows)), [[rows[name] for name in head["body"]] for head in heads],
            [rows[head["name"]] for head in heads], [[rows[name] for name in head["eyes"]] for head in heads])
        self.columns = {name: column for column, name in enumerate(native.module.LookAtPlan.SETTINGS)}
        self.members = len(self.plan.rows)
        report = native.module.LookAtPlan.REPORT
        self.told = [report.index(name) for name in OUTPUTS]


def solve(context):
    """Turns of the group's bones at the context's frame. Never raises for a user's error."""
    text, looped = context.data.get(PLAN), context.data.get(LOOPED)
    try:
        wired = rigs.plan(context.owner, text, lambda rig, rows: Wired(rig, rows, text))
    except (KeyError, ValueError):  # bones that are gone, or hang together otherwise
        return BONES_CHANGED
    if wired.names:
        problem = _solve(context, rigs.read(context.owner, wired.still), wired)
        if problem:
            return problem
    return TARGET_LOOPS if looped else None


def _solve(context, arrays, wired):
    if (wired.members, len(wired.names) * len(OUTPUTS)) != (len(context.rotations), len(context.outputs)):
        raise stored.Damaged("another number of members or outputs")
    entries = context.settings.entries
    places = [entries.find(name) for name in wired.names]
    if min(places) < 0:
        return BONES_CHANGED
    points, found = _targets(entries, places)
    settings = _settings(entries, places, wired.columns)
    settings[:, wired.columns["weight"]] *= context.settings.influence
    muted = settings[:, wired.columns["is_on"]] == 0.0
    settings[found != reasons.REACHED, wired.columns["is_on"]] = 0.0
    report = wired.plan.solve(
        arrays.rest, arrays.poses, arrays.basis, arrays.inheritance, arrays.world, settings, points, wired.head_forward,
        wired.eyes_forward, rotations=context.rotations)
    told = context.outputs.reshape(len(places), len(OUTPUTS))
    told[:] = report[:, wired.told]
    reason = told[:, OUTPUTS.index("reason")]
    is_off = found != reasons.REACHED
    reason[is_off] = found[is_off]
    reason[muted] = reasons.MUTED
    told[reason < 0.0, OUTPUTS.index("angle")] = 0.0
    return SOME_ARE_OFF if ((reason < 0.0) & (reason != reasons.MUTED)).any() else None


def _settings(entries, places, columns):
    """(heads, columns) numbers, as the plan wants them."""
    values = np.zeros((len(places), len(columns)))
    column = np.empty(len(entries), np.float32)
    for name in NUMBERS:
        entries.foreach_get(name, column)
        values[:, columns[name]] = column[places]
    muted = np.empty(len(entries), bool)
    entries.foreach_get("is_muted", muted)
    values[:, columns["is_on"]] = ~muted[places]
    return values


def _targets(entries, places):
    """World places of what is looked at, (heads, 3), and for each head why there is none."""
    points = np.zeros((len(places), 3))
    found = np.full(len(places), reasons.REACHED)
    for row, place in enumerate(places):
        entry = entries[place]
        target = entry.target
        if target is None:
            found[row] = reasons.NO_TARGET
        elif deleted.is_deleted(target):
            found[row] = reasons.TARGET_DELETED
        elif not entry.target_bone or target.pose is None:  # without bones a name is left from an earlier target
            points[row] = target.matrix_world.translation
        elif entry.target_bone in target.pose.bones:
            points[row] = target.matrix_world @ target.pose.bones[entry.target_bone].head
        else:
            found[row] = reasons.NO_TARGET_BONE
    return points, found
