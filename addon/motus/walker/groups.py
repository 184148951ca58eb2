"""What is wired on a walker: its feet by one solver, the body that leans by another."""

import json
from typing import Any, NamedTuple

from ..core import keeping, rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.file import stored
from ..core.lazy import numpy as np
from . import legs

PLAN = "plan"
"""Key of a group's data: a JSON object, see _FORM and parsed(). The fingerprint of the rig is there so that the data changes with it."""
FEET, BODY = "feet", "body"
"""Names of the entries; the first one's group has no key."""
PLACE, LEANING, TURN = frozenset({"location"}), frozenset({"location", "rotation"}), frozenset({"rotation"})

_FORM = {"feet": [{"leg": int, "is_bone": bool}], "is_looped": bool, "lacks": int, "is_bodiless": bool, "fingerprint": int}
_noted = keeping.OfProcess("what a walker's groups note (Noted)", "the text", most=64)


def entries(owner):
    """For the order of evaluation: what feet and body read and drive."""
    feet = legs.feet(owner)
    if not feet:
        return []
    found = [Entry(FEET, ((owner, ""),), tuple(foot.driven for foot in feet))]
    body = legs.body(owner)
    if body is not None and not _is_foot(body, feet):
        found.append(Entry(BODY, ((owner, ""), *_above(owner, body)), (body if owner.pose is None else body.name,)))
    return found


def _above(owner, body):
    """The bone that a body bone hangs on, as what is read."""
    return [(owner, body.parent.name)] if owner.pose and body.parent else []


def _is_foot(body, feet):
    return any(foot.thing == body for foot in feet)


def groups(owner):
    """One group for the feet, one for the body. What would wait for itself is left out."""
    levels = wiring.levels(owner)
    feet, body = legs.feet(owner), legs.body(owner)
    looped = {name for name in (FEET, BODY) if levels.get(("walker", name), 0) is None}
    if body is not None and _is_foot(body, feet):
        looped.add(BODY)
    data = {
        PLAN: json.dumps(
            {
                "feet": [{"leg": foot.index, "is_bone": foot.is_bone} for foot in feet if FEET not in looped],
                "is_looped": bool(looped),
                "lacks": len(owner.motus.walker.legs) - len(feet),
                "is_bodiless": body is None and legs.names_body(owner),
                "fingerprint": rigs.fingerprint(owner) if owner.pose else 0,
            }
        )
    }
    found = [
        Group(
            members=tuple(Member(foot.thing, PLACE, 'POSE' if foot.is_bone else 'WORLD') for foot in feet if FEET not in looped),
            inputs=(Transform(owner),),
            data=data,
        )
    ]
    if body is not None and BODY not in looped:
        own = (BonesOwn(owner, body.name),) if owner.pose else ()
        found.append(
            Group(
                key=BODY,
                members=(Member(body, _channels(owner, body), 'LOCAL', is_relative=True),),
                inputs=(Transform(owner), *(Transform(*pair) for pair in _above(owner, body)), *own),
                data=data,
            )
        )
    return tuple(found)


def _channels(owner, body):
    return TURN if owner.pose and body.bone.use_connect and body.parent else LEANING


class Noted(NamedTuple):
    """What a group notes.

    legs: those of the members, rising. bones: rows of the members that are bones. lacks: how many legs have no foot.
    is_bodiless: whether the body that is named is not there.
    """

    legs: Any
    bones: Any
    is_looped: bool
    lacks: int
    is_bodiless: bool


def parsed(text):
    """The Noted of a group's data. Raises Damaged."""
    return _noted.made(text, lambda: _parsed(text))


def _parsed(text):
    said = stored.parse(text, _FORM)
    legs_of = [foot["leg"] for foot in said["feet"]]
    if legs_of != sorted(set(legs_of)):
        raise stored.Damaged("feet in another order")
    bones = [row for row, foot in enumerate(said["feet"]) if foot["is_bone"]]
    return Noted(np.array(legs_of, int), np.array(bones, int), said["is_looped"], said["lacks"], said["is_bodiless"])


def bone_renamed(owner, rig, old, new):
    """Let feet and body follow a bone that was given another name."""
    settings = owner.motus.walker
    for leg in settings.legs if rig == owner else ():
        if leg.name == old:
            leg.name = new
    if rig == owner and settings.body_bone == old:
        settings.body_bone = new
