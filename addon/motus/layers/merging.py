"""Operators that make something different of layers: one layer of two, or strips of the NLA."""

import bpy
from mathutils import Matrix, Quaternion

from ..core import native
from ..core.bake.keys import write_curves
from ..core.bake.sampling import Track
from ..core.blender import actions, capabilities
from ..core.blender.frames import Kept, depsgraph_of, go_to
from ..core.file.pointers import pointed
from ..core.interface.operators import OBJECT_OR_POSE_MODE, object_keyword
from ..core.interface.over_frames import OverFrames
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused, check_no_tweak_mode, check_posed
from ..core.settings import entries
from ..core.translations import tr
from ..core.wiring import driven_bones
from . import clips, groups, nla, setup, solve, targets
from .moments import Moment

CHANNELS = ((1, "location"), (2, "rotation"), (4, "scale"))
"""The native module's flags of channels, with the names of the channels."""


class Recording:
    """Tracks of the bones that some layers move, by their names, and what is to be recorded of them.

    found: {row of a bone: sum of the flags of its channels}. read(moment): returns the matrices of all bones, (B, 16), at a Moment.
    """

    def __init__(self, rig, names, found, read):
        bones, driven = rig.pose.bones, driven_bones(rig)
        self._read = read
        self.tracks = {
            row: Track(bones[names[row]], {name for flag, name in CHANNELS if flags & flag} & groups.channels_of(bones[names[row]]))
            for row, flags in sorted(found.items())
            if names[row] not in driven
        }

    def record(self, moment):
        """Append what the layers give at a Moment."""
        matrices = self._read(moment)
        for row, track in self.tracks.items():
            track.record_basis(Matrix(matrices[row].reshape(4, 4).T.tolist()))

    def written(self, rig, name, frames):
        """Return (new action, identifier of its slot) with the keys. frames: of the keys."""
        action = bpy.data.actions.new(name)
        bag = actions.bag_for_object(action, "", (), rig.name)
        write_curves(bag, self.tracks.values(), frames)
        return action, bag.slot.identifier if capabilities.has_slotted_actions() else ""


def recorded(scene, view_layer, rig, recordings, frames, influence):
    """Fill Recordings frame by frame: a generator that yields the number of frames recorded so far. influence: as of Moment."""
    kept, layer = Kept(scene), view_layer.name
    try:
        for index, frame in enumerate(frames):
            go_to(scene, frame)
            moment = Moment(scene, rig.evaluated_get(depsgraph_of(scene, layer)), influence)
            for recording in recordings:
                recording.record(moment)
            yield index + 1
    finally:
        kept.restore()


def moved(scene, rig, view_layer):
    """Return (names of all bones, row by row; for each layer {row: sum of the flags of its channels} of the bones that it moves)."""
    moment = Moment(scene, rig.evaluated_get(view_layer.depsgraph))
    return list(moment.places), [moment.bones(index) for index in range(len(moment.clips))]


def united(first, second):
    """Return the union of two {row: flags}."""
    return {row: first.get(row, 0) | second.get(row, 0) for row in first.keys() | second.keys()}


def merge(scene, view_layer, rig, index, frames):
    """Make one layer of a layer and the one beneath it: a generator as recorded().

    Two additive layers become one that adds what both add; all others become one that overrides, with the motion beneath in it.
    """
    names, found = moved(scene, rig, view_layer)
    lower, upper = (rig.motus.layers.entries[place] for place in (index - 1, index))
    is_added, after = lower.mode == upper.mode == 'ADDITIVE', 'STOP' if lower.after == upper.after == 'STOP' else 'HOLD'
    name, both = lower.name, f"{lower.name} + {upper.name}"
    recording = Recording(
        rig,
        names,
        united(found[index - 1], found[index]),
        lambda moment: _difference(moment, index) if is_added else moment.laid(index + 1),
    )
    if not recording.tracks:
        raise Refused(tr("No layer moves a bone of {object} that could have keys").format(object=rig.name))
    yield from recorded(scene, view_layer, rig, [recording], frames, 1.0)
    times = [scene_time.keys_time(scene, frame) for frame in frames]
    action, slot = recording.written(rig, both, times)
    changes = {
        "action": action,
        "slot": slot,
        "mode": 'ADDITIVE' if is_added else 'OVERRIDE',
        "reference": 'REST',
        "start": times[0],
        "use_range": True,
        "first_frame": times[0],
        "last_frame": times[-1],
        "after": after,
    }
    setup.add(rig, name, changes, [])
    last = len(rig.motus.layers.entries) - 1
    with entries.at_once(setup.system(), rig) as settings:
        for place in range(last, index + 1, -1):
            setup.exchange(rig, place, place - 1)
        settings.active_entry = index + 1
    entries.remove(setup.system(), rig, [index - 1, index], "active_entry")
    rig.motus.layers.entries[index - 1].name = name
    rig.motus.layers.active_entry = index - 1


