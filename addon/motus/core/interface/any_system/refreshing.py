"""The operator motus.refresh, which rebuilds the drivers and constraints that a system has set up."""

import bpy

from ... import wiring
from ...declare import wired_on
from ...refusals import Refused, check_local
from ...translations import tr
from ..operators import OBJECT_OR_POSE_MODE, Operator, named_or_active, object_keyword


def _owner_and_systems(thing, name):
    """Find what to rebuild for an object: (owner, [System]). Raises Refused if no system drives the object.

    thing: an owner (object whose settings a system solves), or an object that an owner drives. name: of one system; "" for all systems of
    the owner.
    """
    for owner, systems in wired_on(thing):
        chosen = [one for one in systems if name in ("", one.name)]
        if chosen:
            check_local(owner)
            return owner, chosen
    raise Refused(tr("{object} is not driven by Motus: add a system to it first").format(object=thing.name))


class MOTUS_OT_refresh(Operator, bpy.types.Operator):
    bl_idname = "motus.refresh"
    bl_label = "Refresh"
    bl_description = "Rebuild what Motus has set up, after bones, parents or data that it reads have changed"

    modes = OBJECT_OR_POSE_MODE

    object: object_keyword("Object that is driven or drives others; empty means the active one")
    system: bpy.props.StringProperty(
        name="System", description="Name of the system to rebuild; empty means all of the object's", options={'SKIP_SAVE'}
    )

    @classmethod
    def check_offer(cls, context):
        _owner_and_systems(named_or_active(context, ""), "")

    def run(self, context):
        owner, systems = _owner_and_systems(named_or_active(context, self.object), self.system)
        for one in systems:
            if one.rebuild is None:
                wiring.refresh(one, owner)
            else:
                one.rebuild(owner)


classes = (MOTUS_OT_refresh,)
