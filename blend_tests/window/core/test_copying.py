"""Copy Settings and Paste Settings with the clipboard of a window, and one step of undo."""

import bpy

import support
from window import window_support


def new_ball(name):
    ball = support.link(name)
    bpy.context.view_layer.objects.active = ball
    bpy.ops.motus.dynamics_add(object=name)
    return ball


def state():
    """Frequency of the object Two."""
    return bpy.data.objects["Two"].motus.dynamics.entries[0].frequency


def test_clipboard_and_one_step_of_undo():
    first, _ = new_ball("One"), new_ball("Two")
    first.motus.dynamics.entries[0].frequency = 3.25
    with window_support.override():
        bpy.ops.motus.settings_copy(object="One", system="dynamics")
    assert '"system": "dynamics"' in bpy.context.window_manager.clipboard
    yield
    before = state()
    with window_support.override():
        bpy.ops.ed.undo_push(message="Before")
        bpy.ops.motus.settings_paste('EXEC_DEFAULT', True, object="Two", system="dynamics", with_keys=True)
    yield
    after = state()
    assert after == 3.25 and after != before, (before, after)
    with window_support.override():
        bpy.ops.ed.undo()
    yield
    assert state() == before, (state(), before)
    with window_support.override():
        bpy.ops.ed.redo()
    yield
    assert state() == after, (state(), after)
    bpy.context.window_manager.clipboard = "import os"
    with window_support.override():
        try:
            bpy.ops.motus.settings_paste(object="Two", system="dynamics")
        except RuntimeError as error:
            assert "no copied settings" in str(error), error
        else:
            raise AssertionError("not refused")
