"""Copies of a system's settings, with their keys, as a text that is checked whole before anything is set.

An item is the property group whose settings are copied: an entry of a list, if the system has a list `entries`, or else the settings of
an owner. System.copied_settings names the item's settings that can be copied, and System.shot_settings those of them that are copied on
request alone, since they belong to one shot, such as places and frames.
"""

import json
from typing import Any, NamedTuple

import bpy

from .. import wiring
from ..blender import actions
from ..declare import of_owner, registered
from ..file import stored
from ..refusals import Refused, check_local, check_no_tweak_mode, check_unbaked
from ..translations import tr
from . import entries, entry_keys

FORMAT = 1
"""Number of the text's format. A text with a larger number is of a newer version of Motus."""

GROUP = "Motus"
"""Name of the group that copied F-curves have in the animation editors."""

_CHOICES = "interpolation", "easing", "type", "handle_left_type", "handle_right_type"
_NUMBERS = "back", "amplitude", "period"
_PLACES = "co", "handle_left", "handle_right"
_MODIFIERS = {
    'CYCLES': "FModifierCycles",
    'FNGENERATOR': "FModifierFunctionGenerator",
    'LIMITS': "FModifierLimits",
    'NOISE': "FModifierNoise",
    'STEPPED': "FModifierStepped",
}
"""{type of an F-curve modifier: name of its class}: those that are described by plain numbers, switches and choices alone."""


def _is_single(value):
    """Whether a value from a text is a number that single precision has, which Blender stores."""
    return stored.fits(value, float) and abs(value) <= stored.LARGEST_NUMBER


_POINT = dict.fromkeys(_CHOICES, str) | dict.fromkeys(_NUMBERS, _is_single) | dict.fromkeys(_PLACES, (_is_single, _is_single))
_CURVE = {"index": int, "extrapolation": str, "points": [_POINT], "modifiers": [lambda value: isinstance(value, dict)]}
_TEXT = {"motus": int, "system": str, "values": lambda value: isinstance(value, dict), "keys": lambda value: isinstance(value, dict)}


class Copied(NamedTuple):
    """Settings that were copied. system: its name. values: {name: value}. keys: {name: list of F-curves as JSON has them}."""

    system: str
    values: dict[str, Any]
    keys: dict[str, Any]


def has_list(system):
    """Whether the settings that are copied are those of an entry in the system's list, not those of the owner."""
    return "entries" in system.settings.bl_rna.properties


def names_of(system, with_shot):
    """Names of the settings that are copied. with_shot: whether those are among them that belong to one shot, such as places and times."""
    return [name for name in system.copied_settings if with_shot or name not in system.shot_settings]


def take(system, item, with_keys=True):
    """Copy all settings of an item. Raises Refused if an F-curve of a setting cannot be written as text."""
    names = names_of(system, with_shot=True)
    keys: dict[str, Any] = {}
    for curve, name in _curves(system, item, names) if with_keys else ():
        keys.setdefault(name, []).append(_curve_as_json(curve, item, name))
    return Copied(system.name, {name: _plain(getattr(item, name)) for name in names}, keys)


def as_text(copied):
    """The JSON text of copied settings. Raises Refused if the text would be longer than what is read."""
    text = json.dumps({"motus": FORMAT} | copied._asdict())
    if len(text) > stored.LARGEST_TEXT:
        raise Refused(tr("There are too many keys to copy: thin them out first"))
    return text


def from_text(text, without_settings):
    """The settings in a text, of which the values and F-curves are not checked yet. Raises Refused if the text has no settings.

    without_settings: sentence with which a text without settings is refused.
    """
    try:
        read = stored.parse(text, _TEXT)
    except stored.Damaged:
        raise Refused(without_settings) from None
    if read["motus"] > FORMAT:
        raise Refused(tr("These settings were copied by a newer version of Motus"))
    return Copied(read["system"], read["values"], read["keys"])


def check(system, copied):
    """Raise Refused if copied settings are of a different system, or if a value or F-curve among them does not fit its setting.

    Numbers beyond the limits of a setting fit it, since Blender limits them. Names that the system does not copy are not looked at.
    """
    if copied.system != system.name:
        other = registered.get(copied.system)
        raise Refused(tr("These are settings of {system}").format(system=tr(other.label) if other else copied.system[:40]))
    properties = _item_type(system).bl_rna.properties
    for name in names_of(system, with_shot=True):
        prop = properties[name]
        fits = name not in copied.values or _fits(prop, copied.values[name])
        if not (fits and _are_curves(prop, copied.keys.get(name, []))):
            raise Refused(tr("What was copied for {setting} does not fit it").format(setting=tr(prop.name)))


def check_receivers(system, items, with_keys):
    """Raise Refused if an owner of the items is linked or baked, or cannot be given keys."""
    for owner in dict.fromkeys(item.id_data for item in items):
        check_local(owner)
        check_unbaked(owner, of_owner(system, owner))
        if with_keys:
            check_no_tweak_mode(owner)


def give(system, items, copied, names, with_keys):
    """Set settings of items to what was copied, and wire each owner once. copied: checked. names: of the settings.

    with_keys: whether the F-curves of these settings are replaced by the copied ones; otherwise F-curves stay as they are.
    """
    for owner in dict.fromkeys(item.id_data for item in items):
        own = [item for item in items if item.id_data == owner]
        if has_list(system):
            with entries.at_once(system, owner):
                for item in own:
                    _give(system, item, copied, names, with_keys)
        else:
            _give(system, own[0], copied, names, with_keys)
            wiring.refresh(system, owner)
        wiring.touch(system, owner)


