"""Operators that add animation layers to a rig and remove them, and the base classes of all operators on layers."""

import bpy

from ..core.interface import operators
from ..core.interface.rows import Row, Rows
from ..core.measures import scene_time
from ..core.refusals import check_finite, check_no_tweak_mode
from ..core.settings.declared import choice
from ..core.translations import tr
from . import editing, rows, setup, targets
from .properties import KEYWORDS, MODES, LayerKeywords

MASKS = (
    ('SELECTED', "Selected Bones", "The bones that are selected in Pose Mode; all bones of the rig in Object Mode"),
    ('ALL', "Whole Rig", "All bones of the rig"),
)


class OfARig(operators.OfARig):
    """Mixin of operators on a rig that has layers."""

    rig_with = staticmethod(targets.layered_rig)


class OfALayer(OfARig):
    """Mixin of operators on one layer of a rig."""

    layer: bpy.props.StringProperty(name="Layer", description="Name of the layer; empty takes the active one", options={'SKIP_SAVE'})

    def chosen(self, context):
        """Return (rig, index of the layer) by the operator's keywords, or from the context. Refuses a rig that cannot be edited."""
        rig = targets.layered_rig(context, self.object)
        targets.check_editable(rig)
        return rig, targets.layer_index(rig, self.layer)


class MaskKeywords:
    """Mixin of operators with keywords for the bones and bone collections in a layer's mask."""

    bones: bpy.props.StringProperty(name="Bones", description="Names of bones for the mask, with commas between", options={'SKIP_SAVE'})
    collections: bpy.props.StringProperty(
        name="Collections", description="Names of bone collections for the mask, with commas between", options={'SKIP_SAVE'}
    )
    with_children: bpy.props.BoolProperty(name="With Children", description="All bones below those of the mask count as well", default=True)

    def items(self, context, rig, selected=True):
        """List (name, 'BONE' or 'COLLECTION', with children) of the mask's new items, by the operator's keywords.

        Without names the selected bones are taken, if `selected` is set.
        """
        bones = targets.bones_named(rig, self.bones)
        found = targets.collections_named(rig, self.collections)
        if not bones and not found and selected:
            bones = targets.topmost_selected(context, rig)
        return [(name, kind, self.with_children) for kind, names in (('BONE', bones), ('COLLECTION', found)) for name in names]


class MOTUS_OT_layer_add(operators.FindsValues, MaskKeywords, LayerKeywords, OfARig, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.layer_add"
    bl_label = "Add Layer"
    bl_description = "Lay an action over the rig's own animation, on the selected bones and those below, or on all bones"

    action: bpy.props.StringProperty(name="Action", description="Name of the action; empty leaves it to be chosen", options={'SKIP_SAVE'})
    slot: bpy.props.StringProperty(
        name="Slot",
        description="Identifier of the action's slot; empty takes the rig's own or one of its name, else the first one that animates its bones",
        options={'SKIP_SAVE'},
    )
    reference_action: bpy.props.StringProperty(
        name="Reference Action",
        description="Name of the action with which an additive layer is compared, if its reference is a different action",
        options={'SKIP_SAVE'},
    )
    layer: bpy.props.StringProperty(
        name="Layer", description="Name of the layer; empty takes the action's. One that is there is changed", options={'SKIP_SAVE'}
    )
    start: bpy.props.FloatProperty(
        name="Start",
        description="Frame of the scene on which the action begins to play; not given, the current frame",
        default=1.0,
        step=100,
        precision=1,
    )
    mask: bpy.props.EnumProperty(
        name="Mask", description="Bones that the layer acts on if neither bones nor collections are named", items=MASKS, default='SELECTED'
    )
    redo = (Rows((Row("mask"), Row("with_children")), title="Mask"), *rows.ALL)

    @classmethod
    def check_offer(cls, context):
        targets.check_editable(targets.rig_for(context, ""))

    def run(self, context):
        rig = targets.rig_for(context, self.object)
        targets.check_editable(rig)
        changes = self.given(KEYWORDS)
        check_finite(self, changes)
        action = targets.action_for(self.action)
        targets.check_slot(action, self.slot)
        items = self.items(context, rig, self.mask == 'SELECTED')
        index = rig.motus.layers.entries.find(self.layer) if self.layer else -1
        if self.action or self.slot:
            changes |= {"action": action, "slot": self.slot or setup.slot_of(rig, action)}
        if self.reference_action:
            changes |= {"reference_action": targets.action_for(self.reference_action)}
        if index >= 0:
            has_mask = any(map(self.is_given, ("bones", "collections", "mask")))
            setup.change(rig, index, changes, items if has_mask else None)
        else:
            targets.check_room(rig)
            if not self.is_given("start"):
                self.start = changes["start"] = scene_time.present(context.scene)
            setup.add(rig, self.layer or self.action or tr("Layer"), changes, items)
        settings = rig.motus.layers
        made = settings.entries[settings.active_entry]
        self.show_used(made, KEYWORDS)
        self.report({'INFO'}, tr("{object} has the layer {layer}").format(object=rig.name, layer=made.name))


class MOTUS_OT_layer_new(MaskKeywords, OfARig, bpy.types.Operator):  # type: ignore[misc]
    bl_idname = "motus.layer_new"
    bl_label = "New Empty Layer"
    bl_description = "Lay a new action without keys over the rig's own animation, for as long as the scene: keys go into it as it is edited"

    layer: bpy.props.StringProperty(name="Layer", description="Name of the layer and its action", options={'SKIP_SAVE'})
    mode: choice("Mode", "How the layer acts on what lies beneath it", MODES, 'OVERRIDE')
    redo = (Rows(("with_children", "mode")),)

    @classmethod
    def check_offer(cls, context):
        targets.check_editable(targets.rig_for(context, ""))

    def run(self, context):
        rig, scene = targets.rig_for(context, self.object), context.scene
        targets.check_editable(rig)
        items = self.items(context, rig)
        targets.check_room(rig)
        check_no_tweak_mode(rig)
        made = setup.add_empty(rig, self.layer or tr("Layer"), self.mode, (scene_time.first(scene), scene_time.last(scene)), items)
        self.report({'INFO'}, tr("{object} has the layer {layer}").format(object=rig.name, layer=made.name))


class MOTUS_OT_layer_remove(OfALayer, bpy.types.Operator):
    bl_idname = "motus.layer_remove"
    bl_label = "Remove Layer"
    bl_description = "Remove a layer from the rig; its action stays in the file"

    def run(self, context):
        rig, index = self.chosen(context)
        targets.check_free_to_move(rig, index)
        if any(entry.is_edited for entry in rig.motus.layers.entries):
            editing.leave(rig)
        check_no_tweak_mode(rig)
        name = rig.motus.layers.entries[index].name
        setup.remove(rig, index)
        self.report({'INFO'}, tr("Removed the layer {layer} of {object}").format(layer=name, object=rig.name))


classes = (MOTUS_OT_layer_add, MOTUS_OT_layer_new, MOTUS_OT_layer_remove)
