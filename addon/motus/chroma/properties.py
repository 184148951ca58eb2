"""Scene.motus.chroma: which view is shown, what was measured, and what the scene was before the key."""

import bpy

from ..core.file.pointers import to_object
from ..core.settings import OVERRIDABLE
from . import compositor, group

VIEWS = (
    (group.COMPOSITE, "Composite", "The subject over the background"),
    (group.MATTE, "Matte", "White where the subject is opaque, black where it is clear"),
    (group.STATUS, "Status", "Black what is clear, white what is opaque, and all between in grey"),
    (group.SOURCE, "Source", "The footage as it is"),
)
UNDERNEATH = (
    ('RENDER', "Render", "What the compositor has shown before: the render, with all that its nodes do"),
    ('FOOTAGE', "Footage", "Another clip or image"),
    ('NOTHING', "Nothing", "The picture stays transparent"),
)
_KINDS = tuple(identifier for identifier, _, _ in UNDERNEATH)


def _view(settings):
    key = compositor.key_of(settings.id_data)
    shown = group.view(key.node_tree) if key else None
    return group.VIEWS.index(shown) if shown else 0


def _show(settings, value):
    key = compositor.key_of(settings.id_data)
    if key:
        group.show(key.node_tree, group.VIEWS[value])


def _underneath(settings):
    return _KINDS.index(compositor.underneath(settings.id_data)) if compositor.key_of(settings.id_data) else 0


def _lay_underneath(settings, value):
    if compositor.key_of(settings.id_data) and value != _underneath(settings):
        compositor.lay_underneath(settings.id_data, _KINDS[value], settings)


def _measured(name, description):
    return bpy.props.FloatProperty(name=name, description=description, min=0.0, options=set(), override=OVERRIDABLE)


def _before(kind, name, **more):
    return kind(name=name, description="What the scene had before the key", options=set(), **more)


class MOTUS_PG_chroma(bpy.types.PropertyGroup):
    # Not kept here, but as the link in the group, which undo and other scenes share.
    view: bpy.props.EnumProperty(
        name="View", description="What the compositor shows", items=VIEWS, get=_view, set=_show, options=set())
    underneath: bpy.props.EnumProperty(
        name="Underneath", description="What shows where the screen was", items=UNDERNEATH, get=_underneath, set=_lay_underneath,
        options=set())
    plane: to_object('MESH', name="Plane", description="Plane before the camera that shows the key in the viewport")
    share: _measured("Screen", "Share of the picture that the screen fills")
    luminance_spread: _measured("Unevenness", "Spread of the screen's luminance, over its median")
    chroma_spread: _measured("Color Noise", "Spread of the screen's chromaticity")
    spill: _measured("Spill", "Light of the screen on the subject, 1 for as much as on the screen itself")
    is_tree_made: bpy.props.BoolProperty(
        name="Tree Made", description="The compositor's nodes were made for the key", options=set())
    is_switched_on: bpy.props.BoolProperty(
        name="Nodes Switched On", description="The compositor was switched on for the key", options=set())
    before_node: _before(bpy.props.StringProperty, "Node Before")
    before_socket: _before(bpy.props.StringProperty, "Socket Before")
    is_scene_set: bpy.props.BoolProperty(
        name="Scene Set", description="The scene was given the footage's size, frames and colours", options=set())
    before_resolution: _before(bpy.props.IntVectorProperty, "Resolution Before", size=3, min=1)
    before_aspect: _before(bpy.props.FloatVectorProperty, "Pixel Aspect Before", size=2, min=1.0)
    before_frames: _before(bpy.props.IntVectorProperty, "Frames Before", size=2)
    before_fps: _before(bpy.props.IntProperty, "Frame Rate Before", min=1)
    before_fps_base: _before(bpy.props.FloatProperty, "Frame Rate Base Before", min=1e-5)
    before_transform: _before(bpy.props.StringProperty, "View Transform Before")
    before_look: _before(bpy.props.StringProperty, "Look Before")
