"""Operators that give a system's settings to what else is selected, and that copy and paste them as a text in the clipboard."""

import bpy

from ... import keeping
from ...declare import is_owner, leader_of, of_owner, registered
from ...refusals import Refused
from ...settings import copied, entries
from ...translations import counted, tr
from .. import bone_entries, panels
from ..operators import OBJECT_OR_POSE_MODE, Operator, named_or_active, object_keyword
from ..rows import Rows

_WITHOUT_CLIPBOARD = keeping.OfProcess("copied settings, where Blender has no window and so no clipboard", "nothing", most=1)


def _system_keyword(description):
    return bpy.props.StringProperty(name="System", description=description, options={'SKIP_SAVE'})


def found_system(name):
    """The system of this name. Raises Refused if there is none whose settings can be copied."""
    system = registered.get(name)
    if not getattr(system, "copied_settings", ()):
        raise Refused(tr("There is no system {system}").format(system=name))
    return system


def _refuse_missing(system):
    raise Refused(tr("Nothing here has {system}").format(system=bpy.app.translations.pgettext_iface(system.label)))


def owner_of(system, obj):
    """The object whose settings of a system count for an object: itself, its leader, or whom it belongs to; None without one."""
    found = obj if is_owner(system, obj) else leader_of(system, obj) or (system.owner_of and system.owner_of(obj))
    return found if found is not None and is_owner(system, found) else None


def found_item(context, system, name, entry):
    """The item (core/settings/copied.py) of the object of this name, or of the active object if the name is empty.

    entry: name of the entry; empty takes the shown one. Raises Refused if there is no such item.
    """
    owner = owner_of(system, named_or_active(context, name))
    if owner is None:
        _refuse_missing(system)
    if not copied.has_list(system):
        return of_owner(system, owner)
    found = of_owner(system, owner).entries.get(entry) if entry else entries.active(owner, system.name)
    if found is None and bone_entries.are_of_bones(of_owner(system, owner)):
        raise Refused(tr("{object} has no bone {bone}").format(object=owner.name, bone=entry))
    if found is None:
        raise Refused(tr("{object} has no entry {entry}").format(object=owner.name, entry=entry))
    return found


class Copying(Operator):
    """Mixin of operators that give settings: what else they give than the values of the settings."""

    modes = OBJECT_OR_POSE_MODE
    redo = (Rows(("with_keys", "with_shot")),)

    with_keys: bpy.props.BoolProperty(
        name="With Keys", description="Replace the keys of these settings by those of the copied ones", default=False
    )
    with_shot: bpy.props.BoolProperty(
        name="All of the Shot",
        description="Give also those settings that belong to one shot, such as places, frames and weights",
        default=False,
    )

    def give(self, system, items, what):
        """Give items copied settings, which are checked. Raises Refused if an owner of the items cannot be changed."""
        copied.check_receivers(system, items, self.with_keys)
        copied.give(system, items, what, copied.names_of(system, self.with_shot), self.with_keys)


class MOTUS_OT_to_selected(Copying, bpy.types.Operator):
    bl_idname = bone_entries.TO_SELECTED
    bl_label = "To All Selected"
    bl_description = (
        "Give the settings of the active bone to all selected bones that have the same system, in Object Mode to all selected objects"
    )

    object: object_keyword("Name of the object; empty takes the active one, and the selected bones or objects")
    system: _system_keyword("Name of the system whose settings are copied, such as dynamics")
    bone: bpy.props.StringProperty(
        name="Bone", description="Name of the bone whose settings are copied; empty takes the active one", options={'SKIP_SAVE'}
    )
    bones: bpy.props.StringProperty(
        name="Bones",
        description="Names of the bones that are given the settings, with commas between; empty takes the selected ones",
        options={'SKIP_SAVE'},
    )

    @classmethod
    def check_offer(cls, context):
        if len(context.selected_pose_bones or () if context.mode == 'POSE' else context.selected_objects) < 2:
            raise Refused(tr("Select what shall be given these settings too"))

    def run(self, context):
        system = found_system(self.system)
        first, *others = self._items(context, system)
        if not others:
            raise Refused(tr("Nothing else that is selected has {system}").format(system=bpy.app.translations.pgettext_iface(system.label)))
        self.give(system, others, copied.take(system, first, self.with_keys))
        self.report({'INFO'}, counted(len(others), tr("Settings copied to 1 other"), tr("Settings copied to {count} others")))

    def _items(self, context, system):
        """List of the item whose settings are copied, followed by the items that receive them. Raises Refused if one is missing."""
        if not copied.has_list(system):
            first = found_item(context, system, self.object, "")
            owners = [obj for obj in context.selected_objects if is_owner(system, obj) and obj != first.id_data]
            return [first, *(of_owner(system, owner) for owner in owners)]
        if self.object or self.bone or self.bones:
            bones = [name.strip() for name in self.bones.split(",") if name.strip()]
            return [found_item(context, system, self.object, name) for name in (self.bone, *bones)]
        found = bone_entries.selected(context, system.name)
        if not found:
            _refuse_missing(system)
        return found


class MOTUS_OT_settings_copy(Operator, bpy.types.Operator):
    bl_idname = panels.COPY
    bl_label = "Copy Settings"
    bl_description = "Copy the settings that are shown, and their keys, to the clipboard as a text"
    bl_options = {'REGISTER'}

    object: object_keyword("Name of the object; empty takes the active one")
    system: _system_keyword("Name of the system whose settings are copied, such as dynamics")
    entry: bpy.props.StringProperty(
        name="Entry", description="Name of the entry in the system's list; empty takes the shown one", options={'SKIP_SAVE'}
    )

    def run(self, context):
        system = found_system(self.system)
        text = copied.as_text(copied.take(system, found_item(context, system, self.object, self.entry)))
        if bpy.app.background:
            _WITHOUT_CLIPBOARD.add("", text)
        else:
            context.window_manager.clipboard = text
        self.report({'INFO'}, tr("Settings copied to the clipboard"))


class MOTUS_OT_settings_paste(Copying, bpy.types.Operator):
    bl_idname = panels.PASTE
    bl_label = "Paste Settings"
    bl_description = "Give the settings that are shown the values that Copy Settings has put into the clipboard"

    object: object_keyword("Name of the object; empty takes the active one")
    system: _system_keyword("Name of the system whose settings are pasted, such as dynamics")
    entry: bpy.props.StringProperty(
        name="Entry", description="Name of the entry in the system's list; empty takes the shown one", options={'SKIP_SAVE'}
    )
    text: bpy.props.StringProperty(
        name="Text", description="Text that Copy Settings has made; empty takes that of the clipboard", options={'SKIP_SAVE'}
    )

    def run(self, context):
        system = found_system(self.system)
        what = copied.from_text(
            self.text or self._clipboard(context), tr("There are no copied settings in the clipboard: use Copy Settings first")
        )
        copied.check(system, what)
        self.give(system, [found_item(context, system, self.object, self.entry)], what)

    def _clipboard(self, context):
        return _WITHOUT_CLIPBOARD.find("", "") if bpy.app.background else context.window_manager.clipboard


classes = (MOTUS_OT_to_selected, MOTUS_OT_settings_copy, MOTUS_OT_settings_paste)
