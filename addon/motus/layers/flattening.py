"""The operator motus.layers_flatten, which writes the motion under all layers into one new action and mutes the layers."""

import bpy
from mathutils import Matrix

from ..core import rigs
from ..core.bake.keys import write_curves
from ..core.bake.sampling import Track
from ..core.blender import actions
from ..core.blender.frames import Kept, depsgraph_of, go_to
from ..core.interface.operators import OBJECT_OR_POSE_MODE, object_keyword
from ..core.interface.over_frames import OverFrames
from ..core.measures import scene_time
from ..core.refusals import Refused, check_no_tweak_mode, check_posed
from ..core.translations import tr
from ..core.wiring import driven_bones
from . import groups, targets

SAME = 1e-6
"""Difference from its present value below which a channel without keys counts as still and gets no keys."""


def flatten(scene, view_layer, rig, frames):
    """Flatten the layers of a rig: a generator that yields the number of frames recorded so far.

    The keys are written after the last frame, so closing the generator before that changes nothing.
    Raises Refused if no layer moves a bone that can have keys.
    """
    tracks = _tracks(rig)
    if not tracks:
        raise Refused(tr("No layer moves a bone of {object} that could have keys").format(object=rig.name))
    kept, layer = Kept(scene), view_layer.name
    try:
        for index, frame in enumerate(frames):
            go_to(scene, frame)
            _record(rig.evaluated_get(depsgraph_of(scene, layer)), tracks)
            yield index + 1
    finally:
        kept.restore()
    _apply(rig, tracks, [scene_time.keys_time(scene, frame) for frame in frames])
    kept.restore()


def undrivable(rig):
    """List the names of masked bones that cannot be flattened, because drivers set their channels, which overrule keys."""
    driven = driven_bones(rig)
    return [name for name in groups.masked(rig) if name in driven]


def _tracks(rig):
    driven, bones = driven_bones(rig), rig.pose.bones
    return [Track(bones[name], groups.channels_of(bones[name])) for name in groups.masked(rig) if name not in driven]


def _record(evaluated, tracks):
    known = rigs.still(evaluated, rigs.names_of(evaluated))
    rows = {name: row for row, name in enumerate(known.names)}
    basis = rigs.basis(evaluated, known).reshape(-1, 4, 4).swapaxes(1, 2)
    for track in tracks:
        track.record_basis(Matrix(basis[rows[track.thing.name]].tolist()))


def _apply(rig, tracks, times):
    """Write the tracks into the rig's action, with keys at `times`, frames in the keys' time, and mute the layers."""
    animation = rig.animation_data or rig.animation_data_create()
    keyed = {curve.data_path for curve in actions.fcurves(rig)}
    for track in tracks:
        _drop_still(track, keyed)
    if animation.action:
        animation.action.use_fake_user = True  # Blender does not save an action without a user
    bag = actions.assign_copy(rig, f"{rig.name} Flattened")
    write_curves(bag, tracks, times)
    for curve in [one for one in bag.fcurves if one.data_path.startswith(f"{targets.LIST}[") and one.data_path.endswith(".is_muted")]:
        bag.fcurves.remove(curve)
    if animation.nla_tracks:  # the new keys contain the NLA strips' motion as well
        animation.action_blend_type, animation.action_influence = 'REPLACE', 1.0
    for entry in rig.motus.layers.entries:
        entry.is_muted = True
    rig.update_tag()


def _drop_still(track, keyed):
    """Remove the channels from a bone's samples that have no keys and do not move. keyed: data paths of the rig's F-curves."""
    for name, rows in list(track.values.items()):
        own = getattr(track.thing, name)
        if track.data_path(name) not in keyed and all(abs(value - rest) < SAME for row in rows for value, rest in zip(row, own)):
            del track.values[name]


class MOTUS_OT_layers_flatten(OverFrames, bpy.types.Operator):
    bl_idname = "motus.layers_flatten"
    bl_label = "Flatten Layers"
    bl_description = "Write what the layers give into one new action, and mute them; the old action stays in the file"

    object: object_keyword("Name of the armature; empty takes the active one")
    modes = OBJECT_OR_POSE_MODE

    @classmethod
    def check_offer(cls, context):
        _editable(context, "")

    def steps(self, context, frames):
        rig = _editable(context, self.object)
        check_posed(rig, context.view_layer)
        self._rig, self._frames, self._left = rig.name, frames, undrivable(rig)
        return flatten(context.scene, context.view_layer, rig, frames)

    def result(self, context):
        self.report(
            {'INFO'},
            tr("Flattened the layers of {object} into the action {action}: {first}-{last}").format(
                object=self._rig,
                action=bpy.data.objects[self._rig].animation_data.action.name,
                first=f"{self._frames[0]:g}",
                last=f"{self._frames[-1]:g}",
            ),
        )
        if self._left:
            self.report({'WARNING'}, tr("Keyframes do not reach bones that have drivers: {bones}").format(bones=", ".join(self._left)))


def _editable(context, name):
    rig = targets.layered_rig(context, name)
    targets.check_editable(rig)
    check_no_tweak_mode(rig)
    if all(entry.is_muted for entry in rig.motus.layers.entries):
        raise Refused(tr("All layers of {object} are muted").format(object=rig.name))
    return rig


classes = (MOTUS_OT_layers_flatten,)
