"""Panel classes of a system, generated from its declaration: settings first, then read-outs, actions last, Refresh in a menu.

If the object does not use the system there is no panel; the panel *Add*, one for all systems, adds the system. If the system is baked, its
panel has a box with the baked frames, its settings are greyed out, and it has no read-outs.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bpy

from .. import native
from ..bake import state
from ..declare import described, page, registered, title
from ..translations import tr
from . import bone_entries, manual, overlay, ui
from .view import first_steps, offering

COPY, PASTE, KEEP, REFRESH = "motus.settings_copy", "motus.settings_paste", "motus.asset_keep", "motus.refresh"


@dataclass(frozen=True)
class Part:
    """Declaration of a sub-panel of a system's panel. name: end of the class name. label: title.

    draw(layout, context): draws the content. is_open: whether the sub-panel is open at first. is_shown(context): whether the sub-panel is
    shown; None shows it always. draw_header(layout, context): draws in the header before the label. is_action: whether the sub-panel is
    placed behind the read-outs.
    """

    name: str
    label: str
    draw: Callable
    is_open: bool = False
    is_shown: Callable | None = None
    draw_header: Callable | None = None
    is_action: bool = False


@dataclass(frozen=True, eq=False)
class SystemPanel:
    """Declaration of a system's panel, from which a panel class is generated for each editor.

    name: of the system. prefix: start of the class names. label: title of the panel. translation_context: of the label. editors: {end of a
    class name: mixin that sets space and region}. labels: {end of a class name: title} of editors with a different title.
    owner(context): returns the object or scene whose settings are shown, by default the active object. suits(owner): whether the system can
    be used on the owner. is_used(owner): whether the system is set up on the owner; if is_used is None, the panel is shown for every
    suitable owner, and is closed at first. has_settings(owner): whether all parts of the panel are drawn; otherwise only `draw` is called.
    has_settings None draws all parts.
    draw, readouts, actions: functions of (layout, context). parts: the Parts, each a sub-panel. presets: preset panel, opened from the
    header. adders: operators that add the system. draw_add(layout, context): draws the buttons that add the system, in place of `adders`.
    The buttons do not depend on the selection. draw_about(layout, context): draws facts about the active object below the buttons of all
    systems.
    refresh: operator that sets the system up again, usually REFRESH; "" for none.
    """

    name: str
    prefix: str
    label: str
    editors: dict
    suits: Callable
    draw: Callable
    owner: Callable = lambda context: context.object
    is_used: Callable | None = None
    has_settings: Callable | None = None
    parts: tuple = ()
    readouts: Callable | None = None
    actions: Callable | None = None
    refresh: str = ""
    presets: Any = None
    adders: tuple = ()
    draw_add: Callable | None = None
    draw_about: Callable | None = None
    translation_context: str = "*"
    labels: dict = field(default_factory=dict)

    def is_shown(self, context):
        """Whether the panel is shown for its owner in the context, such as the active object."""
        owner = self.owner(context)
        return owner is not None and self.suits(owner) and (self.is_used is None or bool(self.is_used(owner)))

    def shows_settings(self, context):
        """Whether all parts of the panel are drawn, not only its message about the native module or the result of `draw`.

        They are drawn if the native module can be used, the panel is shown, and its owner in the context has settings of its own.
        """
        if native.module is None or not self.is_shown(context):
            return False
        return self.has_settings is None or bool(self.has_settings(self.owner(context)))

    def baked_frames(self, context):
        """(first, last) frame, as text, of the system's baked motion of the context's owner; None if the motion is not baked.

        The owner's motion may also be baked with its leader, the object whose settings drive it.
        """
        return state.frames(registered[self.name], self.owner(context))


def classes(panel):
    """Generate the panel classes of a system for all editors, each before its sub-panels, and the menus that panels open."""
    found = []
    for end, editor in panel.editors.items():
        found += _of_editor(panel, end, editor)
    return tuple(found)


def _of_editor(panel, end, editor):
    name = panel.prefix + end
    menu = [_menu(panel, f"{name.replace('_PT_', '_MT_')}_more")] if panel.refresh else []
    own = {"bl_options": {'DEFAULT_CLOSED'} if panel.is_used is None else set(), "bl_label": panel.labels.get(end, panel.label)}
    found = [*menu, type(name, (_main(panel), editor, bpy.types.Panel), own | _common(panel))]
    for part, mixin in _parts(panel, *menu):
        found.append(type(f"{name}_{part}", (mixin, editor, bpy.types.Panel), {"bl_parent_id": name} | _common(panel)))
    return found


def _parts(panel, menu=None):
    """List of (end of the class name, mixin) of a panel's sub-panels, in the order in which they are drawn."""
    settings = [part for part in panel.parts if not part.is_action]
    tools = [part for part in panel.parts if part.is_action]
    return [
        *((part.name, _part(panel, part)) for part in settings),
        *([("readouts", _readouts(panel))] if panel.readouts else ()),
        *((part.name, _part(panel, part)) for part in tools),
        *([("actions", _actions(panel, menu))] if panel.actions else ()),
    ]


