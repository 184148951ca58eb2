"""Add it, set it, pause it, drag it, and let it go on."""

import bpy

from . import hand


def steps(strip):
    """Generator: the five steps of the Pendulums page."""
    yield from hand.fresh()
    yield from hand.empty_view()
    yield from hand.menu("Add", "Motus", "Add Pendulum", within=hand.box('HEADER'))
    yield from strip.shot(240, 180)
    yield from hand.click()

    yield from hand.frame_view(zoom_out=3)
    yield from hand.enter("0.7", "Lower Length", hand.box('UI'), beside=120)
    yield from hand.enter("150", "Upper Angle", hand.box('UI'), beside=120)
    yield from strip.shot(620, 80)

    yield from hand.to_frame(36)
    yield from hand.click("Pause", hand.box('UI'))
    yield from strip.shot(620, 390)

    yield from hand.click("Drag Pendulum", hand.box('UI'))
    bob = bpy.context.object.motus.pendulum.rods[1].bob
    yield from hand.press_at(*_where(bob))
    yield from hand.drag_to(hand.place[0] - 150, hand.place[1] - 60)
    yield from strip.shot(hand.place[0] - 100, 200)
    yield from hand.let_go()

    yield from hand.click("Play", hand.box('UI'))
    yield from hand.click("Trails", hand.box('UI'))
    yield from hand.click("Add Trails", hand.box('UI'))
    yield from hand.to_frame(72)
    yield from strip.shot(200, 330)


def _where(obj):
    return hand.pixel_of(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation)
