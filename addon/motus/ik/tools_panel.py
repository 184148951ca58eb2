"""Part of the IK panel with buttons of the tools for a chain, and the result of the chain's last check."""

from ..core.interface import ui
from ..core.translations import tr
from . import status
from .checking import results as check_results
from .shown import shown_entry

ICONS = {'NONE': 'CHECKMARK', 'ANIMATED': 'INFO'}
"""{result of a check: icon} of the results that are no errors."""


def draw(layout, context):
    """Draw the buttons of the tools for the shown chain, and what its last check has found."""
    rig, entry = context.object, shown_entry(context)
    column = layout.column(align=True)
    column.operator("motus.ik_drag", icon='VIEW_PAN').object = rig.name
    _of_chain(column.operator("motus.ik_switch_target", icon='UV_SYNC_SELECT'), rig, entry)
    column = layout.column(align=True)
    for name, icon in (("motus.ik_match_fk", 'CON_KINEMATIC'), ("motus.fk_match_ik", 'BONE_DATA'), ("motus.ik_check", 'VIEWZOOM')):
        _of_chain(column.operator(name, icon=icon), rig, entry)
    sentence = check_results.sentence(entry, lambda value: status.length(context, value))
    if sentence and is_outdated(context, rig, entry):
        ui.draw_message(layout, tr("Something has changed since the last check: check again"), 'INFO')
    elif sentence:
        ui.draw_message(layout, sentence, ICONS.get(entry.check_reason, 'ERROR'))


def is_outdated(context, rig, entry):
    """Whether the result of an entry's last check does not hold any more at the present frame."""
    if context.scene.frame_subframe != 0.0:
        return False
    report = status.report(rig, entry.name, context.view_layer.depsgraph)
    if report is None and not status.is_unwired(rig, entry):
        return False  # Blender 5 has copied the rig anew, and has not solved it yet
    return check_results.contradicts(entry, context.scene.frame_current, status.fault(report, entry)[1])


def _of_chain(button, rig, entry):
    button.object, button.bone = rig.name, entry.name
    return button
