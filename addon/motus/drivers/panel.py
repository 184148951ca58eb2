"""The motion drivers of the active object, in the sidebar."""

import bpy

from ..core import native, ui
from . import expressions, places, preview
from .operators import MOTUS_OT_driver_add, MOTUS_OT_driver_remove


class MOTUS_PT_drivers(ui.Sidebar, bpy.types.Panel):
    bl_label = "Motion Drivers"
    bl_order = 40

    @classmethod
    def poll(cls, context):
        return context.object is not None and bool(places.of_object(context.object))

    def draw(self, context):
        for found in places.of_object(context.object):
            _draw_driver(self.layout, context.object, found)


def _draw_driver(layout, obj, found):
    keywords = expressions.read(found.expression)
    row = layout.row(align=True)
    place = found.path if found.index < 0 else f"{found.path}[{found.index}]"
    label = place if found.datablock == obj else f"{found.datablock.name}: {place}"
    row.label(text=label, icon='DRIVER', translate=False)
    for operator, icon in ((MOTUS_OT_driver_add, 'PREFERENCES'), (MOTUS_OT_driver_remove, 'X')):
        if operator is MOTUS_OT_driver_add and not keywords:
            continue  # written by hand
        button = row.operator(operator.bl_idname, text="", icon=icon)
        if found.datablock == obj:
            button.object = obj.name
        else:
            button.id_type, button.id_name = places.type_of(found.datablock), found.datablock.name
        button.data_path, button.index = found.path, found.index
    if keywords and native.module is not None:
        try:
            preview.sample(keywords, [0.0])
        except ValueError as error:
            ui.draw_message(layout, str(error), 'ERROR')


classes = (MOTUS_PT_drivers,)
