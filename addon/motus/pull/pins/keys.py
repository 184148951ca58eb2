"""Keys and drivers of pins. Their data paths hold the pin's index, so that they are rewritten when the list changes."""

import re

import bpy

from ...core import wiring
from ...core.blender import actions

_PATH = re.compile(r"^motus\.pull\.pins\[(?P<index>\d+)\](?P<rest>.*)$")


def reorder(owner, places, absent):
    """Rewrite data paths of keys, drivers, and variables of other drivers after a change of the list of pins.

    places: {old index: new index} of the pins that remain. absent: data path for variables that read a removed pin.
    """
    for player in actions.players(owner):
        if any(places.get(place) != place for place in _pins_of(actions.curves_of(player))):
            actions.make_own(player)  # the copy of an object shares its action, but has its own pins
            _reorder(actions.curves_of(player), places)
    if owner.animation_data:
        _reorder(owner.animation_data.drivers, places)
    for _, _, variable, index in wiring.targets_on({owner}):
        target = variable.targets[index]
        match = _PATH.match(target.data_path)
        if match:
            target.data_path = _moved(match, places) or absent


def _reorder(curves, places):
    found = [(curve, _PATH.match(curve.data_path)) for curve in curves]
    for curve, match in [pair for pair in found if pair[1]]:
        path = _moved(match, places)
        if path is None:
            curves.remove(curve)
        else:
            curve.data_path = path


def _moved(match, places):
    place = places.get(int(match["index"]))
    return None if place is None else f"motus.pull.pins[{place}]{match['rest']}"


def _pins_of(curves):
    """Indices of the pins that F-curves animate."""
    return {int(match["index"]) for match in (_PATH.match(curve.data_path) for curve in curves) if match}


def has_strips(owner, index):
    """Whether an NLA strip animates a pin."""
    return any(index in _pins_of(actions.curves_of(player)) for player in actions.players(owner)[1:])


def drop_empty(owner):
    """Remove the object's action if it has no F-curves left, and its animation data if they are empty."""
    animation = owner.animation_data
    if animation is None or animation.nla_tracks:
        return
    action = animation.action
    if action and not actions.fcurves(owner):
        animation.action = None
        if action.users == 0:
            bpy.data.actions.remove(action)
    if animation.action is None and not animation.drivers:
        owner.animation_data_clear()


def curve(owner, index, name):
    """F-curve of one setting of a pin, or None."""
    return actions.find(owner, f"motus.pull.pins[{index}].{name}")


def driver(owner, index, name):
    """Driver of one setting of a pin, or None."""
    animation = owner.animation_data
    return animation.drivers.find(f"motus.pull.pins[{index}].{name}") if animation else None


def is_animated(owner, path):
    """Whether keys or a driver animate a property of a datablock."""
    animation = owner.animation_data
    return actions.find(owner, path) is not None or bool(animation and animation.drivers.find(path))