def _common(panel):
    return {"__module__": __name__, "of_system": panel}


def _menu(panel, name):
    """Generate the menu *More* of a panel: what copies the system's settings, Refresh, and the manual."""

    def draw(self, context):
        layout = offering.offer(self.layout)
        if getattr(registered[panel.name], "copied_settings", ()):
            for operator, icon in ((COPY, 'COPYDOWN'), (PASTE, 'PASTEDOWN'), (KEEP, 'ASSET_MANAGER')):
                button = layout.operator(operator, icon=icon)
                button.system, button.object = panel.name, panel.owner(context).name
            layout.operator(bone_entries.TO_SELECTED).system = panel.name
            layout.separator()
        button = layout.operator(panel.refresh, icon='FILE_REFRESH')
        if panel.refresh == REFRESH:
            button.system = panel.name
        layout.operator(manual.MOTUS_OT_manual.bl_idname, icon='HELP').page = page(registered[panel.name])

    return type(name, (bpy.types.Menu,), {"bl_label": "More", "draw": draw, **_common(panel)})


def _main(panel):
    class Main:
        bl_translation_context = panel.translation_context

        @classmethod
        def poll(cls, context):
            return panel.is_shown(context)

        def draw_header_preset(self, context):
            row = self.layout.row(align=True)
            has_presets = bool(panel.presets and panel.shows_settings(context))
            if has_presets:
                panel.presets.draw_panel_header(row)
            manual.draw_button(self, row, page(registered[panel.name]), beside=has_presets)

        def draw(self, context):
            draw(panel, self.layout, context)

    return Main


def draw(panel, layout, context):
    """Draw the main part of a system's panel: an error of the native module, the box of baked frames, the settings."""
    if not ui.draw_native_status(layout):
        return
    frames = panel.baked_frames(context)
    if frames:
        _draw_baked(layout, panel, frames)
    column = layout.column()
    column.enabled = frames is None
    panel.draw(column, context)


def _draw_baked(layout, panel, frames):
    box = layout.box().column()
    text = bpy.app.translations.pgettext_iface("Baked {first}-{last}")
    box.label(text=text.format(first=frames[0], last=frames[1]), icon='KEYFRAME', translate=False)
    box.operator("motus.unbake", icon='LOOP_BACK').system = panel.name


def _part(panel, part):
    class Sub:
        bl_label = part.label
        bl_options = set() if part.is_open else {'DEFAULT_CLOSED'}

        @classmethod
        def poll(cls, context):
            return panel.shows_settings(context) and (part.is_shown is None or bool(part.is_shown(context)))

        def draw(self, context):
            self.layout.enabled = panel.baked_frames(context) is None
            part.draw(self.layout, context)

    if part.draw_header:
        Sub.draw_header = lambda self, context: part.draw_header(self.layout, context)
    return Sub


class _WithoutHeader:
    """Mixin of sub-panels without a header, which look like a continuation of the panel above them."""

    bl_label = ""  # a popover would show the label
    bl_options = {'HIDE_HEADER'}


def _readouts(panel):
    class Readouts(_WithoutHeader):
        @classmethod
        def poll(cls, context):
            # A baked system does not run its solver, so there are no results to show.
            return panel.shows_settings(context) and panel.baked_frames(context) is None

        def draw(self, context):
            panel.readouts(self.layout, context)

    return Readouts


