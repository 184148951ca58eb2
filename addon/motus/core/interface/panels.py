"""A system's panels, made of what it declares: settings first, then read-outs, actions last, Refresh in a menu.

Where the object does not use the system there is no panel; a short one for all systems adds it. What is baked
looks baked: a box with the frames, settings that are grey, and no read-outs.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bpy

from .. import native
from ..bake import state
from ..declare import described, registered, title
from . import operators, overlay, ui

REFRESH = "motus.refresh"


@dataclass(frozen=True)
class Part:
    """A sub-panel. draw(layout, context); draw_header(layout, context) draws before the label.

    is_action: it stands behind the read-outs.
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

    name: of the system. prefix: start of the class names. editors: {end of the class name: mixin that sets space and region}.
    labels: {end of the class name: label} of editors with a label of their own.
    owner(context): the object or scene whose settings are shown, by default the active object. suits(owner): whether the system can
    be used on it. is_used(owner): whether the system is set up on it. Without is_used the panel is shown for every suitable owner,
    and is closed at first.
    has_settings(owner): whether all parts of the panel are drawn; otherwise only `draw` is called.
    draw, readouts, actions: functions of (layout, context). adders: operators that add the system, or a function
    draw_add(layout, context) that draws their buttons; these do not depend on the selection.
    draw_about(layout, context): draws facts about the active object below the buttons of all adders.
    refresh: operator that sets the system up again, usually REFRESH.
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
        """Whether the context's owner has the panel."""
        owner = self.owner(context)
        return owner is not None and self.suits(owner) and (self.is_used is None or bool(self.is_used(owner)))

    def shows_settings(self, context):
        """Whether the owner's own settings, and with them all parts, are drawn."""
        if native.module is None or not self.is_shown(context):
            return False
        return self.has_settings is None or bool(self.has_settings(self.owner(context)))

    def baked_frames(self, context):
        """(first, last) of what of the system is baked on the context's owner, or on its leader; None without."""
        return state.frames(registered[self.name], self.owner(context))


def classes(panel):
    """The panels of a system in all editors, each before its sub-panels, and the menus that they open."""
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
    """(end of the class's name, mixin) of the sub-panels, in their order."""
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
    """Menu *More* of a panel, for what is seldom needed."""

    def draw(self, _context):
        button = operators.offer(self.layout).operator(panel.refresh, icon='FILE_REFRESH')
        if panel.refresh == REFRESH:
            button.system = panel.name

    return type(name, (bpy.types.Menu,), {"bl_label": "More", "draw": draw, **_common(panel)})


def _main(panel):
    class Main:
        bl_translation_context = panel.translation_context

        @classmethod
        def poll(cls, context):
            return panel.is_shown(context)

        def draw_header_preset(self, context):
            if panel.presets and panel.shows_settings(context):
                panel.presets.draw_panel_header(self.layout)

        def draw(self, context):
            draw(panel, self.layout, context)

    return Main


def draw(panel, layout, context):
    """The first part of a system's panel."""
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
    """Mixin of sub-panels that go on below the settings."""

    bl_label = ""  # a popover would show it
    bl_options = {'HIDE_HEADER'}


def _readouts(panel):
    class Readouts(_WithoutHeader):
        @classmethod
        def poll(cls, context):
            # What is baked is not computed any more.
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
    """Panel *Add*: what is selected, and the buttons of all systems.

    The buttons are the same whatever is selected, so that each keeps its place; those that do not suit are grey, and say why.
    """

    def draw(self, context):
        layout = self.layout
        if not ui.draw_native_status(layout):
            return
        if context.object is None:
            layout.label(text="Nothing is selected", icon='INFO')
        else:
            layout.label(text=context.object.name, icon='OBJECT_DATA', translate=False)
        column = operators.offer(layout.column())
        for system in registered.values():
            for panel in described(system):
                draw_add(panel, column, context)
        for name in menus_of_scenes:
            column.menu(name, icon='SCENE_DATA')
        for panel in (panel for system in registered.values() for panel in described(system)):
            if panel.draw_about and context.object is not None:
                panel.draw_about(column, context)


menus_of_scenes = []
"""Names of menus, at the end of the panel *Add*, that make whole scenes; set by registration."""


class MOTUS_PT_sidebar(_Adding, ui.Sidebar, bpy.types.Panel):
    bl_label = "Add"
    bl_translation_context = "Operator"  # where Blender's Spanish has the verb that its buttons have
    bl_order = 90


class _Overlay:
    """Panel *Overlay*: switches of what the viewport shows, first those of systems that the active object uses."""

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
    """Whether the context's owner uses a system; tools, which are there for all that suits, are not used."""
    return any(panel.is_used and panel.is_shown(context) for panel in described(system))


def draw_add(panel, layout, context):
    """The buttons that add a system to the context's owner."""
    if panel.draw_add:
        panel.draw_add(layout, context)
        return
    layout.operator_context = 'INVOKE_DEFAULT'
    for identifier in panel.adders:
        layout.operator(identifier, icon='ADD')


classes_of_core = (MOTUS_PT_sidebar, MOTUS_PT_overlay)
