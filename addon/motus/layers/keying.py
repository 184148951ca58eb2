"""The operators by which keys go into the action of a layer: a pose is keyed as it is seen, or the layer is edited by its keys."""

from typing import Any, NamedTuple

import bpy

from ..core import native
from ..core.blender import actions
from ..core.file.pointers import pointed
from ..core.interface.rows import Row, Rows
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused, check_posed
from ..core.tracks.transforms import Own
from ..core.translations import tr
from . import clips, editing, groups, live, mask, solve, targets
from .moments import Moment
from .operators import OfALayer

CHANNELS = (
    ('LOCATION', "Location", "Key locations", 1),
    ('ROTATION', "Rotation", "Key rotations", 2),
    ('SCALE', "Scale", "Key scales", 4),
)
"""Channels that are keyed, with the native module's flags of channels as their numbers."""
NEAR = 0.01
"""Frames between two keys within which Blender takes them for one."""
SAME = 1e-6
"""Difference from rest below which a single number without keys gets none, and from its former value below which a reference counts as kept."""


class Found(NamedTuple):
    """What the action of a layer has to say of some bones at one frame, so that the layers make the pose that is seen.

    frame: of the action. names: of the bones. rows: (n, 10), location, quaternion and scale of each bone. reached: of each bone the sum of
    the native module's flags of channels that make the pose exactly.
    """

    frame: float
    names: list
    rows: Any
    reached: tuple


def find(context, rig, index, names):
    """Return the Found of some bones of a rig for a layer. Raises Refused if nothing that the layer says would be seen.

    index: of the layer. names: of the bones.
    """
    check_posed(rig, context.view_layer)
    evaluated = rig.evaluated_get(context.view_layer.depsgraph)
    moment = Moment(context.scene, evaluated)
    entry = rig.motus.layers.entries[index]
    if index not in moment.acting:
        raise Refused(tr("{layer} has no weight here, so that nothing that is keyed into it would be seen").format(layer=entry.name))
    at, weight = native.module.layer_moments(moment.settings, moment.frame)[moment.acting.index(index)].tolist()
    if weight <= 0.0:
        raise Refused(
            tr("{layer} does not play at this frame, so that nothing that is keyed into it would be seen").format(layer=entry.name)
        )
    reference = solve.reference_frame(entry, moment.clips[index].frames)
    if reference is not None and abs(reference - at) < NEAR:
        raise Refused(
            tr("At the frame of its reference {layer} adds nothing: go to a different frame, or choose a different reference").format(
                layer=entry.name
            )
        )
    wanted = moment.laid(len(rig.motus.layers.entries))
    base, rows = moment.own.copy(), [moment.places[name] for name in names]
    if live.edited(rig) is None:
        for name, row in zip(names, rows):
            own = Own(evaluated.pose.bones[name])
            if own.reason is None:
                base[row] = own.values(np.array([moment.frame])).matrices[0].T.ravel()
    else:
        base[rows] = live.Beneath(evaluated, names).matrices(moment.frame)
    return Found(at, names, *moment.sources(base, index, wanted, rows))


def write(rig, entry, found):
    """Key what was found into the action of a layer. Channels that were not reached get no keys."""
    action = pointed(entry, "action")
    bag = actions.bag_for_object(action, entry.slot, rig.data.bones.keys(), rig.name)
    present = clips.curves_of_bones(action, entry.slot, found.names)
    reference = solve.reference_frame(entry, tuple(action.frame_range))
    for name, row, reached in zip(found.names, found.rows.tolist(), found.reached):
        bone, known = rig.pose.bones[name], present.get(name, {})
        mode = clips.mode_of(bone.rotation_mode, known)
        turning = clips.rotation_of(mode)
        before = known.get(turning, {})
        near = [before[index].evaluate(found.frame) if index in before else own for index, own in enumerate(getattr(bone, turning))]
        numbers = clips.numbers_of(row, mode, near)
        for flag, channel, values in zip((1, 2, 4), ("location", turning, "scale"), numbers):
            if reached & flag:
                path = f"{bone.path_from_id()}.{channel}"
                _key(bag, path, name, known.get(channel, {}), found.frame, values, reference)
    action.update_tag()


