"""What going through frames changes and has to put back, and the keywords of the operators that do it on chains."""

import math

import bpy

from ..core import actions, over_frames
from ..core.refusals import check_posed
from .operators import OfABone, in_a_mode_of_objects
from .targets import rig_with_ik


class Kept:
    """The frame, and what animated properties of some objects stand at, keyed or not."""

    def __init__(self, scene, objects):
        self._scene = scene
        self._frame = scene.frame_current, scene.frame_subframe
        self._values = {(obj, path): value for obj in objects for path, value in _animated(obj).items()}

    def restore(self, written=()):
        """Go back to the frame, and to values that were changed there without a key.

        written: (object, path) of what has new keys, which count instead.
        """
        whole, part = self._frame
        self._scene.frame_set(whole, subframe=part)
        for obj in dict.fromkeys(obj for obj, _ in self._values):
            for path, now in _animated(obj).items():
                kept = self._values.get((obj, path), now)
                if kept != now and (obj, path) not in written:
                    _assign(obj, path, kept)


def _animated(obj):
    """{data path: value} of what F-curves of the object animate, as far as it is there."""
    found = {}
    for path in {curve.data_path for curve in actions.fcurves(obj)}:
        try:
            value = obj.path_resolve(path)
        except ValueError:
            continue  # of a bone that was removed or renamed
        found[path] = tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value
    return found


def _assign(obj, path, value):
    if path.endswith('"]'):
        holder, _, key = path[:-2].rpartition('["')
        (obj.path_resolve(holder) if holder else obj)[bpy.utils.unescape_identifier(key)] = value
    else:
        # Whole vectors: an item of rotation_euler would set the rotation mode back.
        holder, _, name = path.rpartition(".")
        setattr(obj.path_resolve(holder) if holder else obj, name, value)


def go_to(scene, frame):
    """Evaluate a frame, which may be a fraction."""
    whole = math.floor(frame)
    scene.frame_set(whole, subframe=frame - whole)


def active_rig(context, name):
    """The rig of this name, or the active one, that has inverse kinematics and shows its pose."""
    rig = rig_with_ik(context, name)
    check_posed(rig, context.view_layer)
    return rig


class OverFrames(OfABone, over_frames.OverFrames):
    """Mixin of core's OverFrames with the keywords that operators on chains have."""

    bl_options = {'REGISTER', 'UNDO'}

    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the last bone of the chain; empty takes all chains of the object",
        options={'SKIP_SAVE'})
    use_range: bpy.props.BoolProperty(
        name="Frame Range", description="All frames from the start to the end; otherwise the current frame alone",
        default=True)
    step: bpy.props.FloatProperty(
        name="Step", description="Frames from one to the next, less than one for sub-frames", default=1.0, min=0.001,
        soft_min=0.1, soft_max=10.0)

    poll = classmethod(in_a_mode_of_objects)

    def _frames(self, scene):
        if not self.use_range:
            return [scene.frame_current + scene.frame_subframe]
        return super()._frames(scene)
