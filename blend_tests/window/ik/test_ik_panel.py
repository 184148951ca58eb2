"""Inverse kinematics as an artist sees it: the sidebar, the bone's constraint tab, and the overlay."""

import bpy
from mathutils import Vector

import support
from window import properties_editor, window_support

JOINTS = ((0.0, 0.0, 0.0), (0.0, -0.3, 1.5), (0.0, 0.0, 3.0))
SETTINGS = {
    "": {"name", "chain_length", "use_tail", "influence"},
    "_target": {"target", "rotation_offset"},
    "_weights": {"position_weight", "rotation_weight"},
    "_pole": {"pole", "bend", "pole_angle", "hinge_angle"},
    "_reach": {"softness", "stretch"},
    "_limits": {"lock_ik_x", "use_ik_limit_x", "ik_min_x", "ik_max_x"},
    "_precision": {"tolerance", "iterations"},
}
"""What each part of the panel has to show."""
LABELS = 0.4
"""Of a panel's width, where labels stand beside their fields."""
MARGIN = 45.0
"""Of a region's width: frame, scroll bar, and the gap before the fields; at a scale of 1."""
SLIDE = 0.5
"""Seconds in which Blender's panels have come to their places."""


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = bpy.data.objects.new("Figure", bpy.data.armatures.new("Figure"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    rig.select_set(True)
    bpy.ops.object.mode_set(mode='EDIT')
    for side, x in (("L", 1.0), ("R", -1.0)):
        parent = None
        for name, head, tail in (("thigh", JOINTS[2], JOINTS[1]), ("shin", JOINTS[1], JOINTS[0])):
            bone = rig.data.edit_bones.new(f"{name}.{side}")
            bone.head, bone.tail = [(place[0] + x, *place[1:]) for place in (head, tail)]
            bone.parent, bone.use_connect = parent, parent is not None
            parent = bone
    bpy.ops.object.mode_set(mode='OBJECT')
    for side in "LR":
        bpy.ops.motus.ik_add(object="Figure", bone=f"shin.{side}", make_pole=True)
    bpy.data.objects["Figure shin.L Target"].location.z -= 0.5
    bpy.data.objects["Figure shin.R Target"].location.z += 0.8
    return rig


def choose(rig, mode):
    rig.data.bones.active = rig.data.bones["shin.L"]
    bpy.ops.object.mode_set(mode=mode)


def test_sidebar_and_overlay():
    rig = build()
    choose(rig, 'POSE')
    with window_support.override():
        bpy.ops.view3d.view_all()
    yield
    view = window_support.area().spaces.active.region_3d
    view.view_distance *= 1.4
    view.view_location += view.view_rotation @ Vector((1.2, 0.0, 0.0))  # out from under the sidebar
    yield
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("ik_sidebar")
    assert any(name.startswith("MOTUS_PT_ik") for name in drawn), drawn
    _, _, values = window_support.pixels(path)
    assert len({round(value, 2) for value in values[0::4]}) > 20
    bpy.ops.object.mode_set(mode='OBJECT')
    yield
    yield from window_support.picture("ik_object_mode")


def test_list_chooses_the_bone():
    rig = build()
    choose(rig, 'POSE')
    assert rig.motus.ik.active_entry == 0
    rig.motus.ik.active_entry = 1
    assert rig.data.bones.active.name == "shin.R"
    rig.data.bones.active = rig.data.bones["thigh.L"]
    assert rig.motus.ik.active_entry == 0
    bpy.ops.object.mode_set(mode='OBJECT')
    assert rig.motus.ik.active_entry == 1, "in Object Mode the one chosen last"
    yield


def test_undo_is_one_step():
    rig = build()
    bpy.ops.ed.undo_push(message="built")
    with window_support.override():
        bpy.ops.motus.ik_remove('INVOKE_DEFAULT', True, object="Figure", bone="shin.L", remove_controls=True)  # True: as from a button
    yield
    assert len(rig.motus.ik.entries) == 1 and "Figure shin.L Target" not in bpy.data.objects
    bpy.ops.ed.undo()
    yield
    rig = bpy.data.objects["Figure"]
    assert len(rig.motus.ik.entries) == 2 and "Figure shin.L Target" in bpy.data.objects
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    tip = evaluated.matrix_world @ evaluated.pose.bones["shin.R"].tail
    target = bpy.data.objects["Figure shin.R Target"].location
    assert (tip - target).length < 1e-4, (tip, target)


def test_bone_constraint_properties():
    rig = build()
    choose(rig, 'POSE')
    rig.motus.ik.entries["shin.L"].use_limits = True
    rig.pose.bones["shin.L"].use_ik_limit_x = True
    panels = [panel for panel in support.addon("ik.panel").classes if panel.__name__.startswith("MOTUS_PT_ik_constraint")]
    with window_support.drawn_settings(panels) as drawn:
        yield from properties_editor.picture_of('BONE_CONSTRAINT', "ik_bone_constraints")
        # Panels of constraints still slide to their places: Blender 4.3 crashes where any class is unregistered meanwhile.
        yield SLIDE
    for part, names in SETTINGS.items():
        missing = names - drawn.get(f"MOTUS_PT_ik_constraint{part}", set())
        assert not missing, (part, missing, drawn)


def test_labels_are_not_clipped_in_a_narrow_editor():
    choose(build(), 'POSE')
    properties = yield from window_support.add_area('PROPERTIES')
    ui, seen = support.addon("core.interface.ui"), {}
    split, margin = ui.split, MARGIN * bpy.context.preferences.system.ui_scale

    def noting(layout, longest=""):
        column = split(layout, longest)
        region = bpy.context.region
        seen[region.type, region.width, longest or "Influence"] = (column.use_property_split, LABELS * (region.width - margin))
        return column

    yield  # the editor has to see the bone before it has a tab for it
    ui.split = noting
    try:
        properties.spaces.active.context = 'BONE_CONSTRAINT'
        yield
        yield from window_support.open_tab("Motus")
        yield from window_support.picture("ik_narrow_editor")
    finally:
        ui.split = split
    clipped = {key: room for key, (is_beside, room) in seen.items() if is_beside and window_support.text_width(key[2]) >= room}
    assert not clipped, clipped
    assert {is_beside for is_beside, _ in seen.values()} == {True, False}, seen
    assert "Rig Influence" in {label for _, _, label in seen}
