"""The overlay as the viewport draws it, in a corner of the pictures of the flight and of the reach."""

import math
from pathlib import Path
from typing import NamedTuple

import bpy
from mathutils import Euler, Vector

import demo_plan
from window import window_support

from . import hand

PICTURES = Path(__file__).resolve().parents[2] / "pictures"


class Inset(NamedTuple):
    """Of a demo scene: whose overlay, seen from where, and where it lies in the picture."""

    demo: str
    owner: str
    at: tuple  # of what the view turns about, in the owner's space
    turn: tuple  # degrees about X and Z
    distance: float  # m
    corner: tuple  # left and top in the picture, pixels


INSETS = (
    Inset("flight", "Aeroplane", (3.0, 13.0, 0.0), (50.0, -75.0), 62.0, (645, 305)),
    Inset("reach", "Wooden Pilot", (0.0, 0.0, 0.85), (80.0, 10.0), 3.2, (645, 15)),
)


def steps(strip):
    """Generator: one inset after the other."""
    for inset in INSETS:
        yield from hand.fresh()
        yield from _show(inset)
        yield from strip.inset(PICTURES / f"demo_{inset.demo}.png", *inset.corner)


def _show(inset):
    demo = next(one for one in demo_plan.SCENES if one.name == inset.demo)
    bpy.ops.motus.demo_scene(system=demo.identifier)
    yield
    scene = window_support.window().scene
    scene.frame_set(scene.frame_start + round(demo.stills[0][1] * scene.render.fps / scene.render.fps_base))
    space, owner = window_support.area().spaces.active, scene.objects[inset.owner]
    with window_support.override():
        bpy.ops.object.select_all(action='DESELECT')
        for obj in (owner, *owner.children_recursive):
            if not obj.hide_get():
                obj.select_set(True)
        bpy.context.view_layer.objects.active = owner
        bpy.ops.view3d.localview(frame_selected=False)
        for obj in owner.children_recursive:
            obj.select_set(False)
    space.show_region_ui = space.show_region_toolbar = space.show_region_header = space.show_region_tool_header = False
    space.show_gizmo = space.overlay.show_text = space.overlay.show_outline_selected = False
    space.shading.color_type = 'MATERIAL'
    view = space.region_3d
    view.view_perspective = 'PERSP'
    view.view_rotation = Euler((math.radians(inset.turn[0]), 0.0, math.radians(inset.turn[1]))).to_quaternion()
    world = owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world
    view.view_location, view.view_distance = world @ Vector(inset.at), inset.distance
    yield
