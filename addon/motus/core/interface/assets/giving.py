"""The operator that gives the settings of an asset to what is selected, and the mixin of operators that give them."""

import re
from pathlib import Path

import bpy

from ...declare import of_owner, registered
from ...refusals import Refused
from ...settings import copied, entries
from ...translations import counted, tr
from .. import bone_entries
from ..any_system.copying import Copying, owner_of
from ..operators import named_or_active, object_keyword
from . import held

_RELATIVE = re.compile(r"(?:(?P<file>.*\.blend)[/\\])?Object[/\\](?P<name>[^/\\]+)", re.DOTALL)
"""What Blender calls an asset within its library, such as Motus/Ponytail.blend/Object/Ponytail."""


class Giving(Copying):
    """Mixin of operators that give the settings of an asset: which one, from where, and to what.

    A system that is missing is added, if the operator that adds it needs nothing but the object (System.adder).
    """

    name: bpy.props.StringProperty(name="Name", description="Name of the asset that has the settings", options={'SKIP_SAVE'})
    path: bpy.props.StringProperty(
        name="File", description="Path of the file that has the asset; empty means the current file", options={'SKIP_SAVE'}
    )
    object: object_keyword("Name of the object that is given the settings; empty takes the selected ones, in Pose Mode the selected bones")
    bones: bpy.props.StringProperty(
        name="Bones", description="Names of bones of the object that are given the settings, with commas between", options={'SKIP_SAVE'}
    )
    # Asset shelves say by these three which asset is meant.
    asset_library_type: bpy.props.EnumProperty(
        items=(('LOCAL', "", "", 1), ('ALL', "", "", 2), ('ESSENTIALS', "", "", 3), ('CUSTOM', "", "", 100)),
        options={'HIDDEN', 'SKIP_SAVE'},
    )
    asset_library_identifier: bpy.props.StringProperty(options={'HIDDEN', 'SKIP_SAVE'})
    relative_asset_identifier: bpy.props.StringProperty(options={'HIDDEN', 'SKIP_SAVE'})

    def find_asset(self, context):
        """Set name and path to the asset that is meant, unless they are given; returns whether there is one."""
        if not self.name:
            place = self._place(context)
            if place is None:
                return False
            self.name, self.path = place
        return True

    def _place(self, context):
        """Place of the asset that a shelf or the context means; None if that holds no settings of Motus, or if there is none."""
        found = _RELATIVE.fullmatch(self.relative_asset_identifier)
        if found and self.asset_library_type == 'LOCAL':
            return held.Place(found["name"])
        if found and self.asset_library_type == 'CUSTOM' and found["file"]:
            library = context.preferences.filepaths.asset_libraries.get(self.asset_library_identifier)
            parts = re.split(r"[/\\]", found["file"])
            return library and held.Place(found["name"], str(Path(bpy.path.abspath(library.path), *parts)))
        asset = held.shown(context)
        return held.place_of(asset, context) if asset is not None and held.is_held(asset) else None

    def what(self):
        """(system, copied settings) of the asset, which are checked. Raises Refused if they cannot be given to anything."""
        holds_nothing = tr("{asset} holds no settings of Motus").format(asset=self.name)
        what = copied.from_text(held.read(held.Place(self.name, self.path)), holds_nothing)
        system = registered.get(what.system)
        if not getattr(system, "copied_settings", ()):
            raise Refused(tr("There is no system {system}").format(system=what.system[:40]))
        copied.check(system, what)
        return system, what

    def run(self, context):
        system, what = self.what()
        wanted = self._wanted(context, system)
        if not wanted:
            raise Refused(tr("Select what shall be given these settings"))
        items = {receiver: _item(system, *receiver) for receiver in wanted}
        copied.check_receivers(system, [item for item in items.values() if item is not None], self.with_keys)
        refusals = []
        for receiver in [receiver for receiver, item in items.items() if item is None]:
            try:
                _add(system, *receiver)
            except Refused as refusal:
                refusals.append(str(refusal))
        # Adding an entry may move the others to different places in memory.
        found = list({item.as_pointer(): item for item in (_item(system, *receiver) for receiver in wanted) if item is not None}.values())
        if not found:
            raise Refused(refusals[0])
        self.give(system, found, what)
        self.report(
            {'INFO'}, counted(len(found), tr("Settings given to 1 object or bone"), tr("Settings given to {count} objects or bones"))
        )
        for sentence in dict.fromkeys(refusals):
            self.report({'WARNING'}, sentence)

    def _wanted(self, context, system):
        """Receivers of the settings: list of (object, name of a bone, or "" for what the object's panel shows)."""
        is_of_bones = copied.has_list(system) and bone_entries.are_of_bones(system.settings)
        if self.object:
            obj = named_or_active(context, self.object)
            return [(obj, name) for name in (bone_entries.names_in(obj, self.bones) if is_of_bones else ()) or [""]]
        if context.mode == 'POSE' and is_of_bones:
            return [(bone.id_data, bone.name) for bone in context.selected_pose_bones or ()]
        return [(obj, "") for obj in context.selected_objects]


def _item(system, obj, bone):
    """The item (core/settings/copied.py) of a receiver; None if it does not have the system."""
    owner = owner_of(system, obj)
    if owner is None:
        return None
    if not copied.has_list(system):
        return of_owner(system, owner)
    return of_owner(system, owner).entries.get(bone) if bone else entries.active(owner, system.name)


def _add(system, obj, bone):
    """Add a system to a receiver. Raises Refused with the sentence of the operator that adds it, or if that needs more than the receiver."""
    if not system.adder:
        label = bpy.app.translations.pgettext_iface(system.label)
        raise Refused(
            tr("{object} has no {system}, and needs more than settings for it: add it first").format(object=obj.name, system=label)
        )
    module, name = system.adder.split(".")
    try:
        getattr(getattr(bpy.ops, module), name)(object=obj.name, **({"bones": bone} if bone else {}))
    except RuntimeError as error:
        # Blender puts the kind of the report before its sentence.
        raise Refused(str(error).strip().partition(": ")[2]) from None


class MOTUS_OT_asset_give(Giving, bpy.types.Operator):
    bl_idname = "motus.asset_give"
    bl_label = "Give to Selected"
    bl_description = "Give the settings that the asset holds to all selected objects, in Pose Mode to all selected bones"

    @classmethod
    def check_offer(cls, context):
        if not (context.selected_pose_bones if context.mode == 'POSE' else context.selected_objects):
            raise Refused(tr("Select what shall be given these settings"))

    def invoke(self, context, _event):
        # A key or click on a different asset is left to others.
        return self.execute(context) if self.find_asset(context) else {'CANCELLED', 'PASS_THROUGH'}


classes = (MOTUS_OT_asset_give,)
