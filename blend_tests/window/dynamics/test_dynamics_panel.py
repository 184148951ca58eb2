"""Dynamics as an artist sees them: the sidebar with the graph, which follows the numbers, and what has to be recorded."""

import types

import bpy
import numpy as np

import support
from dynamics import dynamics_cases as cases
from window import properties_editor, window_support


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    ball = cases.moved()
    bpy.context.view_layer.objects.active = ball
    ball.select_set(True)
    bpy.ops.motus.dynamics_add(style='BOUNCY')
    return ball


def _pixels(path):
    """The picture's numbers; where the graph's line is, its colour: orange."""
    width, height, values = window_support.pixels(path)
    picture = np.array(values).reshape(height, width, 4)
    return picture, (picture[..., 0] > 0.7) & (picture[..., 2] < 0.45) & (picture[..., 1] < 0.7)


def test_the_graph_follows_the_numbers():
    ball = build()
    view, seen = bpy.context.preferences.view, {}
    view.ui_scale = 0.75  # the whole panel is to be seen
    try:
        yield
        drawn = yield from window_support.open_tab("Motus")
        assert "MOTUS_PT_dynamics" in drawn and "MOTUS_PT_dynamics_motion" in drawn, drawn
        for style in ('BOUNCY', 'JELLY', 'CRITICAL'):
            ball.motus.dynamics.entries[0].style = style
            yield
            path = yield from window_support.picture(f"dynamics_{style.lower()}")
            _, line = _pixels(path)
            assert line.sum() > 100, (style, line.sum())
            seen[style] = line
    finally:
        view.ui_scale = 1.0
    assert (seen['BOUNCY'] != seen['JELLY']).sum() > 100
    assert (seen['BOUNCY'] != seen['CRITICAL']).sum() > 100
    shown = support.addon("core.interface.view.graph")._shown
    assert shown.get("dynamics") is not None


def test_what_has_to_be_recorded_is_said():
    ball = build()
    carrier = cases.link("Carrier")
    carrier.constraints.new('COPY_LOCATION').target = ball
    child = cases.link("Child", parent=carrier)
    bpy.ops.motus.dynamics_add(object="Child")
    bpy.context.view_layer.objects.active = child
    drawn = yield from window_support.open_tab("Motus")
    assert "MOTUS_PT_dynamics_input" in drawn, drawn
    yield from window_support.picture("dynamics_needs_recording")
    bpy.ops.motus.track_record(datablock="Carrier", transform='WORLD', frame_start=1, frame_end=20)
    yield
    yield from window_support.picture("dynamics_recorded")
    source = support.addon("dynamics.panel").input_of(child, child.motus.dynamics.entries[0], bpy.context.scene)
    assert source.is_known and "1-20" in source.unknown[0][0].sentence


class _Buttons(list):
    """A layout that keeps what its buttons would do."""

    def column(self, align):
        return self

    row = column

    def operator(self, identifier, **look):
        self.append(types.SimpleNamespace(identifier=identifier))
        return self[-1]


def test_a_tail_has_a_button_of_its_own():
    """Each button says whether it takes the bones below, so that none does what another did last."""
    draw = support.addon("dynamics.panel").draw_add
    for mode in ('OBJECT', 'POSE'):
        buttons = _Buttons()
        draw(buttons, types.SimpleNamespace(mode=mode, selected_objects=[], selected_pose_bones=[]))
        assert [button.whole_chains for button in buttons] == [False, True], (mode, buttons)
        assert buttons.enabled == (mode == 'POSE'), mode
    yield


def test_what_stands_still_is_said():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    ball = cases.link("Ball")
    bpy.context.view_layer.objects.active = ball
    bpy.ops.motus.dynamics_add(object="Ball")
    ui, said = support.addon("core.interface.ui"), []
    draw = ui.draw_message
    ui.draw_message = lambda layout, sentence, icon: said.append(sentence) or draw(layout, sentence, icon)
    try:
        yield from window_support.open_tab("Motus")
        yield from window_support.picture("dynamics_still")
        assert "Nothing moves here yet that could be followed" in said, said
        ball.keyframe_insert("location", frame=1)
        ball.location.x = 3.0
        ball.keyframe_insert("location", frame=20)
        said.clear()
        window_support.draw_all()
        yield
        assert "Exact at any frame" in said, said
    finally:
        ui.draw_message = draw


def test_what_hangs_on_a_keyed_arm_is_known():
    """The panel asks originals, and may not write into their actions."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    arm, cup = cases.rope(2, name="Arm"), cases.link("Cup")
    cases.moved("Goal")
    bpy.ops.motus.ik_add(object="Arm", bone="Tail 0 1", target="Goal", chain_length=2)
    cup.parent, cup.parent_type, cup.parent_bone = arm, 'BONE', "Tail 0 1"
    bpy.ops.motus.dynamics_add(object="Cup", follow='WORLD')
    bpy.context.view_layer.objects.active = cup
    ui, said = support.addon("core.interface.ui"), []
    draw = ui.draw_message
    ui.draw_message = lambda layout, sentence, icon: said.append(sentence) or draw(layout, sentence, icon)
    try:
        drawn = yield from window_support.open_tab("Motus")
        assert "MOTUS_PT_dynamics_input" in drawn, drawn
        yield from window_support.picture("dynamics_on_an_arm")
        assert "Exact at any frame" in said, said
    finally:
        ui.draw_message = draw


def test_a_property_from_its_menu_to_the_list():
    ball = build()
    bpy.ops.motus.dynamics_remove(object="Ball")
    cases.key(ball, "rotation_euler", {1: (0.0, 0.0, 0.0), 20: (0.0, 0.0, 1.0)})
    yield from properties_editor.opened()
    found = yield from properties_editor.hover("rotation_euler")
    assert found, "the editor shows no rotation"
    targets, offered = support.addon("dynamics.targets"), []
    as_it_is = targets.path_from
    targets.path_from = lambda *arguments: offered.append(as_it_is(*arguments)) or offered[-1]
    try:
        window_support.press('RIGHTMOUSE', *found)
        yield from window_support.until(lambda: offered)
        yield from window_support.picture("dynamics_menu")
    finally:
        targets.path_from = as_it_is
    assert offered[0] == "rotation_euler", offered
    window_support.press('ESC', *found)
    yield
    with window_support.override():
        bpy.ops.motus.dynamics_add(object="Ball", data_path=offered[0], style='BOUNCY')
        bpy.ops.motus.dynamics_add(object="Ball", style='FLOPPY', channels={'LOCATION'})
    drawn = yield from window_support.open_tab("Motus")
    assert "MOTUS_PT_dynamics_motion" in drawn, drawn
    for index, name in enumerate(("property", "object")):
        ball.motus.dynamics.active_entry = index
        window_support.draw_all()
        yield
        yield from window_support.picture(f"dynamics_list_{name}")
    button = support.addon("dynamics.setup").label(ball.motus.dynamics.entries[0])
    assert button == "Rotation", button
