"""F-curves and drivers of pins.

Their data paths contain the pin's index, so that the paths are rewritten when the order of the list of pins changes.
"""

import re

import bpy

from ...core import wiring
from ...core.blender import actions

_PATH = re.compile(r"^motus\.pull\.pins\[(?P<index>\d+)\](?P<rest>.*)$")


def reorder(owner, places, absent):
    """Rewrite the data paths of F-curves and drivers, and of driver variables that read pins, after a change of the list of pins.

    places: {old index: new index} of the pins that remain. F-curves and drivers of removed pins are deleted. absent: data path for
    variables that read a removed pin.
    """
    for player in actions.players(owner):
        if any(places.get(place) != place for place in _pins_of(actions.curves_of(player))):
            actions.make_own(player)  # a copied object shares the action, but has its own pins
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
    """Set of the indices of the pins that these F-curves animate."""
    return {int(match["index"]) for match in (_PATH.match(curve.data_path) for curve in curves) if match}


def has_strips(owner, index):
    """Whether an NLA strip animates the pin of this index."""
    return any(index in _pins_of(actions.curves_of(player)) for player in actions.players(owner)[1:])


def drop_empty(owner):
    """Remove the object's action if it has no F-curves, and the object's animation data if they are empty."""
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
    """F-curve of the setting `name` of a pin; None if there is none."""
    return actions.find(owner, f"motus.pull.pins[{index}].{name}")


def driver(owner, index, name):
    """Driver F-curve of the setting `name` of a pin; None if there is none."""
    animation = owner.animation_data
    return animation.drivers.find(f"motus.pull.pins[{index}].{name}") if animation else None


def is_animated(owner, path):
    """Whether an F-curve or a driver animates the property at this data path of a datablock."""
    animation = owner.animation_data
    return actions.find(owner, path) is not None or bool(animation and animation.drivers.find(path))