def _give(system, item, copied, names, with_keys):
    for name in names:
        if name in copied.values and _plain(getattr(item, name)) != copied.values[name]:
            value = copied.values[name]
            setattr(item, name, set(value) if getattr(item.bl_rna.properties[name], "is_enum_flag", False) else value)
    if with_keys:
        animation = item.id_data.animation_data
        if animation and animation.action:
            actions.make_own(animation)
        for curve, _ in _curves(system, item, names):
            actions.fcurves(item.id_data).remove(curve)
        for name in names:
            for curve in copied.keys.get(name, ()):
                _make_curve(item, name, curve)


def _item_type(system):
    properties = system.settings.bl_rna.properties
    return properties["entries"].fixed_type if has_list(system) else system.settings


def _plain(value):
    if isinstance(value, set):
        return sorted(value)
    return value if isinstance(value, (str, bool, int, float)) else list(value)


def _fits(prop, value):
    """Whether a value from a text can be set to a property without an error."""
    if prop.type == 'ENUM':
        chosen = value if prop.is_enum_flag and isinstance(value, list) else [value]
        return all(isinstance(one, str) and one in prop.enum_items for one in chosen)
    form = {'BOOLEAN': bool, 'INT': _is_whole, 'FLOAT': _is_single, 'STRING': str}[prop.type]
    return stored.fits(value, (form,) * _length(prop) if getattr(prop, "is_array", False) else form)


def _is_whole(value):
    return type(value) is int and abs(value) < 1 << 31


def _paths(system, item):
    """Beginnings of the data paths that an item's settings have in F-curves."""
    if not has_list(system):
        return (f"motus.{system.name}.",)
    listed = of_owner(system, item.id_data).entries
    index = next(index for index, entry in enumerate(listed) if entry == item)
    by_index, by_name = entry_keys.prefixes(f"motus.{system.name}.entries", listed, index)
    return (by_index, by_name) if listed.find(item.name) == index else (by_index,)


def _curves(system, item, names):
    """List of (F-curve, name of its setting) in the item owner's own action. names: of settings."""
    places = {path + name: name for path in _paths(system, item) for name in names}
    return [(curve, places[curve.data_path]) for curve in actions.fcurves(item.id_data) if curve.data_path in places]


def _curve_as_json(curve, item, name):
    if not curve.keyframe_points or any(modifier.type not in _MODIFIERS for modifier in curve.modifiers):
        setting = tr(item.bl_rna.properties[name].name)
        raise Refused(tr("The F-curve of {setting} has no keys, or a modifier that cannot be copied").format(setting=setting))
    points = [{name: _plain(getattr(point, name)) for name in _POINT} for point in curve.keyframe_points]
    modifiers = [
        {"type": modifier.type} | {prop.identifier: getattr(modifier, prop.identifier) for prop in _settable(modifier.type)}
        for modifier in curve.modifiers
    ]
    return {"index": curve.array_index, "extrapolation": curve.extrapolation, "points": points, "modifiers": modifiers}


def _settable(kind):
    """RNA properties of a type of F-curve modifier from which its motion follows. kind: the type, one of _MODIFIERS."""
    properties = getattr(bpy.types, _MODIFIERS[kind]).bl_rna.properties
    return [
        prop for prop in properties if not prop.is_readonly and prop.type != 'STRING' and prop.identifier not in {"active", "show_expanded"}
    ]


def _are_curves(prop, curves):
    """Whether what a text has as the F-curves of a setting can be made. prop: RNA property of the setting."""
    if not stored.fits(curves, [_CURVE]) or (curves and not prop.is_animatable):
        return False
    indices = {curve["index"] for curve in curves}
    return len(indices) == len(curves) and max(indices, default=0) < _length(prop) and all(map(_is_curve, curves))


def _is_curve(curve):
    choices = bpy.types.Keyframe.bl_rna.properties
    return (
        curve["extrapolation"] in bpy.types.FCurve.bl_rna.properties["extrapolation"].enum_items
        and bool(curve["points"])
        and all(point[name] in choices[name].enum_items for point in curve["points"] for name in _CHOICES)
        and all(map(_is_modifier, curve["modifiers"]))
    )


def _is_modifier(modifier):
    kind = modifier.get("type")
    return (
        isinstance(kind, str)
        and kind in _MODIFIERS
        and all(_fits(prop, modifier[prop.identifier]) for prop in _settable(kind) if prop.identifier in modifier)
    )


def _make_curve(item, name, made):
    """Make an F-curve of a setting. made: a curve as JSON has it, which was checked."""
    index = made["index"] if _length(item.bl_rna.properties[name]) > 1 else -1
    item.keyframe_insert(name, index=index, group=GROUP)  # makes the action, its slot and the F-curve where there are none
    curve = actions.find(item.id_data, f"{item.path_from_id()}.{name}", made["index"])
    curve.extrapolation = made["extrapolation"]
    for modifier in made["modifiers"]:  # before the points: Blender evaluates a new modifier once something else of the action is edited
        new = curve.modifiers.new(modifier["type"])
        for prop in _settable(modifier["type"]):
            if prop.identifier in modifier:
                setattr(new, prop.identifier, modifier[prop.identifier])
    curve.keyframe_points.add(len(made["points"]) - len(curve.keyframe_points))
    for point, values in zip(curve.keyframe_points, made["points"]):
        for name in _POINT:
            setattr(point, name, values[name])
    curve.update()


def _length(prop):
    """Number of components of a property: 1 if it is no array."""
    return prop.array_length if getattr(prop, "is_array", False) else 1
