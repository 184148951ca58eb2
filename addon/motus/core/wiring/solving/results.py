"""Results of a solver: poses on their way to the members, values that do nothing, and the status after an error."""

import logging

from ...file.stored import Damaged, Newer
from ...measures import finite
from ..hubs import outbox
from ..sinks import attribute_sink, attributes

log = logging.getLogger(__name__)


class MatrixSink:
    """Writes poses as 4x4 matrices to the attribute of a hub's evaluated mesh that the members' constraints sample.

    poses: PoseBuffer of the native module. has_scales: whether the solver sets scales; if not, the scales are 1.
    """

    def __init__(self, poses, mesh, has_scales):
        self._poses, self._mesh, self._has_scales = poses, mesh, has_scales
        self._is_checked = False

    def write(self):
        """Write the poses, unless they are those that were written before."""
        numbers = self._poses.matrices(self._has_scales)
        if numbers is None:
            return
        if self._is_checked:  # attributes.write() has checked the attribute of this evaluated copy before
            self._mesh.attributes[attribute_sink.ATTRIBUTE].data.foreach_set("value", numbers)
        else:
            attributes.write(self._mesh, attribute_sink.ATTRIBUTE, 'FLOAT4X4', numbers.reshape(-1, 16))
            self._is_checked = self._mesh.original.library is None


def do_nothing(box, layout):
    """Fill an outbox with values that leave the members at their own transforms.

    These are weight 0, and neutral poses if any member is relative (result applied on top of its own transform), because the sinks of
    relative members ignore the weight. box: array of the outbox's numbers. layout: Layout of the outbox.
    """
    box[outbox.WEIGHT] = 0.0
    if layout.is_relative and not layout.has_attribute:
        end = layout.base + outbox.POSE_SIZE * layout.members
        box[layout.base : end] = 0.0
        box[end:] = 1.0


def status_of(error, carrier, name, settings):
    """Return the status for an error that a solver raised.

    The error is logged, unless the error is Damaged or a setting is not finite. carrier: mesh of the hub. name: system, and group if any,
    for the log. settings: settings of the owner, or None if they cannot be read.
    """
    # The panel reports damaged data; a log entry would be repeated at every frame.
    if isinstance(error, Damaged):
        return float(outbox.NEWER if isinstance(error, Newer) else outbox.DAMAGED)
    if settings is not None and finite.has_bad_settings(settings):
        return float(outbox.NOT_FINITE)
    log.error("Motus: %s could not be computed on %s", name, getattr(carrier, "name", carrier), exc_info=error)
    return float(outbox.INTERNAL)
