"""The buttons of the sidebar that add a system to bones stay offered, and say what they will happen to."""

import contextlib

import bpy

import support
from window import window_support

SYSTEMS = {"ik": "motus.ik_add", "look_at": "motus.look_at_add", "dynamics": "motus.dynamics_add", "chains": "motus.chains_add"}
OF_SELECTION = {"dynamics", "chains"}
"""Systems whose one button takes all selected bones."""


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    rig = bpy.data.objects.new("Figure", bpy.data.armatures.new("Figure"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    rig.select_set(True)
    bpy.ops.object.mode_set(mode='EDIT')
    for side, x in (("L", 1.0), ("M", 0.0), ("R", -1.0)):
        parent = None
        for name, low in (("upper", 0.0), ("lower", 1.0)):
            bone = rig.data.edit_bones.new(f"{name}.{side}")
            bone.head, bone.tail, bone.parent = (x, 0.0, low), (x, -0.1, low + 1.0), parent
            parent = bone
    bpy.ops.object.mode_set(mode='POSE')
    return rig


def choose(rig, *names):
    """Select these bones alone; the first is the active one."""
    for bone in rig.data.bones:
        holder = rig.pose.bones[bone.name] if hasattr(rig.pose.bones[bone.name], "select") else bone
        holder.select = bone.name in names
    rig.data.bones.active = rig.data.bones[names[0]]


@contextlib.contextmanager
def noted():
    """{operator: [(words, bones)]} of the buttons that were drawn since; words are "" where the button is grey."""
    entries, found = support.addon("core.interface.bone_entries"), {}
    draw = entries.draw_add

    def noting(layout, identifier, icon, words, bones=(), idle=""):
        found.setdefault(identifier, []).append((words, tuple(bones)))
        return draw(layout, identifier, icon, words, bones, idle)

    entries.draw_add = noting
    try:
        yield found
    finally:
        entries.draw_add = draw


def shown(found):
    found.clear()
    window_support.draw_all()
    yield from window_support.until(lambda: set(SYSTEMS.values()) <= set(found))


def test_add_stays_offered_on_the_next_bone_and_on_all_selected():
    rig = build()
    yield from window_support.open_tab("Motus")
    with noted() as found:
        for name, identifier in SYSTEMS.items():
            settings = getattr(rig.motus, name).entries
            choose(rig, "lower.L")
            yield from shown(found)
            assert "lower.L" in found[identifier][0][0], found
            with window_support.override():
                assert getattr(bpy.ops.motus, identifier[6:])('INVOKE_DEFAULT') == {'FINISHED'}
            assert [entry.name for entry in settings] == ["lower.L"], name
            yield from shown(found)
            assert name in OF_SELECTION or not found[identifier][0][0], "it has one already"
            choose(rig, "lower.M")
            yield from shown(found)
            assert "lower.M" in found[identifier][0][0], found
            choose(rig, "lower.M", "lower.R")
            yield from shown(found)
            words, bones = found[identifier][0 if name in OF_SELECTION else 1]
            assert "2 " in words and set(bones) == (set() if name in OF_SELECTION else {"lower.M", "lower.R"}), found
            keywords = {"bones": ",".join(bones)} if bones else {}
            with window_support.override():
                assert getattr(bpy.ops.motus, identifier[6:])('INVOKE_DEFAULT', **keywords) == {'FINISHED'}
            assert {entry.name for entry in settings} == {"lower.L", "lower.M", "lower.R"}, name
            with window_support.override():
                for entry in [entry.name for entry in settings]:
                    remove = getattr(bpy.ops.motus, f"{name}_remove")
                    remove(object="Figure", **({"bones": entry} if name in OF_SELECTION else {"bone": entry}))
    bpy.ops.object.mode_set(mode='OBJECT')
