"""Wired objects in a real window: played, dragged, undone with the keyboard, baked by the modal operator and cancelled."""

import bpy

import support
import toy_system
from window import window_support

toy_system.register()


def follows(owner):
    """Whether the owner stands where its system says."""
    wanted, _ = toy_system.expected(owner)
    return (toy_system.world_matrix(owner).translation - wanted).length < 1e-4


def new_orbit():
    target = toy_system.new_object("Target")
    owner = toy_system.new_object("Owner", (3.0, 0.0, 0.0))
    toy_system.orbit(owner, target)
    bpy.context.view_layer.objects.active = owner
    bpy.ops.ed.undo_push(message="wired")
    return owner, target


def key(letter, **modifiers):
    """Generator: presses a key in the middle of the viewport."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    window_support.press(letter, x, y, **modifiers)
    yield


def test_playback():
    owner, _ = new_orbit()
    seen = []

    def note(scene, _graph):
        seen.append((scene.frame_current, follows(owner)))

    bpy.app.handlers.frame_change_post.append(note)
    yield from key('SPACE')
    yield from window_support.until(lambda: len(seen) > 10)
    yield from key('SPACE')
    bpy.app.handlers.frame_change_post.remove(note)
    assert len(seen) > 10, "nothing was played"
    assert all(right for _, right in seen), seen


def test_dragged_target():
    owner, target = new_orbit()
    bpy.context.view_layer.objects.active = target
    target.select_set(True)
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    window_support.press('G', x, y)
    yield
    for step in range(1, 6):
        window_support.move(x + 20 * step, y)
        yield
        assert follows(owner), f"behind the mouse at step {step}"
    window_support.press('LEFTMOUSE', x + 100, y)
    yield
    assert target.location.length > 0.1, "the target was not dragged"
    assert follows(owner)

    yield from key('Z', ctrl=True)
    owner, target = bpy.data.objects["Owner"], bpy.data.objects["Target"]
    assert target.location.length == 0.0, "the drag was not undone"
    assert follows(owner)
    yield from key('Z', ctrl=True, shift=True)
    owner, target = bpy.data.objects["Owner"], bpy.data.objects["Target"]
    assert target.location.length > 0.1, "the drag was not redone"
    assert follows(owner)


def test_bake_in_the_window():
    owner, _ = new_orbit()
    bpy.context.scene.frame_end = 50
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.motus.bake('INVOKE_DEFAULT', object="Owner")
    yield
    yield from window_support.picture("bake_question")
    assert not owner.motus.bake.is_baked
    window_support.press('RET', x, y)
    yield from window_support.until(lambda: owner.motus.bake.is_baked)
    assert owner.motus.bake.is_baked
    assert follows(owner)


def test_escape_cancels_the_bake():
    owner, _ = new_orbit()
    scene = bpy.context.scene
    scene.frame_set(7)
    with window_support.override():
        bpy.ops.motus.bake('INVOKE_DEFAULT', object="Owner", frame_start=1, frame_end=100000)
    yield
    assert scene.frame_current != 7, "baking has not begun"
    yield from key('ESC')
    assert scene.frame_current == 7
    assert not owner.motus.bake.is_baked
    assert owner.animation_data.action is None
    assert follows(owner)


class MOTUS_OT_test_timers(bpy.types.Operator):
    """Counts the ticks of timers until it is told to stop."""

    bl_idname = "motus.test_timers"
    bl_label = "Count Ticks"
    ticks, is_over = 0, False

    def invoke(self, context, _event):
        context.window_manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, _context, event):
        counter = MOTUS_OT_test_timers
        counter.ticks += event.type == 'TIMER'
        return {'FINISHED'} if counter.is_over else {'PASS_THROUGH'}


def count_ticks(seconds):
    """Generator: how many events of timers there are in that time."""
    counter = MOTUS_OT_test_timers
    counter.ticks, counter.is_over = 0, False
    bpy.utils.register_class(counter)
    with window_support.override():
        bpy.ops.motus.test_timers('INVOKE_DEFAULT')
    yield seconds
    ticks, counter.is_over = counter.ticks, True
    window_support.move(*window_support.centre())
    yield 0.3
    bpy.utils.unregister_class(counter)
    return ticks


def test_a_bake_that_fails_leaves_no_timer():
    owner, _ = new_orbit()
    job = support.addon("core.bake.job")
    before = yield from count_ticks(0.5)

    def failing(*_arguments):
        yield 1
        raise ZeroDivisionError

    kept, job.bake = job.bake, failing
    try:
        with window_support.override():
            bpy.ops.motus.bake('INVOKE_DEFAULT', object="Owner", frame_start=1, frame_end=10)
        yield 0.5
    finally:
        job.bake = kept
    after = yield from count_ticks(0.5)
    assert after <= before + 2, (before, after)
    assert not owner.motus.bake.is_baked
