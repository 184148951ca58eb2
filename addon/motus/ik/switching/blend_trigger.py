"""Drive the setting Blend from one target of a chain to the next by a trigger: a number that passes a value.

Target number 0 is the chain's target; numbers from 1 on are its further targets. motus.ik_switch_target calls these functions. The
driver's expression is a sum of the number of a target and a term for each switch. Its functions are those that Blender evaluates
without Python.
"""

import itertools
import re

from ...core import wiring
from ...core.declare import System, of_owner, registered
from ...core.file.pointers import pointed
from ...core.refusals import Refused
from ...core.settings import lists
from ...core.translations import tr
from .. import chains, setup
from . import blend_keys

LONGEST_EXPRESSION = 255
TERMS = {
    'BEZIER': "smoothstep({start},{end},{value})",
    'LINEAR': "clamp(({value}-{start})/({end}-{start}))",
    'CONSTANT': "({value}{sign}{start})",
}
_TERM = re.compile(r"smoothstep\([^()]*\)|clamp\(\([^()]*\)/\([^()]*\)\)|\([^()]*[<>]=[^()]*\)")
_SETTINGS = re.compile(r'(?:^|\.)motus[.[]|\["motus"\]')
_NAME = re.compile(r"\bv\d+\b")
_SUM = re.compile(rf"(\d+)((?:\+(?:{_TERM.pattern}))*)$")


def output_source(owner, system_name, output):
    """(type of datablock, datablock, data path), for a driver's variable, of a number that a system computes for an object.

    Raises Refused if the system does not drive the object, or has no such output.
    """
    system = registered.get(system_name)
    if not isinstance(system, System):
        raise Refused(tr("There is no system {system}").format(system=system_name))
    if not of_owner(system, owner).is_active:
        raise Refused(tr("{object} is not driven by {system}").format(object=owner.name, system=tr(system.label)))
    settings = of_owner(system, owner)
    hubs = {"": pointed(settings, "hub"), **{one.name: pointed(one, "object") for one in settings.more_hubs}}
    for level in ("", *map(str, range(1, _entry_count(owner)))):
        try:
            path = wiring.output_path(system, output, owner, level)
        except ValueError:
            continue
        hub = hubs.get(level)
        return ('MESH', hub.data, path) if hub else ('OBJECT', owner, path)
    raise Refused(tr("{system} of {object} has no output {output}").format(system=tr(system.label), object=owner.name, output=output))


def check_elsewhere(rig, owner, system_name):
    """Refuse an output of a system that solves the rig's own bones as a trigger.

    Solvers of a rig's bones run after all drivers of the rig, the driver of Blend included, so the trigger would form a cycle.
    """
    system = registered.get(system_name)
    if owner == rig and isinstance(system, System) and system.groups is not None:
        _refuse_own(rig)


def _check_no_own_setting(rig, owner, path):
    """Refuse a trigger that reads a setting of this rig.

    Blender's depsgraph treats all settings of an object as one node, so the driver of *Blend* would form a cycle.
    """
    if any(_holder(owner, path[: found.start()]) == rig for found in _SETTINGS.finditer(path)):
        _refuse_own(rig)


def _holder(owner, path):
    """Datablock or property group to which a data path leads; None if the path ends in the middle of a name."""
    try:
        return owner.path_resolve(path) if path else owner
    except ValueError:
        return None


def _refuse_own(rig):
    raise Refused(tr("{object} cannot wait for what is solved on its own bones: choose another trigger").format(object=rig.name))


def _entry_count(owner):
    """Number of entries on an owner, the largest number of levels that they can have; 0 if the owner is no armature object."""
    return len(wiring.levels(owner)) if owner.type == 'ARMATURE' else 0


def property_source(owner, path):
    """(type of datablock, object, data path), for a driver's variable, of a property. Raises Refused if the property is no number."""
    try:
        value = owner.path_resolve(path)
    except ValueError:
        value = None
    if not isinstance(value, (bool, int, float)):
        raise Refused(tr("{path} of {object} is no number").format(path=path, object=owner.name))
    return 'OBJECT', owner, path