def _actions(panel, menu):
    class Actions(_WithoutHeader):
        @classmethod
        def poll(cls, context):
            return panel.shows_settings(context)

        def draw(self, context):
            self.layout.enabled = panel.baked_frames(context) is None
            row = self.layout.row()
            panel.actions(row.column(), context)
            if menu:
                row.menu(menu.__name__, text="", icon='DOWNARROW_HLT')

    return Actions


class _Adding:
    """Panel *Add*: the name of the active object, and the buttons that add systems.

    The buttons do not depend on the selection, so that each keeps its place. A button that does not suit the selection is greyed out, and
    its tooltip says why.
    """

    def draw_header_preset(self, _context):
        manual.draw_button(self, self.layout, manual.START)

    def draw(self, context):
        layout = self.layout
        if not ui.draw_native_status(layout):
            return
        if first_steps.is_shown(context):
            _draw_first_steps(layout)
        if context.object is None:
            layout.label(text="Nothing is selected", icon='INFO')
        else:
            layout.label(text=context.object.name, icon='OBJECT_DATA', translate=False)
        column = offering.offer(layout.column())
        for system in registered.values():
            for panel in described(system):
                draw_add(panel, column, context)
        for name in menus_of_scenes:
            column.menu(name, icon='SCENE_DATA')
        for panel in (panel for system in registered.values() for panel in described(system)):
            if panel.draw_about and context.object is not None:
                panel.draw_about(column, context)


def _draw_first_steps(layout):
    row = layout.row()
    sentence = tr("Select an object and choose below what it shall do, or build an example with Demo Scene at the end")
    ui.draw_message(row, sentence, 'INFO', beside=ui.BUTTON)
    row.operator(first_steps.MOTUS_OT_hide_first_steps.bl_idname, text="", icon='X', emboss=False)


menus_of_scenes = []
"""Names of menus, at the end of the panel *Add*, that create whole scenes. Registration fills this list."""


class MOTUS_PT_sidebar(_Adding, ui.Sidebar, bpy.types.Panel):
    bl_label = "Add"
    bl_translation_context = "Operator"  # in this context Blender's Spanish translation has the verb of Blender's buttons
    bl_order = 90


class _Overlay:
    """Panel *Overlay*: switches of the viewport overlays of all systems, first of the systems that the active object uses."""

    def draw_header(self, context):
        self.layout.prop(context.scene.motus, "show_overlay", text="")

    def draw(self, context):
        shown = context.scene.motus
        layout = self.layout
        layout.active = shown.show_overlay
        drawn = [system for system in registered.values() if system.overlay is not None]
        used = [system for system in drawn if is_used(system, context)]
        for system in used:
            _draw_switches(layout.column(), shown, system)
        if used:
            layout.separator()
        for system in drawn:
            if system not in used:
                _draw_switches(layout.column(), shown, system)


class MOTUS_PT_overlay(_Overlay, ui.Sidebar, bpy.types.Panel):
    bl_label = "Overlay"
    bl_order = 100
    bl_options = {'DEFAULT_CLOSED'}


def _draw_switches(column, shown, system):
    name, (label, label_context) = overlay.switch_of(system), title(system)
    row = column.row(align=True)
    row.prop(shown, name, text="")
    row.label(text=label, text_ctxt=label_context)
    switches = column.column(align=True)
    switches.active = getattr(shown, name)
    for switch in overlay.switches_of(system):
        row = switches.row()
        row.separator(factor=2.0)
        row.prop(shown, switch.name)


def is_used(system, context):
    """Whether the owner in the context, such as the active object, uses a system. Always False for tools, whose panels have no is_used."""
    return any(panel.is_used and panel.is_shown(context) for panel in described(system))


def draw_add(panel, layout, context):
    """Draw the buttons that add a system to the owner in the context, such as the active object. panel: the SystemPanel."""
    if panel.draw_add:
        panel.draw_add(layout, context)
        return
    layout.operator_context = 'INVOKE_DEFAULT'
    for identifier in panel.adders:
        layout.operator(identifier, icon='ADD')


classes_of_core = (MOTUS_PT_sidebar, MOTUS_PT_overlay)
