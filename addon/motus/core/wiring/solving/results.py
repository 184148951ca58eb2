"""Results of a solver: memory for poses, values that do nothing, and the status after an error."""

import logging

from ... import native
from ...file.stored import Damaged, Newer
from ...lazy import numpy as np
from ...measures import finite
from ..hubs import outbox
from ..sinks import attribute_sink, attributes

log = logging.getLogger(__name__)

ORDINARY = 1e30
"""Numbers whose squares have a sum below this limit are all finite. If the sum is not below, each number is checked on its own."""


class Poses:
    """Memory for the poses of `count` members that a solver computes.

    block: one array with all numbers. neutral: array of the same form, with poses that change nothing. locations (n, 3), rotations (n, 4;
    quaternions) and scales (n, 3) are views of `block`.
    """

    def __init__(self, count):
        self.block, self.neutral = np.empty(10 * count), np.zeros(10 * count)
        self._matrices = np.empty((count, 16), np.float32)
        self._numbers = self._matrices.reshape(-1)
        self._is_checked = False
        self._stored = None  # bytes of `block` when it was last written
        self.locations, self.rotations, self.scales = self._parts(self.block)
        _, rotations, scales = self._parts(self.neutral)
        rotations[:, 0] = 1.0
        scales.fill(1.0)

    @staticmethod
    def _parts(block):
        locations, rotations, scales = np.split(block, [3 * len(block) // 10, 7 * len(block) // 10])
        return locations.reshape(-1, 3), rotations.reshape(-1, 4), scales.reshape(-1, 3)

    def are_new(self):
        """Whether the poses differ from those of the last call, so that they have to be written to where the members' sinks read them.

        A caller that does not write them, or writes others there, has to call forget(). Nobody needs to after an exception: the solver, and
        these Poses with it, is then prepared anew.
        """
        before, self._stored = self._stored, self.block.tobytes()
        return self._stored != before

    def forget(self):
        """Have the next poses count as new, whatever they are."""
        self._stored = None

    def store(self, carrier, has_scales):
        """Write the poses, if they are new, as 4x4 matrices to the attribute of a hub's evaluated mesh that the members' constraints sample.

        carrier: the mesh. has_scales: whether the solver sets scales; if not, the scales are 1.
        """
        before, self._stored = self._stored, self.block.tobytes()
        if self._stored == before:
            return
        scales = self.scales if has_scales else None
        native.module.pack_matrices(self.locations, self.rotations, out=self._matrices, scales=scales)
        if self._is_checked:  # attributes.write() has checked the attribute of this evaluated copy before
            carrier.attributes[attribute_sink.ATTRIBUTE].data.foreach_set("value", self._numbers)
        else:
            attributes.write(carrier, attribute_sink.ATTRIBUTE, 'FLOAT4X4', self._matrices)
            self._is_checked = carrier.original.library is None


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
