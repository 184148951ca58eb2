"""Find what of Motus is in the file, by what the systems declare, and refuse what cannot be handed over."""

import re

import bpy

from ..core import wiring
from ..core.bake import keys
from ..core.blender import datablocks, helpers
from ..core.declare import groups_of, has_settings, is_owner, registered, systems, title
from ..core.declare.forgetting import says_anything
from ..core.file.deleted import is_deleted
from ..core.measures.handedness import scale_is_mirrored
from ..core.refusals import Refused, check_local, check_no_tweak_mode
from ..core.translations import tr

OURS = re.compile(r"\bmotus(?:_\w+)?\b")
"""Matches what drivers, data paths and names of properties have of Motus."""
KEYS, POINTS, FACES, PLAIN = 'KEYS', 'POINTS', 'FACES', 'PLAIN'
_WAYS = {KEYS, POINTS, FACES, PLAIN}


def owners(scene_objects=None):
    """[(System, owner)] of all systems that are set up in the file, of deleted objects none."""
    found = bpy.data.objects if scene_objects is None else scene_objects
    return [(system, owner) for system in systems() for owner in found if is_owner(system, owner) and not is_deleted(owner)]


def driven_channels(wired):
    """{Object or PoseBone: set of its channels} of everything that owners move. wired: [(System, owner)]."""
    channels = {}
    for system, owner in wired:
        for group in groups_of(system, owner):
            for member in group.members:
                if member.thing is not None:
                    channels.setdefault(member.thing, set()).update(member.channels)
    return channels


def sinks(wired):
    """The constraints by which owners drive objects and bones."""
    return [constraint for system, owner in wired for _, constraint in wiring.sinks(system, owner)]


def drivers(constraints):
    """[(datablock, F-curve)] of the drivers that read Motus, users' own included, and whose properties stay without Motus.

    constraints: those by which owners drive objects and bones; drivers on them go with them.
    """
    going = {(one.id_data, one.path_from_id()) for one in constraints}
    return [(id_data, curve) for id_data in datablocks.everything() for curve in _drivers_of(id_data) if _stays(id_data, curve, going)]


def _drivers_of(id_data):
    animation = getattr(id_data, "animation_data", None)
    return animation.drivers if animation and not id_data.library else ()


def _stays(id_data, curve, going):
    if not reads_motus(curve) or OURS.search(curve.data_path):
        return False
    return (id_data, curve.data_path.rpartition(".")[0]) not in going


def reads_motus(curve):
    """Whether a driver calls a function of Motus, or reads something that Motus has made. curve: its F-curve."""
    if OURS.search(curve.driver.expression):
        return True
    return any(OURS.search(target.data_path) for variable in curve.driver.variables for target in variable.targets)


def check(view_layer):
    """Raise Refused if something of Motus cannot be handed over, with the sentence that says what and why."""
    wired = owners()
    used = {system.name for system, _ in wired} | _used_features()
    for feature in registered.values():
        if feature.name in used and feature.hand_over not in _WAYS:
            raise Refused(
                tr("{system} cannot be handed over: remove it first").format(system=bpy.app.translations.pgettext_iface(*title(feature)))
            )
    channels = driven_channels(wired)
    for obj in dict.fromkeys([*(owner for _, owner in wired), *(thing.id_data for thing in channels)]):
        _check_object(obj, view_layer)
    constraints = sinks(wired)
    for thing, names in channels.items():
        _check_connected(thing, names, constraints)
    for id_data, _ in drivers(constraints):
        check_local(id_data)
        if id_data.override_library:
            _refuse_override(id_data)
    if not wired and not drivers(()):
        raise Refused(tr("Nothing in the file is driven by Motus: save it as it is"))


def _used_features():
    """Names of the features without solver whose settings an object of the file has."""
    found = set()
    for feature in registered.values():
        if feature.settings is None or feature in systems():
            continue
        if any(has_settings(feature, obj) and says_anything(getattr(obj.motus, feature.name)) for obj in bpy.data.objects):
            found.add(feature.name)
    return found


def _check_object(obj, view_layer):
    check_local(obj)
    if obj.override_library:
        _refuse_override(obj)
    if obj.name not in view_layer.objects and not helpers.is_helper(obj):
        raise Refused(
            tr("{object} is not in the view layer {layer}, so its motion cannot be read: put it into a collection that is").format(
                object=obj.name, layer=view_layer.name
            )
        )
    check_no_tweak_mode(obj)
    if obj.type == 'ARMATURE' and obj.data.pose_position == 'REST':
        raise Refused(tr("{object} is in Rest Position: switch to Pose Position first").format(object=obj.name))


def _refuse_override(id_data):
    raise Refused(
        tr("{object} is a library override, which keeps what its library drives: make it local first").format(object=id_data.name)
    )


def _check_connected(thing, names, constraints):
    moves = "location" in names or keys.others(thing, constraints) or scale_is_mirrored(thing.scale)
    if moves and isinstance(thing, bpy.types.PoseBone) and "location" in names and thing.bone.use_connect:
        raise Refused(tr("{bone} is connected to its parent, so keyframes cannot move it: disconnect it first").format(bone=thing.name))
