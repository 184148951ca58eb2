"""Panel with the button that hands the file over."""

from ..core.interface import panels, ui
from .operators import MOTUS_OT_hand_over


def _draw(layout, _context):
    column = layout.column()
    column.operator_context = 'INVOKE_DEFAULT'
    column.operator(MOTUS_OT_hand_over.bl_idname, icon='EXPORT')


PANEL = panels.SystemPanel(
    name="hand_over",
    prefix="MOTUS_PT_hand_over",
    label="Hand Over",
    editors={"": ui.Sidebar},
    owner=lambda context: context.scene,
    suits=lambda scene: True,
    draw=_draw,
    adders=(MOTUS_OT_hand_over.bl_idname,),
)
classes = panels.classes(PANEL)
