"""Operators of the lists in the panel: the list of layers, and the list of bones and bone collections in a layer's mask."""

import bpy

from ..core.interface.rows import Rows
from ..core.refusals import Refused, check_no_tweak_mode
from ..core.translations import tr
from . import setup, targets
from .operators import MaskKeywords, OfALayer

DIRECTIONS = (
    ('UP', "Up", "Move towards the top of the list, beneath the other layer"),
    ('DOWN', "Down", "Move towards the end of the list, above the other layer"),
)


class MOTUS_OT_layer_move(OfALayer, bpy.types.Operator):
    bl_idname = "motus.layer_move"
    bl_label = "Move Layer"
    bl_description = "Exchange a layer with its neighbour: layers further down in the list act on top"

    direction: bpy.props.EnumProperty(
        name="Direction", description="Direction in which the item moves in the list", items=DIRECTIONS, default='UP'
    )
    redo = (Rows(("direction",)),)

    def run(self, context):
        rig, index = self.chosen(context)
        place = index + (1 if self.direction == 'DOWN' else -1)
        if not 0 <= place < len(rig.motus.layers.entries):
            raise Refused(tr("The layer is at the end of the list already"))
        targets.check_free_to_move(rig, min(index, place))
        check_no_tweak_mode(rig)
        setup.move(rig, index, place)


class MOTUS_OT_layer_duplicate(OfALayer, bpy.types.Operator):
    bl_idname = "motus.layer_duplicate"
    bl_label = "Duplicate Layer"
    bl_description = "Lay a copy of a layer, with the same action and mask, above it"

    def run(self, context):
        rig, index = self.chosen(context)
        targets.check_room(rig)
        if index + 1 < len(rig.motus.layers.entries):
            targets.check_free_to_move(rig, index + 1)
        check_no_tweak_mode(rig)
        setup.duplicate(rig, index)


class MOTUS_OT_layer_mask_add(MaskKeywords, OfALayer, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.layer_mask_add"
    bl_label = "Add to Mask"
    bl_description = "Let the active layer act on the selected bones too"
    redo = (Rows(("with_children",)),)

    def run(self, context):
        rig, index = self.chosen(context)
        items = self.items(context, rig)
        if not items:
            raise Refused(tr("Select bones in Pose Mode, or name bones or collections"))
        setup.add_to_mask(rig, index, items)


class MOTUS_OT_layer_mask_remove(OfALayer, bpy.types.Operator):
    bl_idname = "motus.layer_mask_remove"
    bl_label = "Remove from Mask"
    bl_description = "Take a bone or collection out of the layer's mask; without any the layer acts on all bones"

    index: bpy.props.IntProperty(
        name="Index", description="Index in the mask's list; -1 is the active one", default=-1, min=-1, options={'SKIP_SAVE'}
    )

    def run(self, context):
        rig, index = self.chosen(context)
        entry = rig.motus.layers.entries[index]
        place = entry.active_mask if self.index < 0 else self.index
        if not 0 <= place < len(entry.mask):
            raise Refused(tr("The mask has no such item"))
        setup.remove_from_mask(rig, index, place)


classes = (MOTUS_OT_layer_move, MOTUS_OT_layer_duplicate, MOTUS_OT_layer_mask_add, MOTUS_OT_layer_mask_remove)
