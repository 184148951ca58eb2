"""Add a spider, move it along with keys, look at a frame in between, give it another gait, and let it walk on what is there."""

import math

import bpy
from mathutils import Euler

from window import window_support

from . import hand

LAST = 60
"""Frame at which the spider has come where it goes."""


def steps(strip):
    """Generator: the five steps of the Walkers page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    _look()
    yield from hand.menu("Add", "Motus", "Add Spider", within=hand.box('HEADER'))
    yield from strip.shot(240, 40)
    yield from hand.click()

    yield from hand.over_view()
    yield from hand.key('I')
    yield from hand.to_frame(LAST)
    yield from hand.move_along('Y', 1.5)
    yield from hand.key('I')
    yield from strip.shot(250, 260)

    yield from hand.to_frame(24)
    yield from strip.shot(250, 260)

    yield from hand.click("Tetrapod", hand.box('UI'))
    yield 0.5
    yield from hand.on("Tripod")
    yield from strip.shot(620, 120)
    yield from hand.click()

    _make_steps()
    yield from hand.to_frame(40)
    _lock_a_step()
    yield from strip.shot(150, 200)
    yield from strip.panel("walker_panel", 0, 28, 1050, 720)
    _hold_a_step()
    for part in ("Soles", "Steps"):
        yield from hand.click(part, hand.box('UI'), ctrl=True)
    yield 0.5
    yield from strip.panel("walker_times", 0, 28, 1050, 720)


def _look():
    view = window_support.area().spaces.active.region_3d
    view.view_perspective = 'PERSP'
    view.view_rotation = Euler((math.radians(58.0), 0.0, math.radians(38.0))).to_quaternion()
    view.view_location, view.view_distance = (0.0, 0.7, 0.1), 3.6


def _make_steps():
    """Blocks in the way, and the spider walks on these."""
    with window_support.override():
        spider = bpy.context.object
        blocks = bpy.data.collections.new("Blocks")
        bpy.context.scene.collection.children.link(blocks)
        for x, y, z in ((0.25, 0.45, 0.03), (-0.3, 0.85, 0.08), (0.2, 1.3, 0.12), (-0.25, 1.7, 0.05)):
            bpy.ops.mesh.primitive_cube_add(size=0.5, location=(x, y, z - 0.25))
            block = bpy.context.object
            for collection in list(block.users_collection):
                collection.objects.unlink(block)
            blocks.objects.link(block)
            block.select_set(False)
        bpy.ops.mesh.primitive_plane_add(size=8.0)
        floor = bpy.context.object
        blocks.objects.link(floor)
        floor.select_set(False)
        spider.select_set(True)
        bpy.context.view_layer.objects.active = spider
        spider.motus.walker.grounds = blocks


def _lock_a_step():
    """One step is moved aside, another one is locked."""
    with window_support.override():
        spider = bpy.context.object
        bpy.ops.motus.walker_step(object=spider.name, foot="foot 1.R", frame=40, lock=True)
        bpy.ops.motus.walker_step(object=spider.name, foot="foot 2.L", frame=40, turn=0.0)


def _hold_a_step():
    """One step is held until a later frame, and the chart shows it."""
    with window_support.override():
        spider = bpy.context.object
        bpy.context.scene.motus.show_walker_times = True
        bpy.ops.motus.walker_step_time(object=spider.name, foot="foot 1.R", frame=40, lift=58)
