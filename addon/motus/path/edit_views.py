"""Two orthographic edit views of a path, from the top and from the side, and switching between them."""

import math

import bpy
from mathutils import Vector

from ..core.operators import Operator
from ..core.rows import Rows
from ..core.translations import tr
from . import targets

COLLECTION = "Motus Edit Views"
MARGIN = 1.3  # of the curve's size
SMALLEST = 1.0  # m

VIEWS = {
    # name of the camera, direction it looks from, its rotation
    'TOP': ("Motus Top View", Vector((0.0, 0.0, 1.0)), (0.0, 0.0, 0.0)),
    'SIDE': ("Motus Side View", Vector((0.0, -1.0, 0.0)), (math.pi / 2.0, 0.0, 0.0)),
}


class MOTUS_OT_path_edit_views(Operator, bpy.types.Operator):
    bl_idname = "motus.path_edit_views"
    bl_label = "Path Edit Views"
    bl_description = "Look at the path from the top or from the side through orthographic cameras; each call switches over"

    curve: bpy.props.StringProperty(
        name="Curve", description="Name of the curve object; empty takes the selected one or what the active object follows",
        options={'SKIP_SAVE'})
    view: bpy.props.EnumProperty(
        name="View", description="Which view to show", default='NEXT', options={'SKIP_SAVE'}, items=(
            ('NEXT', "Next", "The one of the two that is not shown"),
            ('TOP', "Top", "From above"),
            ('SIDE', "Side", "From the side"),
            ('LEAVE', "Leave", "Back to the viewport's own view"),
        ))

    redo = (Rows(("view",)),)

    @classmethod
    def check_offer(cls, context):
        targets.curve_for(context, "", *_owners(context))

    def run(self, context):
        spaces = viewports(context)
        if self.view == 'LEAVE':
            for space in spaces:
                space.region_3d.view_perspective = 'PERSP'
                space.use_local_camera = False
            return
        curve = targets.curve_for(context, self.curve, *_owners(context))
        context.view_layer.update()
        cameras = {view: _camera(context.scene, curve, *settings) for view, settings in VIEWS.items()}
        view = self.view if self.view in VIEWS else _other(spaces, cameras)
        for space in spaces:
            # The viewport's own camera: the scene's stays the one that renders.
            space.use_local_camera = True
            space.camera = cameras[view]
            space.region_3d.view_perspective = 'CAMERA'
        self.report({'INFO'}, tr("{view} of {curve}").format(view=cameras[view].name, curve=curve.name))


def _owners(context):
    return [context.object] if context.object else []


def viewports(context):
    """The 3D viewport that the call comes from, else all of the screen."""
    if context.space_data and context.space_data.type == 'VIEW_3D':
        return [context.space_data]
    areas = context.screen.areas if context.screen else ()
    return [area.spaces.active for area in areas if area.type == 'VIEW_3D']


def _other(spaces, cameras):
    shows_top = any(space.use_local_camera and space.camera == cameras['TOP']
                    and space.region_3d.view_perspective == 'CAMERA' for space in spaces)
    return 'SIDE' if shows_top else 'TOP'


def _camera(scene, curve, name, direction, rotation):
    """The camera of this name, made where the scene has none, framing the curve."""
    camera = next((obj for obj in scene.objects if obj.name.startswith(name) and obj.type == 'CAMERA'), None)
    if camera is None:
        camera = bpy.data.objects.new(name, bpy.data.cameras.new(name))
        _collection(scene).objects.link(camera)
    corners = [curve.matrix_world @ Vector(corner) for corner in curve.bound_box]
    low = Vector(min(corner[i] for corner in corners) for i in range(3))
    high = Vector(max(corner[i] for corner in corners) for i in range(3))
    size = max(*(high - low), SMALLEST)
    camera.data.type = 'ORTHO'
    camera.data.ortho_scale = MARGIN * size
    camera.data.clip_end = 4.0 * size
    camera.rotation_euler = rotation
    camera.location = (low + high) / 2.0 + 2.0 * size * direction
    return camera


def _collection(scene):
    collection = next((child for child in scene.collection.children if child.name.startswith(COLLECTION)), None)
    if collection is None:
        collection = bpy.data.collections.new(COLLECTION)
        collection.hide_render = True
        scene.collection.children.link(collection)
    return collection


classes = (MOTUS_OT_path_edit_views,)
