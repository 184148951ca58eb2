"""A layer that is edited: its action stands in a strip of the NLA in tweak mode, so that editors show its curves and keys go into it.

While a layer is edited, the own channels of the bones that its action animates are what the layer says. What lies beneath these bones is
read from the rig's own action, which a strip on a track below plays meanwhile.
"""

from contextlib import suppress

import bpy

from ..core.blender import actions, capabilities
from ..core.file import stored
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused, check_no_tweak_mode
from ..core.settings import entries
from ..core.translations import tr
from . import clips, live, mask, nla, solve, targets
from .setup import system

MOST_REPEATS = 1000.0
"""Greatest number of repetitions of an NLA strip."""


def check(rig, index):
    """Refuse to edit a layer of a rig by its keys: sentences for what stands in the way."""
    entry = rig.motus.layers.entries[index]
    check_no_tweak_mode(rig)
    action = targets.check_action(entry)
    if rig.override_library:
        raise Refused(
            tr("{object} is a library override: key poses into its layers, but edit them in its own file").format(object=rig.name)
        )
    if entry.speed == 0.0:
        raise Refused(tr("{layer} stands still: give it a speed first").format(layer=entry.name))
    animation = rig.animation_data
    if animation and not animation.use_nla:
        raise Refused(tr("The NLA of {object} is switched off: switch it on first").format(object=rig.name))
    if (
        animation
        and entry.mode == 'ADDITIVE'
        and any(_moves(strip, rig, entry) for track in animation.nla_tracks for strip in track.strips)
    ):
        raise Refused(
            tr("Strips of the NLA move bones beneath the additive layer {layer}: key poses into it instead").format(layer=entry.name)
        )
    if animation and any(track.is_solo for track in animation.nla_tracks):
        raise Refused(tr("A track in the NLA of {object} is played alone: end that first").format(object=rig.name))
    for name, channels in clips.curves_of_bones(action, entry.slot, rig.pose.bones.keys()).items():
        if clips.mode_of(rig.pose.bones[name].rotation_mode, channels) != rig.pose.bones[name].rotation_mode:
            raise Refused(
                tr("{action} turns {bone} in a different rotation mode than the rig: give the bone that mode first").format(
                    action=action.name, bone=name
                )
            )


def _moves(strip, rig, entry):
    """Whether an NLA strip may move bones in the mask of a layer."""
    return strip.type != 'CLIP' or actions.animates(actions.curves_of(strip), mask.names(rig, entry))


def enter(scene, rig, index):
    """Begin to edit a layer of a rig by its keys. Raises Refused, and changes nothing, if what lies beneath could not be found."""
    entry = rig.motus.layers.entries[index]
    animation = rig.animation_data or rig.animation_data_create()
    live.keep_channels(rig)
    if animation.action:
        nla.play_own(scene, animation, live.BENEATH)
    reason = live.Beneath(rig, rig.pose.bones.keys()).reason
    if reason:
        _remove_tracks(animation)
        rig.motus.layers.kept_channels = ""
        raise Refused(tr("What lies beneath the layer is not known: {reason}").format(reason=reason.sentence))
    if entry.mode == 'ADDITIVE':
        _free_the_masked(scene, rig, entry)
    _tweak(scene, rig, entry)
    with entries.at_once(system(), rig) as settings:
        settings.entries[index].is_edited = True
        settings.active_entry = index
    rig.update_tag()


def _free_the_masked(scene, rig, entry):
    """Let nothing but the layer's action set the own channels of the bones in an additive layer's mask, and set these to what adds nothing."""
    animation, masked = rig.animation_data, mask.names(rig, entry)
    if animation.action:
        strip = nla.play_own(scene, animation, live.BESIDE)
        animation.nla_tracks[live.BENEATH].mute = True
        slot = strip.action_slot.identifier if capabilities.has_slotted_actions() and strip.action_slot else ""
        strip.action = strip.action.copy()
        if slot:
            strip.action_slot = strip.action.slots[slot]
        curves = actions.curves_of(strip)
        for curve in [one for one in curves if actions.bone_of(one) in masked]:
            curves.remove(curve)
    for bone, neutral in _neutral(rig, entry):
        for name, numbers in neutral.items():
            setattr(bone, name, numbers)


