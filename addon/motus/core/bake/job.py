"""Bake and unbake the systems of an owner (an object whose settings a system solves), as functions without an operator.

bake() is a generator of steps, so that an operator can show its progress and cancel it.
"""

import bpy

from .. import declare, wiring
from ..blender.frames import Kept, depsgraph_of, go_to
from ..file.pointers import pointed
from ..measures import scene_time
from ..measures.handedness import scale_is_mirrored
from ..refusals import Refused, check_evaluated, check_local, check_no_tweak_mode, check_posed
from ..translations import tr
from . import keys, state
from .sampling import NumberTrack, Track


def owner_and_systems(thing, name=""):
    """Find what to bake for an object: (owner, [System]). Raises Refused if no system drives the object, or none that can be baked.

    thing: an owner (object whose settings a system solves), or an object that an owner drives. name: of the one system to bake; "" for
    every system.
    """
    refusals = []
    for owner, systems in declare.wired_on(thing):
        chosen = [one for one in systems if name in ("", one.name)]
        refusals += [one.unbakeable for one in chosen if one.unbakeable]
        chosen = [one for one in chosen if not one.unbakeable]
        if chosen:
            return owner, chosen
    if refusals:
        raise Refused(tr(refusals[0]))
    raise Refused(tr("{object} is not driven by Motus: add a system to it first").format(object=thing.name))


def bake(scene, view_layer, owner, systems, frames):
    """Bake systems to keyframes: a generator that yields the number of frames recorded so far. Raises Refused before the first one.

    owner: object whose settings the systems solve. systems: [System]. frames: of the time line. The keyframes are written after the last
    frame has been recorded, so closing the generator before that changes nothing.
    """
    tracks = _tracks(owner, systems)
    _check(tracks, view_layer)
    kept, layer = Kept(scene), view_layer.name
    try:
        for index, frame in enumerate(frames):
            go_to(scene, frame)
            depsgraph = depsgraph_of(scene, layer)
            for track in tracks:
                track.record(depsgraph)
            yield index + 1
    finally:
        kept.restore()
    _apply(owner, systems, tracks, [scene_time.keys_time(scene, frame) for frame in frames])
    kept.restore()


def unbake(thing, name=""):
    """Remove the keyframes of everything that was baked together with an object, and make the baked systems live again.

    Returns (the datablocks that were baked, those of them that could not be restored completely). thing: the owner of the baked systems, or
    an object that the owner drives. name: of a system that must be among the baked ones; "" for any. Raises Refused if nothing is baked, or
    if a datablock is linked or in the tweak mode of the NLA.
    """
    owner = _baked_owner(thing)
    systems, baked = check_baked(thing, name)
    for one in baked:
        check_local(one)
        check_no_tweak_mode(one)
    partial = [one for one in baked if not keys.restore(one)]
    owner.motus.property_unset("bake")
    for one in systems:
        declare.of_owner(one, owner).is_baked = False
        wiring.set_muted(one, owner, False)
    return baked, partial


def check_baked(thing, name=""):
    """Find what was baked together with an object: ([System], [datablock]). Raises Refused if nothing was baked.

    thing: the owner of the baked systems, or an object that the owner drives. name: of a system that must be among the baked ones; "" for
    any.
    """
    owner = _baked_owner(thing)
    systems = [one for one in declare.systems() if state.is_baked_owner(one, owner)]
    baked = state.baked_with(owner)
    if not baked or (name and name not in [one.name for one in systems]):
        raise Refused(tr("{object} is not baked").format(object=thing.name))
    return systems, baked


def _baked_owner(thing):
    """The owner whose systems were baked together with an object; the object itself if there is no such owner.

    The owner of an object that is not baked itself is its leader, the object whose settings drive it, if the leader's systems are baked.
    """
    if thing.motus.bake.is_baked:
        return pointed(thing.motus.bake, "owner") or thing
    leaders = [declare.leader_of(one, thing) for one in declare.systems()]
    return next((leader for leader in leaders if leader and any(state.is_baked_owner(one, leader) for one in declare.systems())), thing)


def objects_of(owner, systems):
    """Set of the objects whose motion or properties the systems of an owner drive.

    The driven values are transforms of the object or of its bones, or properties of the object or of a datablock that the object uses.
    """
    driven = {member.thing.id_data for one in systems for member in _members(one, owner)}
    return driven | {obj for one in systems for obj, _ in wiring.driven_properties(one, owner)}


def inexact(owner, systems):
    """Names of the bones whose baked scale can be wrong, since keyframes cannot undo the stretch that they inherit from a chain.

    owner: object whose settings the systems solve.
    """
    return [
        member.thing.name for one in systems for member in _members(one, owner) if member.space == 'POSE' and "scale" in member.channels
    ]


def _members(one, owner):
    return [member for group in declare.groups_of(one, owner) for member in group.members]


def _sinks(owner, systems):
    return [constraint for one in systems for _, constraint in wiring.sinks(one, owner)]


def _tracks(owner, systems):
    sinks = _sinks(owner, systems)
    channels = {}
    for one in systems:
        for member in _members(one, owner):
            channels.setdefault(member.thing, set()).update(member.channels)
    for thing, names in channels.items():
        if "location" in names and isinstance(thing, bpy.types.PoseBone) and thing.bone.use_connect:
            raise Refused(tr("{bone} is connected to its parent, so keyframes cannot move it: disconnect it first").format(bone=thing.name))
        # The user's constraints act before or after the system's result: all channels are baked, and these constraints are muted.
        # The constraints that apply a system's result lose a negative scale, so all channels of a mirrored thing are baked too.
        if keys.others(thing, sinks) or scale_is_mirrored(thing.scale):
            names.update(("location", "rotation", "scale"))
    return [Track(thing, frozenset(names)) for thing, names in channels.items()] + [
        NumberTrack(*one) for owned in systems for one in wiring.driven_properties(owned, owner)
    ]


def _check(tracks, view_layer):
    if not tracks:
        raise Refused(tr("The system drives nothing that could be baked"))
    for one in {track.id_data for track in tracks}:
        check_local(one)
        if state.of(one).is_baked:
            raise Refused(tr("{object} is baked already: unbake it first").format(object=one.name))
        check_no_tweak_mode(one)
    for one in {track.thing.id_data for track in tracks}:
        check_evaluated(one, view_layer)
    for rig in {track.id_data for track in tracks if isinstance(track.thing, bpy.types.PoseBone)}:
        check_posed(rig, view_layer)


def _apply(owner, systems, tracks, times):
    sinks = _sinks(owner, systems)
    for one in systems:
        wiring.set_muted(one, owner, True)
    for one in {track.id_data for track in tracks}:
        own = [track for track in tracks if track.id_data == one]
        keys.remember(one, owner, own, keys.mute(one, own, sinks))
        keys.write(one, own, times)
        one.update_tag()
    owner.motus.bake.frame_start, owner.motus.bake.frame_end = times[0], times[-1]
    for one in systems:
        declare.of_owner(one, owner).is_baked = True
