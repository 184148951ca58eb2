"""Panel with the motion drivers on the active object, its data and its materials."""

from ..core import native
from ..core.blender.datablocks import collection_of, label_of
from ..core.interface import panels, ui
from ..core.interface.view import offering
from ..core.measures import scene_time
from ..core.refusals import Refused
from . import expressions, history, places, preview
from .operators import MOTUS_OT_driver_add, MOTUS_OT_driver_copy, MOTUS_OT_driver_remove, MOTUS_OT_driver_write_out

_BUTTONS = (
    (MOTUS_OT_driver_add, 'PREFERENCES'),
    (MOTUS_OT_driver_copy, 'COPYDOWN'),
    (MOTUS_OT_driver_write_out, 'KEYFRAME'),
    (MOTUS_OT_driver_remove, 'X'),
)
"""Buttons beside a motion driver, with their icons."""


def _draw(layout, context):
    for found in places.of_object(context.object):
        _draw_driver(layout, context, found)
    offering.offer(layout.column()).operator(MOTUS_OT_driver_add.bl_idname, icon='ADD')


def _draw_driver(layout, context, found):
    keywords = expressions.read(found.expression)
    row = layout.row(align=True)
    place = label_of(found.datablock, found.path, found.index)
    label = place if found.datablock == context.object else f"{found.datablock.name}: {place}"
    row.label(text=label, icon='DRIVER', translate=False)
    for operator, icon in _BUTTONS:
        if operator is MOTUS_OT_driver_add and not keywords:
            continue  # the user has written or changed the expression
        button = row.operator(operator.bl_idname, text="", icon=icon)
        button.datablock, button.collection = found.datablock.name, collection_of(found.datablock)
        button.data_path, button.index = found.path, found.index
    sentence = _problem(found, keywords, context.scene) if keywords and native.module is not None else ""
    if sentence:
        ui.draw_message(layout, sentence, 'ERROR')


def _problem(found, keywords, scene):
    """Sentence that says why a motion driver only returns its value at rest; "" if the driver works. keywords: its parsed expression."""
    try:
        preview.sample(keywords, [0.0], scene_time.seconds(scene, 1.0))
        if expressions.BY_IDENTIFIER[keywords["function"]].follows:
            history.check(found.holder, keywords["source"], keywords["source_index"])
    except (ValueError, Refused) as error:
        return str(error)
    return ""


PANEL = panels.SystemPanel(
    name="drivers",
    prefix="MOTUS_PT_drivers",
    label="Motion Drivers",
    editors={"": ui.Sidebar},
    suits=lambda obj: True,
    draw=_draw,
    is_used=lambda obj: bool(places.of_object(obj)),
    adders=("motus.driver_add",),
)
classes = panels.classes(PANEL)
