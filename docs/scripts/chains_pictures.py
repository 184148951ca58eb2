"""The pictures of the page Chains, made through the add-on's own operators."""

import math

import bpy
from mathutils import Vector

import stage
import support

SPACING = 1.5  # m, from one chain to the next
BONES, LENGTH = 8, 0.12  # of a chain, m
MOVES = ((1, 0.35, 0.0), (25, 0.35, 0.0), (33, 0.0, 0.5), (60, 0.0, 0.5))  # frame, and where the hook is then along X and Z, m
SHOWN = (29, 33, 37, 41, 45)  # frames, the last one darkest
HOOK = 0.045
JELLY = 0.5  # length of the single bone that shows the preset for such, m


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_presets(folder / "chains_presets.png")]


def _render_presets(file):
    """The same bones with each preset, some moments after their root was pulled to the left and up."""
    presets = support.addon("chains.presets").BROUGHT
    scene = stage.new_scene((0.52, 0.60, 0.68), 0.9)
    scene.frame_end = MOVES[-1][0]
    stage.add_sun((math.radians(40), math.radians(-10), math.radians(-30)), 2.0, softness=8.0)
    rigs = []
    for index, preset in enumerate(presets):
        x = (index - (len(presets) - 1) / 2) * SPACING
        rig = _build(preset.label, x, *((1, JELLY, (0.0, 0.0, -1.0)) if preset.identifier == 'JELLY' else (BONES, LENGTH, (1.0, 0.0, 0.0))))
        bpy.ops.motus.chains_add(object=rig.name, bones="Bone 1", **preset.values)
        if preset.identifier == 'CAPE':
            rig.motus.chains.wind = (2.0, 0.0, 0.0)
        rigs.append(rig)
        stage.add_text(preset.label, (x + 0.3, -0.2, -1.32), 0.17)
    for step, frame in enumerate(SHOWN):
        scene.frame_set(frame)
        fade = 1.0 - (step + 1) / len(SHOWN)
        color = [value + 0.8 * fade * (shown - value) for value, shown in zip((0.05, 0.16, 0.36), (0.52, 0.60, 0.68))]
        material = stage.glossy_material(f"Shape {frame}", (*color, 1.0), 0.5)
        for rig in rigs:
            places = [place - Vector((0.0, 0.02 * step, 0.0)) for place in _places(rig)]
            stage.add_tube(places if len(places) > 2 else _jelly(*places), 0.012 + 0.012 * (1.0 - fade), material)
            if frame == SHOWN[-1]:
                _add_hook(places[0])
    stage.add_camera(scene, (0.3, -9.0, -0.22), (0.3, 0.0, -0.22), width=SPACING * len(presets) + 0.2)
    return stage.render(scene, file, (1280, 330), samples=64)


def _build(name, x, count, length, way):
    """A rig whose `count` bones of a length lie along a way, and whose object is pulled by keys."""
    rig = stage.link(bpy.data.objects.new(name, bpy.data.armatures.new(name)))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for index in range(count):
        bone = rig.data.edit_bones.new(f"Bone {index + 1}")
        bone.head, bone.tail = index * length * Vector(way), (index + 1) * length * Vector(way)
        bone.parent, bone.use_connect = parent, parent is not None
        parent = bone
    bpy.ops.object.mode_set(mode='OBJECT')
    for frame, aside, height in MOVES:
        rig.location = (x + aside, 0.0, height)
        rig.keyframe_insert("location", frame=frame)
    return rig


def _places(rig):
    """Where the chain's head and its bones' tails are at the scene's frame, in the world."""
    seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    bones = seen.pose.bones
    return [seen.matrix_world @ bones[0].head, *(seen.matrix_world @ bone.tail for bone in bones)]


def _jelly(head, tail):
    """The outline of a ball between the ends of a bone, as flat as the bone is short, as points in the plane of X and Z."""
    along = (tail - head) / 2.0
    across = along.cross(Vector((0.0, 1.0, 0.0))).normalized() * 0.4 * JELLY * (JELLY / (2.0 * along.length)) ** 0.5
    turns = [math.tau * step / 48 for step in range(49)]
    return [head + (1.0 - math.cos(turn)) * along + math.sin(turn) * across for turn in turns]


def _add_hook(place):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=HOOK, location=Vector(place) - Vector((0.0, 0.1, 0.0)))
    hook = bpy.context.object
    hook.data.materials.append(stage.glossy_material("Hook", (0.80, 0.05, 0.03, 1.0), 0.3))
    bpy.ops.object.shade_smooth()
