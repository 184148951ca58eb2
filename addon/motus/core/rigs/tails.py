"""Turn bones of a rig so that their tails point to places in the world."""

from .. import native
from ..lazy import numpy as np
from . import arrays, plans


class _Plan:
    """Prepared native solver for the bones of a rig; made anew when the rig changes.

    rows: {bone name: row in the rig's arrays}. members: (bone name, row of the member in its group) of the bones, parents first.
    """

    def __init__(self, rig, rows, members):
        self.still = arrays.still(rig, tuple(rows))
        self.rows = [rows[name] for name, _ in members]
        self.solver = native.module.TailPlan(arrays.parents(rig, list(rows)), self.rows)
        self.members = np.array([member for _, member in members], int)


def turn(context, text, members, places, influences, scales=None):
    """Fill context.rotations so that bones of the context's owner point their tails to places, and context.scales: on top of their own pose.

    text: stands for what the rig was when it was wired, its fingerprint included. members: (bone name, row of the member in the group) of
    the bones, parents first. places: (n, 3), world space. influences: (n,), 0 to 1, of the turns. scales: (n, 3), along the bones' own axes;
    None scales no bone.
    """
    rig = context.owner
    plan = plans.plan(rig, f"{text} {members}", lambda rig, rows: _Plan(rig, rows, members))
    found = arrays.read(rig, plan.still)
    basis = arrays.scaled(found.basis, plan.rows, scales)
    context.rotations[plan.members] = plan.solver.solve(found.rest, found.poses, basis, found.inheritance, found.world, places, influences)
    if scales is not None:
        context.scales[plan.members] = scales
