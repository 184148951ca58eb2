"""Chains as an artist sees them: sidebar, the bone's constraint properties, and the overlay on a tail that swings."""

import bpy
import mathutils

import support
from chains import chain_cases as cases
from window import properties_editor, window_support


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = cases.rope(6, chains=2)
    bpy.context.view_layer.objects.active = rig
    rig.select_set(True)
    cases.add(rig, "Tail 0 0, Tail 1 0", frequency=1.0)
    bpy.ops.object.mode_set(mode='POSE')
    rig.data.bones.active = rig.data.bones["Tail 1 3"]
    return rig


def test_the_sidebar_shows_the_chain_of_the_active_bone():
    rig = build()
    bpy.context.scene.frame_set(18)
    view = bpy.context.preferences.view
    view.ui_scale = 0.75  # the whole panel is to be seen
    try:
        drawn = yield from window_support.open_tab("Motus")
        assert "MOTUS_PT_chains" in drawn and "MOTUS_PT_chains_forces" in drawn, drawn
        yield from window_support.picture("chains_sidebar")
    finally:
        view.ui_scale = 1.0
    assert rig.motus.chains.active_entry == 1
    batches = support.addon("core.interface.overlay").batches(bpy.context)
    assert sum(len(batch.points) for batch in batches) == 2 * 12, batches
    bpy.ops.object.mode_set(mode='OBJECT')


def test_constraint_properties():
    build()
    yield from properties_editor.picture_of('BONE_CONSTRAINT', "chains_constraints")
    bpy.ops.object.mode_set(mode='OBJECT')


def test_the_overlay_shows_limits_pins_and_what_is_touched():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = cases.still_rope(8)
    bpy.context.view_layer.objects.active = rig
    rig.select_set(True)
    start = cases.place(rig, 1, "Tail 0 0")
    solid = bpy.data.collections.new("Solid")
    bpy.context.scene.collection.children.link(solid)
    for name, place, scale in (
        ("Ball", (0.6, 0.0, -0.9), (0.4, 0.4, 0.4)),
        ("Capsule", (1.2, 0.0, -0.8), (0.15, 0.8, 0.15)),
        ("Ground", (0.0, 0.0, -1.3), (1.0, 1.0, 1.0)),
    ):
        empty = support.link(name, location=start + place)
        empty.empty_display_type, empty.scale = 'PLAIN_AXES' if name == "Ground" else 'SPHERE', scale
        solid.objects.link(empty)
    post = support.link("Post", location=start + (1.8, 0.0, 0.1))
    cases.add(rig, frequency=0.0, drag=1.0, thickness=0.03, bend_limit=0.7, settle=20.0, colliders=solid)
    bpy.ops.motus.chains_pin(object=rig.name, target=post.name)
    bpy.context.scene.frame_set(30)
    view = window_support.area().spaces.active.region_3d
    view.view_perspective, view.view_location, view.view_distance = 'PERSP', start + (0.8, 0.0, -0.4), 4.0
    view.view_rotation = mathutils.Euler((1.3, 0.0, 0.35)).to_quaternion()
    yield
    yield from window_support.until(lambda: support.addon("chains.steps").done(rig) is None)
    batches = support.addon("core.interface.overlay").batches(bpy.context)
    overlay = support.addon("chains.overlay")
    assert {tuple(batch.colors) for batch in batches} == {
        overlay.LINK_COLOR,
        overlay.LIMIT_COLOR,
        overlay.COLLIDER_COLOR,
        overlay.PIN_COLOR,
        overlay.CONTACT_COLOR,
    }, batches
    yield from window_support.picture("chains_touching")
    scene = bpy.context.scene.motus
    for name in ("show_chains_limits", "show_chains_colliders", "show_chains_pins"):
        setattr(scene, name, False)
    assert len(support.addon("core.interface.overlay").batches(bpy.context)) == 1
    for name in ("show_chains_limits", "show_chains_colliders", "show_chains_pins"):
        setattr(scene, name, True)


def test_a_long_motion_is_solved_while_blender_goes_on():
    steps, overlay = support.addon("chains.steps"), support.addon("chains.overlay")
    rig = build()
    scene = bpy.context.scene
    scene.frame_end = 2000
    scene.frame_set(1900)
    bpy.context.view_layer.update()
    yield from window_support.until(lambda: steps.done(rig) is None)

    def shown():
        found = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        return [tuple(found.matrix_world @ found.pose.bones[name].tail) for name in cases.chain(rig)]

    def colors():
        return {tuple(batch.colors) for batch in support.addon("core.interface.overlay").batches(bpy.context)}

    former = shown()
    assert colors() == {overlay.LINK_COLOR}, colors()
    given = steps.AT_FIRST, steps.SLICE
    steps.AT_FIRST, steps.SLICE = 0.0, 0.002
    try:
        for entry in rig.motus.chains.entries:
            entry.frequency = 0.2
        bpy.context.view_layer.update()
        assert shown() == former
        assert 0.0 <= steps.done(rig) < 1.0, steps.done(rig)
        assert colors() == {overlay.UNFINISHED_COLOR}, colors()
        yield from window_support.picture("chains_unfinished")
        yield from window_support.until(lambda: steps.done(rig) is None)
    finally:
        steps.AT_FIRST, steps.SLICE = given
    yield
    assert colors() == {overlay.LINK_COLOR}, colors()
    assert shown() != former
    bpy.ops.object.mode_set(mode='OBJECT')


def test_a_curve_along_the_chain_is_drawn_with_the_mouse():
    rig = build()
    entry = rig.motus.chains.entries[1]
    entry.tip_mass, entry.use_curve = 3.0, True
    view = bpy.context.preferences.view
    view.ui_scale = 0.6  # the widget is to be seen
    try:
        yield from window_support.open_tab("Motus")
        left, right, low, high = yield from widget(entry)
        entry.curve = "0 0, 1 1"
        yield from window_support.picture("chains_curve")
        before = cases.matrix(rig, 20, "Tail 1 5")
        x, y = (left + right) // 2, (low + high) // 2
        send = window_support.window().event_simulate
        window_support.move(x, y)
        yield
        send(type='LEFTMOUSE', value='PRESS', x=x, y=y)
        yield
        for _ in range(5):
            y += (high - low) // 16
            window_support.move(x, y)
            yield
        send(type='LEFTMOUSE', value='RELEASE', x=x, y=y)
        yield
        yield from window_support.picture("chains_curve_drawn")
    finally:
        view.ui_scale = 1.0
    points = support.addon("core.settings.drawn_curves").points_in(entry.curve)
    assert len(points) == 3 and points[1][1] > 0.6, entry.curve
    assert abs(cases.matrix(rig, 20, "Tail 1 5") - before).max() > 1e-3
    bpy.ops.object.mode_set(mode='OBJECT')


def widget(entry):
    """Generator: where the widget of an entry's curve is, (left, right, low, high) in pixels of the window: what the curve changes of the sidebar."""
    seen, start = [], window_support.region('UI').x
    for text in ("0 0, 1 1", "0 1, 1 0"):
        entry.curve = text
        window_support.draw_all()
        yield from window_support.picture("chains_curve")
        seen.append(window_support.screen().astype(int))
    rows, columns = (abs(seen[0] - seen[1])[:, start:].max(axis=2) > 40).nonzero()
    height = len(seen[0])
    return tuple(map(int, (start + columns.min(), start + columns.max(), height - 1 - rows.max(), height - 1 - rows.min())))