def _difference(moment, index):
    """Return what the layers `index` - 1 and `index` add to the pose beneath them, (B, 16)."""
    beneath, result = moment.laid(index - 1), moment.laid(index + 1)
    count = len(beneath)
    locations, turns, scales = (np.empty((count, width)) for width in (3, 4, 3))
    native.module.layer_moves(beneath, result, locations, turns, scales)
    made = np.empty((count, 16))
    for row, parts in enumerate(zip(locations.tolist(), turns.tolist(), scales.tolist())):
        place, turn, scale = parts
        matrix = Matrix.Translation(place) @ Quaternion(turn).to_matrix().to_4x4() @ Matrix.Diagonal((*scale, 1.0))
        made[row] = np.array(matrix).T.ravel()
    return made


def to_strips(scene, view_layer, rig, frames):
    """Make strips of the NLA of a rig's layers, and mute the layers: a generator as recorded().

    A layer that a strip can express keeps its keys; the result of any other layer is recorded. Returns the names of the latter.
    """
    names, found = moved(scene, rig, view_layer)
    playing = [index for index, entry in enumerate(rig.motus.layers.entries) if not entry.is_muted and found[index]]
    if not playing:
        raise Refused(tr("No layer moves a bone of {object} that could have keys").format(object=rig.name))
    moment = Moment(scene, rig.evaluated_get(view_layer.depsgraph))
    baked = {
        index: Recording(rig, names, found[index], lambda moment, count=index + 1: moment.laid(count))
        for index in playing
        if not _is_strip(rig, index, moment)
    }
    yield from recorded(scene, view_layer, rig, baked.values(), frames if baked else [], None)
    times = [scene_time.keys_time(scene, frame) for frame in frames]
    animation = rig.animation_data or rig.animation_data_create()
    if animation.action:
        nla.play_own(scene, animation, animation.action.name)
        animation.action = None
    for index in playing:
        entry = rig.motus.layers.entries[index]
        if index in baked:
            action, slot = baked[index].written(rig, f"{rig.name} {entry.name}", times)
            strip = _add_baked(rig, entry.name, action, slot, times)
        else:
            strip = _add_plain(rig, entry, {names[row] for row in found[index]})
        strip.name = entry.name
    for curves in actions.own_curves(rig, lambda path: path.startswith(f"{targets.LIST}[") and path.endswith(".is_muted")):
        for curve in [one for one in curves if one.data_path.startswith(f"{targets.LIST}[") and one.data_path.endswith(".is_muted")]:
            curves.remove(curve)
    for entry in rig.motus.layers.entries:
        entry.is_muted = True
    rig.update_tag()
    return [rig.motus.layers.entries[index].name for index in baked]


def _is_strip(rig, index, moment):
    """Whether a strip of the NLA gives exactly what a layer gives."""
    entry, clip, settings = rig.motus.layers.entries[index], moment.clips[index], rig.motus.layers
    masked = moment.source.masks[index]
    weights = {masked[row] for row in clip.native.bones} - {0.0}
    prefixes = (f"{targets.LIST}[{index}].", f'{targets.LIST}["', "motus.layers.influence")
    animation = rig.animation_data
    curves = [*animation.drivers, *(curve for player in actions.players(rig) for curve in actions.curves_of(player))] if animation else []
    if weights != {1.0} or any(curve.data_path.startswith(prefixes) for curve in curves):
        return False
    if entry.weight != 1.0 or settings.influence != 1.0 or entry.in_armature or entry.blend_in or entry.speed <= 0.0:
        return False
    if entry.after == 'REPEAT' or (entry.after == 'STOP' and entry.blend_out):
        return False
    if entry.mode == 'ADDITIVE' and entry.reference != 'REST':
        return False
    beneath = {(curve.data_path, curve.array_index) for curve in actions.fcurves(rig)}
    return all(
        _is_whole(rig.pose.bones[name], channels, entry.mode, beneath)
        for name, channels in clips.curves_of_bones(pointed(entry, "action"), entry.slot, _masked(moment, index)).items()
    )


def _masked(moment, index):
    return [name for name, row in moment.places.items() if moment.source.masks[index][row] > 0.0]


def _is_whole(bone, channels, mode, beneath):
    """Whether a strip blends the channels {name: F-curves} of a bone as a layer does.

    beneath: (data path, index) of the F-curves of the rig's own action. Where no strip sets a property, it keeps the value of the frame
    before, so that the own action has to set what the layer sets.
    """
    turning = clips.rotation_of(bone.rotation_mode)
    if any(name.startswith("rotation") and name != turning for name in channels):
        return False
    if mode == 'ADDITIVE' and turning in channels and turning != "rotation_quaternion":
        return False  # a strip adds angles, a layer rotations
    return all(
        index in curves and (f"{bone.path_from_id()}.{name}", index) in beneath
        for name, curves in channels.items()
        for index in range(clips.SIZES[name])
    )


