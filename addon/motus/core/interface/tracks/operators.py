"""Operators motus.track_record and motus.track_clear: samples, kept in the file, of motions that cannot be read from keys."""

import math

import bpy

from ...blender.datablocks import OfADatablock
from ...blender.frames import Kept, go_to
from ...measures import scene_time
from ...refusals import Refused, check_bone, check_evaluated, check_local, check_posed
from ...tracks import digest, recordings
from ...tracks.track import own_track, property_track, world_track
from ...translations import tr
from ..operators import Operator
from ..over_frames import OverFrames
from ..rows import Row, Rows

TRANSFORMS = (
    ('WORLD', "World Matrix", "World matrix, with parents and constraints"),
    ('OWN', "Own Transform", "Location, rotation and scale of its own, without parents and constraints"),
)


# The redo panel offers the two transforms, unless a script or a panel's button has named a property.
_WHAT = Rows((Row("transform", when=lambda operator: not operator.data_path),))


class _OfATrack(OfADatablock, Operator):
    """Mixin of operators with the keywords that name a track: the motion of an object, bone or property over time."""

    bone: bpy.props.StringProperty(name="Bone", description="Name of a bone; empty means the object itself", options={'SKIP_SAVE'})
    transform: bpy.props.EnumProperty(
        name="Transform", description="Transform that is recorded if no data path is given", items=TRANSFORMS, options={'SKIP_SAVE'}
    )

    def track(self, id_data, scene):
        """The track that the operator's keywords name. id_data: original or evaluated datablock. Raises Refused if there is none."""
        if self.data_path:
            return property_track(id_data, self.data_path, self.index)
        if not isinstance(id_data, bpy.types.Object):
            raise Refused(tr("Only objects and bones have a transform: give a data path"))
        if self.bone:
            check_bone(id_data, self.bone)
        thing = id_data.pose.bones[self.bone] if self.bone else id_data
        return own_track(thing) if self.transform == 'OWN' else world_track(thing, scene)


class MOTUS_OT_track_record(OverFrames, _OfATrack, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.track_record"
    bl_label = "Record"
    bl_description = "Go through the frames and keep in the file the motion that cannot be read from keys, such as that of constraints"
    redo = (_WHAT, *OverFrames.redo)

    def steps(self, context, frames):
        id_data = self.id_data(context)
        self._check(context, id_data, len(frames))
        self._samples, self._frames_done = [], frames
        return self._record(context, id_data, frames)

    def result(self, context):
        id_data = self.id_data(context)
        track = self.track(id_data, context.scene)
        length = scene_time.keys_time(context.scene, 1.0)
        size = recordings.write(id_data, track.what, self._frames_done[0] * length, self.step * length, self._samples, digest.of(id_data))
        self.report(
            {'INFO'},
            tr("Recorded {frames} frames of {object}: {size} KB").format(
                frames=len(self._samples), object=id_data.name, size=math.ceil(size / 1024)
            ),
        )

    def _check(self, context, id_data, count):
        check_local(id_data)
        track = self.track(id_data, context.scene)
        if track.reason is None:
            raise Refused(tr("{object} is known at any frame: there is nothing to record").format(object=id_data.name))
        most = recordings.most_samples(track.width)
        if count > most:
            raise Refused(tr("{count} samples are too many for a file: {most} at most").format(count=count, most=most))
        check_evaluated(id_data, context.view_layer)
        if self.bone:
            check_posed(id_data, context.view_layer)

    def _record(self, context, id_data, frames):
        kept = Kept(context.scene)
        try:
            for index, frame in enumerate(frames):
                go_to(context.scene, frame)
                evaluated = id_data.evaluated_get(context.view_layer.depsgraph)
                self._samples.append(self.track(evaluated, context.scene).present())
                yield index + 1
        finally:
            kept.restore()


class MOTUS_OT_track_clear(_OfATrack, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.track_clear"
    bl_label = "Clear Recording"
    bl_description = "Remove the recorded samples from the file"
    redo = (_WHAT,)

    def run(self, context):
        id_data = self.id_data(context)
        check_local(id_data)
        if not recordings.remove(id_data, self.track(id_data, context.scene).what):
            raise Refused(tr("Nothing was recorded of {object}").format(object=id_data.name))


classes = (recordings.MOTUS_PG_recording, MOTUS_OT_track_record, MOTUS_OT_track_clear)
