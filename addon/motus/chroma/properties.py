"""Settings of a scene's chroma key in Scene.motus.chroma: shown view, measured values, and the scene settings to be restored."""

import bpy

from ..core.file.pointers import pointed, to_object
from ..core.settings import OVERRIDABLE
from . import compositor, group, settings

VIEWS = (
    (group.COMPOSITE, "Composite", "The subject over the background"),
    (group.MATTE, "Matte", "White where the subject is opaque, black where it is clear"),
    (group.STATUS, "Status", "Black what is clear, white what is opaque, and all between in grey"),
    (group.SOURCE, "Source", "The footage as it is"),
)
UNDERNEATH = (
    ('RENDER', "Render", "The picture that the compositor showed before the key: the render, with all that its nodes do"),
    ('FOOTAGE', "Footage", "Another clip or image lies underneath"),
    ('NOTHING', "Nothing", "The picture stays transparent"),
)
LIMITS = (
    ('MAXIMUM', "Maximum", "The larger of the two other channels: yellow and cyan stay as they are"),
    ('DOUBLE', "Double", "The average of the two other channels in which the larger counts twice"),
    ('AVERAGE', "Average", "The average of the two other channels, which takes most away"),
)
_KINDS = tuple(identifier for identifier, _, _ in UNDERNEATH)


def _view(noted):
    key = compositor.key_of(noted.id_data)
    shown = group.view(key.node_tree) if key else None
    return group.VIEWS.index(shown) if shown else 0


def _show(noted, value):
    compositor.show(noted.id_data, group.VIEWS[value])


def _underneath(noted):
    return _KINDS.index(compositor.underneath(noted.id_data)) if compositor.key_of(noted.id_data) else 0


def _lay_underneath(noted, value):
    if compositor.key_of(noted.id_data) and value != _underneath(noted):
        compositor.lay_underneath(noted.id_data, _KINDS[value], noted)


def _limit(noted):
    key = compositor.active_key(noted.id_data)
    value = settings.value(key, "limit") if key else 0.0
    return min(range(len(LIMITS)), key=lambda index: abs(settings.LIMITS[LIMITS[index][0]] - value))


def _set_limit(noted, value):
    key = compositor.active_key(noted.id_data)
    if key:
        settings.assign(key, settings.BY_KEYWORD["limit"], settings.LIMITS[LIMITS[value][0]])


def _play_background(noted, _context):
    node, image = compositor.node_of(noted.id_data, compositor.BACKGROUND), pointed(noted, "background")
    if node is not None and node.image != image:
        compositor.show_image(noted.id_data, node, image)


def _measured(name, description):
    return bpy.props.FloatProperty(name=name, description=description, min=0.0, options={'HIDDEN'}, override=OVERRIDABLE)


def _before(kind, name, **more):
    return kind(name=name, description="Value that the scene had before the key", options={'HIDDEN'}, **more)


class MOTUS_PG_chroma(bpy.types.PropertyGroup):
    # The view is stored as a link in the node group, so that undo and copied scenes stay consistent.
    view: bpy.props.EnumProperty(
        name="View", description="Picture that the compositor shows", items=VIEWS, get=_view, set=_show, options=set()
    )
    underneath: bpy.props.EnumProperty(
        name="Underneath",
        description="What lies behind the subject, where the screen was",
        items=UNDERNEATH,
        get=_underneath,
        set=_lay_underneath,
        options=set(),
    )
    despill_limit: bpy.props.EnumProperty(
        name="Despill Limit",
        description="What limits the screen's green or blue on the subject, from the two other colors of each pixel",
        items=LIMITS,
        get=_limit,
        set=_set_limit,
        options=set(),
    )
    background: bpy.props.PointerProperty(
        type=bpy.types.Image, name="Background", description="The clip or image that lies underneath", update=_play_background
    )
    active_key: bpy.props.IntProperty(
        name="Key", description="Index of the key that the panel shows", min=0, options={'HIDDEN'}, override=OVERRIDABLE
    )
    gap: bpy.props.StringProperty(
        name="Gap", description="Pictures that are missing in sequences, and the frames in which they are", options={'HIDDEN'}
    )
    plane: to_object('MESH', name="Plane", description="Plane before the camera that shows the key in the viewport", options={'HIDDEN'})
    share: _measured("Screen", "Share of the picture that the screen fills")
    luminance_spread: _measured("Unevenness", "Spread of the screen's luminance, over its median")
    chroma_spread: _measured("Color Noise", "Spread of the screen's chromaticity")
    spill: _measured("Spill", "Light of the screen on the subject, 1 for as much as on the screen itself")
    is_tree_made: bpy.props.BoolProperty(name="Tree Made", description="The compositor's nodes were made for the key", options={'HIDDEN'})
    is_switched_on: bpy.props.BoolProperty(
        name="Nodes Switched On", description="The compositor was switched on for the key", options={'HIDDEN'}
    )
    before_node: _before(bpy.props.StringProperty, "Node Before")
    before_socket: _before(bpy.props.StringProperty, "Socket Before")
    is_scene_set: bpy.props.BoolProperty(
        name="Scene Set", description="The scene was given the footage's size, frames and colours", options={'HIDDEN'}
    )
    before_resolution: _before(bpy.props.IntVectorProperty, "Resolution Before", size=3, min=1)
    before_aspect: _before(bpy.props.FloatVectorProperty, "Pixel Aspect Before", size=2, min=1.0)
    before_frames: _before(bpy.props.IntVectorProperty, "Frames Before", size=2)
    before_fps: _before(bpy.props.IntProperty, "Frame Rate Before", min=1)
    before_fps_base: _before(bpy.props.FloatProperty, "Frame Rate Base Before", min=1e-5)
    before_transform: _before(bpy.props.StringProperty, "View Transform Before")
    before_look: _before(bpy.props.StringProperty, "Look Before")
    before_exposure: _before(bpy.props.FloatProperty, "Exposure Before")
    before_gamma: _before(bpy.props.FloatProperty, "Gamma Before", default=1.0)
    before_curves: _before(bpy.props.BoolProperty, "Curves Before")
    before_white_balance: _before(bpy.props.BoolProperty, "White Balance Before")