def _add_baked(rig, name, action, slot, times):
    strip = nla.new_strip(rig.animation_data, name, action, _slot(action, slot), round(times[0]))
    nla.fit(strip, (times[0], times[-1]), (times[0], times[-1]))
    strip.extrapolation = 'HOLD'
    return strip


def _add_plain(rig, entry, bones):
    """Add a strip with a copy of a layer's action in which only the bones in its mask are left."""
    action = pointed(entry, "action").copy()
    bag = actions.bag_for_object(action, entry.slot, rig.data.bones.keys(), rig.name)
    for curve in [one for one in bag.fcurves if actions.bone_of(one) not in bones]:
        bag.fcurves.remove(curve)
    first, last = solve.span(entry, tuple(pointed(entry, "action").frame_range))
    strip = nla.new_strip(rig.animation_data, entry.name, action, getattr(bag, "slot", None), round(entry.start))
    nla.fit(strip, (first, last), (entry.start, entry.start + (last - first) / entry.speed))
    strip.extrapolation = 'NOTHING' if entry.after == 'STOP' else 'HOLD_FORWARD'
    strip.blend_type = 'COMBINE' if entry.mode == 'ADDITIVE' else 'REPLACE'
    return strip


def _slot(action, identifier):
    return action.slots[identifier] if identifier else None


class OfLayersOverFrames(OverFrames):
    """Mixin of operators that record what layers give over a range of frames."""

    object: object_keyword("Name of the armature; empty takes the active one")
    modes = OBJECT_OR_POSE_MODE

    @classmethod
    def check_offer(cls, context):
        editable(context, "")

    def rig(self, context):
        """Return the rig; refuses one that shows no pose or cannot be edited."""
        rig = editable(context, self.object)
        check_posed(rig, context.view_layer)
        return rig


def editable(context, name):
    """Return the rig with layers of this name, or the active one; refuses one that is linked, baked or in tweak mode."""
    rig = targets.layered_rig(context, name)
    targets.check_editable(rig)
    check_no_tweak_mode(rig)
    return rig


class MOTUS_OT_layer_merge(OfLayersOverFrames, bpy.types.Operator):
    bl_idname = "motus.layer_merge"
    bl_label = "Merge Layer Down"
    bl_description = "Make one layer, with a new action, of the active layer and the one beneath it: exact at the frames that are recorded"

    layer: bpy.props.StringProperty(name="Layer", description="Name of the upper layer; empty takes the active one", options={'SKIP_SAVE'})
    for_scripts = ("layer",)

    def steps(self, context, frames):
        rig = self.rig(context)
        index = targets.layer_index(rig, self.layer)
        if index == 0:
            raise Refused(tr("There is no layer beneath {layer}").format(layer=rig.motus.layers.entries[0].name))
        targets.check_free_to_move(rig, index - 1)
        targets.check_room(rig)
        both = [rig.motus.layers.entries[place] for place in (index - 1, index)]
        for entry in both:
            if entry.is_muted:
                raise Refused(tr("{layer} is muted: switch it on first").format(layer=entry.name))
        self._rig, self._index, self._frames = rig.name, index - 1, frames
        self._is_added = all(entry.mode == 'ADDITIVE' for entry in both)
        return merge(context.scene, context.view_layer, rig, index, frames)

    def result(self, context):
        entry = bpy.data.objects[self._rig].motus.layers.entries[self._index]
        words = (
            tr("Merged two layers into {layer}: frames {first}-{last} of what they add")
            if self._is_added
            else tr("Merged two layers into {layer}: frames {first}-{last}, with the motion beneath them in its keys")
        )
        self.report({'INFO'}, words.format(layer=entry.name, first=f"{self._frames[0]:g}", last=f"{self._frames[-1]:g}"))


class MOTUS_OT_layers_to_nla(OfLayersOverFrames, bpy.types.Operator):
    bl_idname = "motus.layers_to_nla"
    bl_label = "Layers to NLA"
    bl_description = "Make strips of the NLA of the rig's own action and of its layers, and mute the layers"

    def steps(self, context, frames):
        rig = self.rig(context)
        if any(entry.is_solo for entry in rig.motus.layers.entries):
            raise Refused(tr("Layers of {object} are played alone: end that first").format(object=rig.name))
        if rig.animation_data and not rig.animation_data.use_nla:
            raise Refused(tr("The NLA of {object} is switched off: switch it on first").format(object=rig.name))
        self._rig, self._baked = rig.name, []
        return self._noted(to_strips(context.scene, context.view_layer, rig, frames))

    def _noted(self, steps):
        self._baked = yield from steps

    def result(self, context):
        self.report({'INFO'}, tr("The layers of {object} are strips of the NLA now, and muted").format(object=self._rig))
        if self._baked:
            self.report(
                {'WARNING'},
                tr("Strips cannot blend as these layers do, so that their results were recorded: {layers}").format(
                    layers=", ".join(self._baked)
                ),
            )


classes = (MOTUS_OT_layer_merge, MOTUS_OT_layers_to_nla)