def switch(rig, entry, goal, source, start, end, interpolation):
    """Extend the driver of Blend so that it passes from its last target to `goal` while a trigger goes from start to end.

    goal: (object, bone name). source: the trigger, from output_source() or property_source(); None for the scene's frame.
    Returns the number of the target that Blend leaves. Raises Refused if the trigger cannot drive Blend.
    """
    if source:
        _check_no_own_setting(rig, *source[1:])
    if blend_keys.curve_of(rig, entry):
        raise Refused(tr("Blend of {bone} is keyed: remove the keys, or give frames instead of a trigger").format(bone=entry.name))
    driver = driver_of(rig, entry)
    number, expression = _so_far(entry, driver)
    blend_keys.check_other(entry, number, goal)
    name = _free_name(driver.driver.variables if driver else ()) if source else "frame"
    longer = f"{expression}+" + TERMS[interpolation].format(
        start=f"{start:.9g}", end=f"{end:.9g}", value=name, sign=">=" if end > start else "<="
    )
    if len(longer) > LONGEST_EXPRESSION:
        raise Refused(tr("{bone} passes on too many times for one driver").format(bone=entry.name))
    loops, count = _loops(rig), len(entry.extra_targets)
    with setup.at_once(rig):
        blend_keys.place_next(entry, number, goal)
        curve = driver or _new_driver(rig, chains.prefixes(rig, rig.motus.ik.entries.find(entry.name))[0] + "target_blend")
        if source:
            _add_variable(curve.driver, name, source)
        curve.driver.expression = longer
    if _loops(rig) - loops:
        added = number if len(entry.extra_targets) > count else -1
        _take_back(rig, entry, added, expression if driver else "", name)
        raise Refused(tr("What triggers {bone} moves with the chain itself: choose another trigger").format(bone=entry.name))
    return number


def driver_of(rig, entry):
    """Driver (its F-curve) of an entry's setting Blend; None if Blend has no driver."""
    paths = {prefix + "target_blend" for prefix in chains.prefixes(rig, rig.motus.ik.entries.find(entry.name))}
    animation = rig.animation_data
    return next((curve for curve in (animation.drivers if animation else ()) if curve.data_path in paths), None)


def _so_far(entry, driver):
    """(number of the last target to which Blend passes, expression) of a driver that switch() made, or of a constant Blend if it is None.

    Raises Refused if switch() did not make the driver, or if the driver passes to targets that no longer exist.
    """
    if driver is None:
        number = min(round(entry.target_blend), len(entry.extra_targets))
        return number, str(number)
    found = _sum_of(driver.driver)
    if found is None:
        raise Refused(tr("Blend of {bone} has a driver of its own").format(bone=entry.name))
    number = found[0] + len(found[1])
    if number > len(entry.extra_targets):
        raise Refused(tr("Blend of {bone} is driven to targets that there are no more: remove its driver").format(bone=entry.name))
    return number, driver.driver.expression


def _sum_of(driver):
    """(number of the first target, list of the terms of later switches) of a driver that switch() made; None for a different driver."""
    found = _SUM.match(driver.expression) if driver.type == 'SCRIPTED' else None
    return found and (int(found[1]), _TERM.findall(found[2]))


def take_out(rig, entry, number):
    """Change a driver that switch() made for a further target that is about to be removed. number: of this target."""
    curve = driver_of(rig, entry)
    found = curve and _sum_of(curve.driver)
    if not found:
        return
    first, terms = found
    way = terms.pop(number - first - 1) if first < number <= first + len(terms) else ""
    if number <= first:
        first -= 1
    if not terms:
        _remove_driver(rig, curve)
        entry.target_blend = first
        return
    curve.driver.expression = "+".join([str(first), *terms])
    for variable in [one for one in curve.driver.variables if one.name in _NAME.findall(way)]:
        curve.driver.variables.remove(variable)


def _new_driver(rig, path):
    curve = rig.driver_add(path)
    # Without keys and modifiers, the driver's F-curve passes on the driver's value as it is.
    while curve.modifiers:
        curve.modifiers.remove(curve.modifiers[0])
    for key in reversed(curve.keyframe_points):
        curve.keyframe_points.remove(key)
    curve.driver.type = 'SCRIPTED'
    return curve


def _free_name(variables):
    names = {variable.name for variable in variables}
    return next(name for name in map("v{}".format, itertools.count()) if name not in names)


def _add_variable(driver, name, source):
    variable = driver.variables.new()
    variable.name = name
    target = variable.targets[0]
    if source[0] != 'OBJECT':
        target.id_type = source[0]
    target.id, target.data_path = source[1:]


def _loops(rig):
    return {address for address, level in wiring.levels(rig).items() if level is None}


def _take_back(rig, entry, added, expression, name):
    with setup.at_once(rig):
        if added >= 0:
            lists.remove(entry.extra_targets, added)
        curve = driver_of(rig, entry)
        if not expression:
            _remove_driver(rig, curve)
            return
        curve.driver.expression = expression
        if name in curve.driver.variables:
            curve.driver.variables.remove(curve.driver.variables[name])


def _remove_driver(rig, curve):
    animation = rig.animation_data
    animation.drivers.remove(curve)
    if not (animation.drivers or animation.action or animation.nla_tracks):
        rig.animation_data_clear()
