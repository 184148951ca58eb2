"""Register all classes, properties, handlers and menus of the add-on in a fixed order; unregister them in reverse order."""

import bpy

from . import bake, declare, keeping, settings, translations, wiring
from .blender import handlers
from .evaluated import read_keys, shares
from .file import deleted
from .interface import manual, menus, overlay, panels, ui
from .interface.any_system import baking, copying, refreshing
from .interface.assets import dragging as asset_dragging, giving, making, shelf
from .interface.tracks import operators as track_operators, panel as track_panel
from .interface.view import first_steps, playback, preferences, viewports

_undo = []
_FORGETTING = handlers.Forgetting(keeping.forget_file, keeping.forget_all)


def register(systems, languages, extra_classes=(), extra_add_menu=()):
    """Register all systems and the classes that they share. If an error is raised, everything registered so far is unregistered.

    languages: {language: {context: {English: translation}}}. extra_classes: further classes for bpy.utils.register_class. extra_add_menu:
    operators, or names of menus, at the end of the Add menu.
    """
    try:
        _register(systems, languages, tuple(extra_classes), tuple(extra_add_menu))
    except Exception:
        unregister()
        raise


def unregister():
    """Unregister everything that register() has registered, in reverse order."""
    while _undo:
        handlers.take_back(_undo.pop())


def _register(systems, languages, extra_classes, extra_add_menu):
    # Property groups are registered before the groups that point to them, and all of them before the panels that draw them.
    _register_classes(settings.classes)
    for one in systems:
        declare.registered[one.name] = one
        _undo.append(lambda name=one.name: declare.registered.pop(name))
        _register_classes(one.classes)
    _register_classes(
        overlay.classes
        + ui.classes
        + bake.classes
        + baking.classes
        + refreshing.classes
        + preferences.classes
        + first_steps.classes
        + track_operators.classes
        + panels.classes_of_core
        + copying.classes
        + making.classes
        + giving.classes
        + asset_dragging.classes
        + menus.classes
        + manual.classes
        + extra_classes
    )
    _register_settings(systems)
    _call(deleted.register, deleted.unregister)
    _call(shares.register, shares.unregister)
    _call(wiring.register, wiring.unregister)
    _call(read_keys.register, read_keys.unregister)
    _call(track_panel.register, track_panel.unregister)
    _call(_FORGETTING.register, _FORGETTING.unregister)
    _call(viewports.register, viewports.unregister)
    _call(overlay.register, overlay.unregister)
    _call(lambda: None, playback.unregister)  # drawing a read-out adds the handler
    _call(lambda: menus.register(systems, extra_add_menu), menus.unregister)
    _call(manual.register, manual.unregister)
    _call(shelf.register, shelf.unregister)
    _call(lambda: panels.menus_of_scenes.extend(extra_add_menu), panels.menus_of_scenes.clear)
    _call(lambda: translations.register(languages), translations.unregister)
    for one in systems:
        for extra in one.extras:
            _call(extra.register, extra.unregister)


def _call(do, undo):
    do()
    _undo.append(undo)


def _register_classes(classes):
    for cls in classes:
        bpy.utils.register_class(cls)
        _undo.append(lambda cls=cls: bpy.utils.unregister_class(cls))


def _register_settings(systems):
    """Register the property groups Object.motus and Scene.motus.

    Object.motus holds one property group for each system, and what unbaking needs. Scene.motus holds the switches of the viewport overlay
    and the settings of tools.
    """
    annotations = {
        one.name: bpy.props.PointerProperty(type=one.settings, override={'LIBRARY_OVERRIDABLE'})
        for one in systems
        if one.settings is not None
    }
    annotations["bake"] = bpy.props.PointerProperty(type=bake.MOTUS_PG_bake)
    group = type("MOTUS_PG_object", (bpy.types.PropertyGroup,), {"__annotations__": annotations})
    _register_classes((group,))
    for one in systems:
        if one.scene_settings is not None:
            _register_pointer(overlay.MOTUS_PG_scene, one.name, one.scene_settings)
        for name, switch in overlay.properties_of(one).items():
            _register_property(overlay.MOTUS_PG_scene, name, switch)
    for owner, kind in ((bpy.types.Object, group), (bpy.types.Scene, overlay.MOTUS_PG_scene)):
        _register_pointer(owner, "motus", kind, name="Motus", override={'LIBRARY_OVERRIDABLE'})


def _register_pointer(owner, attribute, kind, **options):
    _register_property(owner, attribute, bpy.props.PointerProperty(type=kind, **options))


def _register_property(owner, attribute, prop):
    setattr(owner, attribute, prop)
    _undo.append(lambda: delattr(owner, attribute))