def _neutral(rig, entry):
    """Return (bone, {channel: numbers with which an additive layer adds nothing}) for each bone in the layer's mask."""
    names, masked = tuple(rig.pose.bones.keys()), mask.names(rig, entry)
    other = pointed(entry, "reference_action")
    compared = clips.Clip(other, "", names, [bone.rotation_mode for bone in rig.pose.bones]) if other else None
    bones = [rig.pose.bones[name] for name in masked]
    return list(zip(bones, live.neutral_numbers(entry, compared, bones, [names.index(name) for name in masked])))


def leave(rig):
    """End the editing of a layer: the rig has the action and the values again that it had, and its NLA no track of ours.

    If the user has left the tweak mode before, in the NLA editor or by clearing the animation, poses that were made since are kept.
    """
    animation, was_left = rig.animation_data, live.was_left(rig)
    if animation is not None:
        if animation.use_tweak_mode:
            animation.use_tweak_mode = False
        _remove_tracks(animation)
        if animation.action is None and not animation.nla_tracks and not animation.drivers:
            rig.animation_data_clear()
    with entries.at_once(system(), rig) as settings:
        kept = {}
        with suppress(stored.Damaged):  # a file may hold anything
            kept = live.kept_channels(settings)
        settings.kept_channels = ""
        for entry in settings.entries:
            if entry.is_edited:
                if was_left:
                    kept = _not_posed(rig, entry, kept)
                entry.is_edited = False
                _let_go(entry)
    for name, channels in kept.items():
        bone = rig.pose.bones.get(name)
        for one, numbers in channels.items() if bone else ():
            setattr(bone, one, numbers)
    rig.update_tag()


def _not_posed(rig, entry, kept):
    """Return the part of `kept`, {bone: {channel: numbers}}, whose channels have present values that editing the layer gave them.

    These are the channels that the layer's action animates, and what the bones of an additive layer got to begin with.
    """
    action = pointed(entry, "action")
    ours = clips.curves_of_bones(action, entry.slot, rig.pose.bones.keys()) if action else {}
    begun = {bone.name: numbers for bone, numbers in _neutral(rig, entry)} if entry.mode == 'ADDITIVE' else {}

    def is_ours(bone, channel):
        return channel in ours.get(bone, ()) or list(getattr(rig.pose.bones[bone], channel)) == list(begun.get(bone, {}).get(channel, ()))

    return {
        bone: {channel: numbers for channel, numbers in channels.items() if is_ours(bone, channel)}
        for bone, channels in kept.items()
        if bone in rig.pose.bones
    }


def _tweak(scene, rig, entry):
    """Add a track with the action of a layer, at the layer's time, and let Blender show and key it."""
    animation, action = rig.animation_data, pointed(entry, "action")
    if not entry.use_range:
        entry.first_frame, entry.last_frame = action.frame_range
        entry.use_range, entry.is_open = True, True
    bag = actions.bag_for_object(action, entry.slot, rig.data.bones.keys(), rig.name)
    strip = nla.new_strip(animation, live.TWEAKED, action, getattr(bag, "slot", None), round(entry.start))
    first, last = solve.span(entry, tuple(action.frame_range))
    length = max(last - first, 1.0) / abs(entry.speed)
    nla.fit(strip, (first, max(last, first + 1.0)), (entry.start, entry.start + length))
    strip.use_reverse = entry.speed < 0.0
    if entry.after == 'REPEAT':
        strip.repeat = min(MOST_REPEATS, max(1.0, np.ceil((scene_time.last(scene) - entry.start) / length)))
    strip.extrapolation = 'NOTHING' if entry.after == 'STOP' else 'HOLD_FORWARD'
    animation.nla_tracks.active = animation.nla_tracks[live.TWEAKED]
    strip.select = True
    animation.use_tweak_mode = True


def _remove_tracks(animation):
    for name in (live.BENEATH, live.BESIDE, live.TWEAKED):
        track = animation.nla_tracks.get(name)
        if track is None:
            continue
        copies = [strip.action for strip in track.strips] if name == live.BESIDE else []
        animation.nla_tracks.remove(track)
        for action in copies:
            if action and action.users == 0:
                bpy.data.actions.remove(action)


def _let_go(entry):
    """Let the layer play all of its action again, if it did before; keys that were added stay at the frames at which they were seen."""
    action = pointed(entry, "action")
    if not entry.is_open:
        return
    entry.use_range = entry.is_open = False
    if action and entry.speed:
        first, last = action.frame_range
        entry.start += (first - entry.first_frame) / entry.speed if entry.speed > 0.0 else (last - entry.last_frame) / entry.speed
