"""Chains as an artist sees them: sidebar, the bone's constraint properties, and the overlay on a tail that swings."""

import bpy

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
