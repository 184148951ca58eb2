"""Base of the operators of inverse kinematics that step through a range of frames."""

import bpy

from ..core.interface import over_frames
from ..core.refusals import check_posed
from .operators import OfABone
from .targets import rig_with_ik


def active_rig(context, name):
    """Armature object of a name, or the active object if the name is empty.

    Raises Refused if it has no inverse kinematics, or does not show its pose.
    """
    rig = rig_with_ik(context, name)
    check_posed(rig, context.view_layer)
    return rig


class OverFrames(OfABone, over_frames.OverFrames):
    """Mixin of operators that step through frames for one chain or all chains of a rig: core's OverFrames with the chain's keywords."""

    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the last bone of the chain; empty takes all chains of the object", options={'SKIP_SAVE'}
    )
    use_range: bpy.props.BoolProperty(
        name="Frame Range",
        description="All frames from the start to the end; otherwise the current frame alone",
        default=True,
        options={'SKIP_SAVE'},
    )
    for_scripts = ("use_range",)

    def frames(self, scene):
        if not self.use_range:
            return over_frames.current(scene)
        return super().frames(scene)
