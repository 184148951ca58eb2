"""Groups of a walker: one solver drives the feet, and a second solver drives the body, which rises and leans with the feet.

A Group lists what a solver reads and drives. The owner is the object that walks.
"""

import json
from typing import Any, NamedTuple

from ..core import keeping, rigs, wiring
from ..core.declare import BonesOwn, Entry, Group, Member, Transform
from ..core.file import stored
from ..core.lazy import numpy as np
from . import carrier, legs

PLAN = "plan"
"""Key of a group's data, under which a JSON text of the form _FORM stands; parsed() reads it.

The text has the fingerprint of the rig's bones, so that the data changes whenever the bones change.
"""
FEET, BODY = "feet", "body"
"""Names of the two parts of a walker that have a solver each. BODY is also the key of its group; the group of the feet has no key."""
PLACE, LEANING, TURN = frozenset({"location"}), frozenset({"location", "rotation"}), frozenset({"rotation"})

_FORM = {"feet": [{"leg": int, "is_bone": bool}], "is_looped": bool, "lacks": int, "is_bodiless": bool, "fingerprint": int}
_noted = keeping.OfProcess(
    "parsed descriptions of the feet and the body that a walker's solver computes (Noted)", "text of the description", most=64
)


def entries(owner):
    """List what the feet and the body of a walker read and drive, as Entry; the order of evaluation follows from it.

    owner: object that walks. Empty if no foot is there.
    """
    feet = legs.feet(owner)
    if not feet:
        return []
    read = ((owner, ""), *((one, "") for one in _carriers(owner)))
    found = [Entry(FEET, read, tuple(foot.driven for foot in feet))]
    body = legs.body(owner)
    if body is not None and not _is_foot(body, feet):
        found.append(Entry(BODY, (*read, *_above(owner, body)), (body if owner.pose is None else body.name,)))
    return found


def _carriers(owner):
    """The object that carries the walker's ground, in a list; [] if there is none."""
    found = carrier.of(owner.motus.walker)
    return [] if found is None else [found]


def _above(owner, body):
    """[(rig, name)] of the parent of a body bone, which the body's solver reads; [] for an object or a bone without a parent."""
    return [(owner, body.parent.name)] if owner.pose and body.parent else []


def _is_foot(body, feet):
    return any(foot.thing == body for foot in feet)


def groups(owner):
    """Return the Groups of a walker: one for the feet, and one for the body if there is a body.

    Feet or a body that would form a dependency cycle with what they read are left out; the data notes this as "is_looped".
    """
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
    channels = LEANING if owner.motus.walker.use_soles else PLACE
    found = [
        Group(
            members=tuple(Member(foot.thing, channels, 'POSE' if foot.is_bone else 'WORLD') for foot in feet if FEET not in looped),
            inputs=tuple(map(Transform, (owner, *_carriers(owner)))),
            data=data,
        )
    ]
    if body is not None and BODY not in looped:
        own = (BonesOwn(owner, body.name),) if owner.pose else ()
        found.append(
            Group(
                key=BODY,
                members=(Member(body, _channels(owner, body), 'LOCAL', is_relative=True),),
                inputs=(*map(Transform, (owner, *_carriers(owner))), *(Transform(*pair) for pair in _above(owner, body)), *own),
                data=data,
            )
        )
    return tuple(found)


def _channels(owner, body):
    return TURN if owner.pose and body.bone.use_connect and body.parent else LEANING


class Noted(NamedTuple):
    """Data that is stored with a walker's group: facts about its feet and body that hold until the drivers are made anew.

    legs: index of the leg of each member (driven foot), rising. bones: rows of the members that are bones. is_looped: whether feet or body
    are left out because of a dependency cycle. lacks: number of legs that have no foot. is_bodiless: whether the settings
    name a body that is not there.
    """

    legs: Any
    bones: Any
    is_looped: bool
    lacks: int
    is_bodiless: bool


def parsed(text):
    """Return the Noted that a group's JSON text says. Raises Damaged if the text does not have the form _FORM."""
    return _noted.made(text, lambda: _parsed(text))


def _parsed(text):
    said = stored.parse(text, _FORM)
    legs_of = [foot["leg"] for foot in said["feet"]]
    if legs_of != sorted(set(legs_of)):
        raise stored.Damaged("feet in another order")
    bones = [row for row, foot in enumerate(said["feet"]) if foot["is_bone"]]
    return Noted(np.array(legs_of, int), np.array(bones, int), said["is_looped"], said["lacks"], said["is_bodiless"])


def bone_renamed(owner, rig, old, new):
    """Write the new name of a renamed bone into the settings of a walker, for its feet and its body.

    owner: object that walks. rig: armature object of the bone. old, new: names of the bone.
    """
    settings = owner.motus.walker
    for leg in settings.legs if rig == owner else ():
        if legs.bone(leg) == old:
            leg.name = new
    if rig == owner and settings.body_bone == old:
        settings.body_bone = new
