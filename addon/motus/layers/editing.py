"""A layer that is edited: its action stands in a strip of the NLA in tweak mode, so that editors show its curves and keys go into it.

While a layer is edited, the own channels of the bones that its action animates are what the layer says. What lies beneath these bones is
read from the rig's own action, which a strip on a track below plays meanwhile.
"""

from contextlib import suppress

from ..core.blender import actions
from ..core.file import stored
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused, check_no_tweak_mode
from ..core.settings import entries
from ..core.translations import tr
from . import clips, live, nla, solve, targets
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
    if animation and any(track.is_solo for track in animation.nla_tracks):
        raise Refused(tr("A track in the NLA of {object} is played alone: end that first").format(object=rig.name))
    for name, channels in clips.curves_of_bones(action, entry.slot, rig.pose.bones.keys()).items():
        if clips.mode_of(rig.pose.bones[name].rotation_mode, channels) != rig.pose.bones[name].rotation_mode:
            raise Refused(
                tr("{action} turns {bone} in a different rotation mode than the rig: give the bone that mode first").format(
                    action=action.name, bone=name
                )
            )


def enter(scene, rig, index):
    """Begin to edit a layer of a rig by its keys. Raises Refused, and changes nothing, if what lies beneath could not be found."""
    entry = rig.motus.layers.entries[index]
    animation = rig.animation_data or rig.animation_data_create()
    live.keep_channels(rig)
    if animation.action:
        nla.play_own(scene, animation, live.BENEATH)
    reason = live.Beneath(rig, {bone.name: live.channels_of(bone) for bone in rig.pose.bones}).reason
    if reason:
        _remove_tracks(animation)
        rig.motus.layers.kept_channels = ""
        raise Refused(tr("What lies beneath the layer is not known: {reason}").format(reason=reason.sentence))
    _tweak(scene, rig, entry)
    with entries.at_once(system(), rig) as settings:
        settings.entries[index].is_edited = True
        settings.active_entry = index
    rig.update_tag()


def leave(rig):
    """End the editing of a layer: the rig has the action and the values again that it had, and its NLA no track of ours."""
    animation = rig.animation_data
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
                entry.is_edited = False
                _let_go(entry)
    for name, channels in kept.items():
        bone = rig.pose.bones.get(name)
        for one, numbers in channels.items() if bone else ():
            setattr(bone, one, numbers)
    rig.update_tag()


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
    for name in (live.BENEATH, live.TWEAKED):
        track = animation.nla_tracks.get(name)
        if track:
            animation.nla_tracks.remove(track)


def _let_go(entry):
    """Let the layer play all of its action again, if it did before; keys that were added stay at the frames at which they were seen."""
    action = pointed(entry, "action")
    if not entry.is_open:
        return
    entry.use_range = entry.is_open = False
    if action and entry.speed:
        first, last = action.frame_range
        entry.start += (first - entry.first_frame) / entry.speed if entry.speed > 0.0 else (last - entry.last_frame) / entry.speed