def _key(bag, path, group, curves, frame, values, reference):
    """Key the numbers of a property at a frame of an action.

    curves: {index: F-curve} that there are. reference: frame of the action whose pose has to stay what it is, or None.
    """
    rest = clips.at_rest(path.rpartition(".")[2])
    for index, value in enumerate(values):
        curve = curves.get(index)
        if curve is None and curves and abs(value - rest[index]) < SAME:
            continue
        was = rest[index] if curve is None else None if reference is None else curve.evaluate(reference)
        curve = curve or actions.new_fcurve(bag, path, index, group)
        curve.keyframe_points.insert(frame, value)
        curve.update()
        if reference is not None and abs(curve.evaluate(reference) - was) > SAME:
            curve.keyframe_points.insert(reference, was)
            curve.update()


def restore_own(scene, rig, names):
    """Set the own channels of bones to what their animation gives at the present frame: changes that nobody has keyed go."""
    frame = np.array([scene_time.present(scene)])
    for name in names:
        for channels in Own(rig.pose.bones[name]).channels.values():
            for one in channels:
                if one.reason is None and not one.is_constant:
                    one.number.write(float(one.values(frame)[0]))


class MOTUS_OT_layer_key(OfALayer, bpy.types.Operator):
    bl_idname = "motus.layer_key"
    bl_label = "Key Pose into Layer"
    bl_description = "Key the pose of the selected bones into the action of the active layer, so that it is seen as it is now"

    bones: bpy.props.StringProperty(
        name="Bones", description="Names of bones, with commas between; empty takes the selected ones", options={'SKIP_SAVE'}
    )
    channels: bpy.props.EnumProperty(
        name="Channels",
        description="What is keyed",
        items=[(*one[:3], 0, one[3]) for one in CHANNELS],
        default={'LOCATION', 'ROTATION'},
        options={'ENUM_FLAG'},
    )
    redo = (Rows((Row("channels"),)),)

    def run(self, context):
        rig, index = self.chosen(context)
        entry = rig.motus.layers.entries[index]
        targets.check_action(entry)
        names = targets.bones_named(rig, self.bones) or targets.selected_bones(context, rig)
        if not names:
            raise Refused(tr("Select bones in Pose Mode, or name some"))
        masked = set(mask.names(rig, entry))
        inside = [name for name in names if name in masked]
        if not inside:
            raise Refused(tr("The mask of {layer} has none of these bones").format(layer=entry.name))
        found = find(context, rig, index, inside)
        chosen = sum(number for name, _, _, number in CHANNELS if name in self.channels)
        asked = [chosen if "location" in groups.channels_of(rig.pose.bones[name]) else chosen & ~1 for name in inside]
        keyed = [wanted & reached for wanted, reached in zip(asked, found.reached)]
        lost = [name for name, wanted, done in zip(inside, asked, keyed) if wanted != done]
        if not any(keyed):
            raise Refused(_unreached(entry, inside))
        write(rig, entry, found._replace(reached=keyed))
        if live.edited(rig) is None:
            restore_own(context.scene, rig, inside)
            rig.update_tag()
        else:
            context.scene.frame_set(context.scene.frame_current, subframe=context.scene.frame_subframe)
        self.report(
            {'INFO'}, tr("Keyed the pose into {layer}, at frame {frame} of its action").format(layer=entry.name, frame=f"{found.frame:g}")
        )
        if lost:
            self.report({'WARNING'}, _unreached(entry, lost))


class MOTUS_OT_layer_edit(OfALayer, bpy.types.Operator):
    bl_idname = "motus.layer_edit"
    bl_label = "Edit Layer"
    bl_description = (
        "Show the curves of the active layer's action in the editors, at the layer's time, and let keys go into it; again ends it"
    )

    def run(self, context):
        rig, index = self.chosen(context)
        is_same = rig.motus.layers.entries[index].is_edited
        if any(entry.is_edited for entry in rig.motus.layers.entries):
            editing.leave(rig)
        if not is_same:
            check_posed(rig, context.view_layer)
            editing.check(rig, index)
            editing.enter(context.scene, rig, index)


def _unreached(entry, names):
    return tr("{layer} cannot make all of this pose, under the layers above and with its weight: {bones}").format(
        layer=entry.name, bones=", ".join(names)
    )


classes = (MOTUS_OT_layer_key, MOTUS_OT_layer_edit)
