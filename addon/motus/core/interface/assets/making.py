"""The operator that keeps settings as an asset, in the current file or in one of the user's asset libraries."""

import bpy

from ...settings import copied
from ...translations import tr
from .. import panels
from ..any_system.copying import found_item, found_system
from ..operators import Operator, object_keyword
from . import catalogues, held, libraries, picture

WIDTH = 340
PICTURES = (
    ('OWNER', "Object", "Object that has the settings, from the side that the 3D viewport shows"),
    ('VIEW', "Viewport", "Middle of the 3D viewport, as it is seen"),
    ('NONE', "None", "No picture"),
)


class MOTUS_OT_asset_keep(Operator, bpy.types.Operator):
    bl_idname = panels.KEEP
    bl_label = "Keep as Asset"
    bl_description = "Keep the settings that are shown, and their keys, as an asset with a picture: a preset of your own"
    bl_options = {'UNDO'}  # no redo panel: a file that is written stays
    for_scripts = ("picture",)

    object: object_keyword("Name of the object; empty takes the active one")
    system: bpy.props.StringProperty(
        name="System", description="Name of the system whose settings are kept, such as dynamics", options={'SKIP_SAVE'}
    )
    entry: bpy.props.StringProperty(
        name="Entry", description="Name of the entry in the system's list; empty takes the shown one", options={'SKIP_SAVE'}
    )
    name: bpy.props.StringProperty(name="Name", description="Name of the asset; empty takes that of the system", options={'SKIP_SAVE'})
    library: bpy.props.StringProperty(
        name="Asset Library", description="Name of the asset library that the asset is written into; empty keeps it in this file"
    )
    picture: bpy.props.EnumProperty(name="Picture", description="Subject of the asset's picture", items=PICTURES, default='OWNER')

    def invoke(self, context, _event):
        if not self.name:
            self.name = self._label(found_system(self.system))
        return context.window_manager.invoke_props_dialog(self, width=WIDTH)

    def draw_below(self, context):
        column = self.layout.column()
        column.prop(self, "name")
        column.prop_search(self, "library", context.preferences.filepaths, "asset_libraries", icon='ASSET_MANAGER')
        column.prop(self, "picture")

    def run(self, context):
        system = found_system(self.system)
        item = found_item(context, system, self.object, self.entry)
        text = copied.as_text(copied.take(system, item))
        name = self.name.strip() or self._label(system)
        drawn = None if self.picture == 'NONE' else picture.draw(context, item.id_data, self.picture == 'OWNER')
        holder = held.make(name, text, system, catalogues.identifier(system))
        if drawn is not None:
            picture.give(holder, drawn)
        self.report({'INFO'}, tr("Kept as asset: {asset}").format(asset=self._write(context, holder, system) if self.library else name))
        if drawn is None and self.picture != 'NONE':
            self.report({'INFO'}, tr("The asset has no picture, since there is no 3D viewport to draw one"))

    @staticmethod
    def _label(system):
        return bpy.app.translations.pgettext_iface(system.label)

    def _write(self, context, holder, system):
        """Write the asset into a library, and remove it from the current file; returns the path of the library's file."""
        try:
            folder = libraries.folder_of(context, self.library)
            path = libraries.claim(folder, holder.name)
            holder.asset_data.catalog_id = catalogues.entered(system, folder)
            libraries.write(holder, path)
        finally:
            bpy.data.objects.remove(holder)
        libraries.show_new(context)
        return path


classes = (MOTUS_OT_asset_keep,)
