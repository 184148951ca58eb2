"""Rigs that nobody here made: Blender's bundled Rigify metarigs, a generated one, and random ones of every make."""

import functools
import itertools
import math
import random
import tempfile
from pathlib import Path

import addon_utils
import bpy
from mathutils import Matrix, Quaternion, Vector

import support
import toy_system

METARIGS = ("basic_human", "human", "basic_quadruped", "bird", "cat", "horse", "shark", "wolf")
INHERIT_SCALES = ('FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE', 'NONE_LEGACY')


_handlers = {}


def enable_rigify():
    """Switch Blender's bundled add-on on."""
    _handlers.update({name: list(found) for name in dir(bpy.app.handlers) if isinstance(found := getattr(bpy.app.handlers, name), list)})
    addon_utils.enable("rigify", default_set=True, persistent=True)


def metarig(name):
    """One of Rigify's example armatures, at rest, active and in Object Mode."""
    getattr(bpy.ops.object, f"armature_{name}_metarig_add")()
    if bpy.context.mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')
    return bpy.context.object


_GENERATE = """
import bpy, rig_samples
rig_samples.enable_rigify()
bpy.ops.wm.read_homefile(use_empty=True)
rig_samples.metarig("basic_human")
bpy.ops.pose.rigify_generate()
bpy.ops.object.mode_set(mode='OBJECT')
bpy.ops.wm.save_as_mainfile(filepath={path!r})
"""


@functools.cache
def _generated_human():
    """(path of its file, what deletes it at the end)."""
    folder = tempfile.TemporaryDirectory(prefix="motus-test-")
    path = str(Path(folder.name, "human.blend"))
    status, said = support.run_blender(_GENERATE.format(path=path))
    assert status == 0, said
    return path, folder


def generated_human():
    """The control rig that Rigify makes of its basic human, in a file of its own that is opened.

    It is made in another process: Rigify reads bpy.context.layer_collection, which spoils the context for good (docs/gotchas.md).
    """
    bpy.ops.wm.open_mainfile(filepath=_generated_human()[0])
    return bpy.context.object


def disable_rigify():
    """Leave the add-ons as they were, without the handlers of generated rigs' scripts, which stay otherwise."""
    addon_utils.disable("rigify", default_set=True)
    for name, found in _handlers.items():
        getattr(bpy.app.handlers, name)[:] = found


def pose_at_random(rig, generator, amount=0.4, scale=0.0):
    """Turn every bone, and scale it by up to `scale` of its size, each axis by itself."""
    for bone in rig.pose.bones:
        bone.rotation_mode = 'QUATERNION'
        bone.rotation_quaternion = random_rotation(generator, amount)
        if scale:
            bone.scale = [1.0 + generator.uniform(-scale, scale) for _ in range(3)]


def random_rotation(generator, largest=math.pi):
    """A rotation about any axis."""
    axis = Vector([generator.gauss(0.0, 1.0) for _ in range(3)])
    return Quaternion(axis, generator.uniform(-largest, largest))


def random_rig(generator, bones=3, inherit_scale='FULL', is_connected=True, sideways=True):
    """A parent bone and a chain "Chain.0", "Chain.1", ... with rolls of its own on it."""
    rig = toy_system.new_object("Rig", data=bpy.data.armatures.new("Rig"))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    parent = rig.data.edit_bones.new("Parent")
    parent.head, parent.tail, parent.roll = (0.1, 0.2, -0.3), (0.2, 0.1, 0.6), 0.3
    place = Vector((0.3, 0.1, 0.7))
    for index in range(bones):
        bone = rig.data.edit_bones.new(f"Chain.{index}")
        step = Vector((generator.uniform(0.4, 0.8), generator.uniform(-0.3, 0.3), generator.uniform(-0.3, 0.3)))
        bone.head, bone.tail, bone.roll = place, place + step, generator.uniform(-3.0, 3.0)
        bone.parent, parent = parent, bone
        bone.use_connect = is_connected and index > 0
        bone.inherit_scale = inherit_scale
        place = place + step
        if sideways and not bone.use_connect:
            place = place + Vector((0.0, 0.05, 0.03))
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def place_at_random(rig, generator, scale=(1.0, 1.0, 1.0)):
    """Move and turn the armature object, and scale it."""
    rig.location = [generator.uniform(-3.0, 3.0) for _ in range(3)]
    rig.rotation_mode = 'QUATERNION'
    rig.rotation_quaternion = random_rotation(generator)
    rig.scale = scale


def evaluated_bone(rig, name):
    """(matrix_world, PoseBone) of the evaluated rig."""
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return evaluated.matrix_world, evaluated.pose.bones[name]


def tip(rig, name):
    """Where the tail of a bone really is, in world space."""
    world, bone = evaluated_bone(rig, name)
    return world @ bone.matrix @ Vector((0.0, bone.bone.length, 0.0))


def joints(rig, name, count):
    """Joints of the chain of `count` bones that ends in a bone, root first, in world space as evaluated."""
    world, bone = evaluated_bone(rig, name)
    points = [world @ bone.matrix @ Vector((0.0, bone.bone.length, 0.0))]
    for _ in range(count):
        points.append(world @ bone.matrix.translation)
        bone = bone.parent
    return points[::-1]


def lengths(points):
    """Distances from joint to joint."""
    return [(after - before).length for before, after in itertools.pairwise(points)]


def random_reachable(points, generator, margin=0.02):
    """A point that the chain of these joints can reach whatever its pose."""
    parts = lengths(points)
    longest = max(parts)
    far, near = sum(parts), max(0.0, 2.0 * longest - sum(parts))
    distance = near + (far - near) * generator.uniform(margin, 1.0 - margin)
    direction = Vector([generator.gauss(0.0, 1.0) for _ in range(3)]).normalized()
    return points[0] + distance * direction


def same_matrix(one, other, tolerance=1e-5):
    """Whether two matrices agree, relative to the larger numbers."""
    size = max(1.0, *(abs(value) for row in other for value in row))
    return all(abs(a - b) <= tolerance * size for r, s in zip(one, other) for a, b in zip(r, s))


def pose_of(rig):
    """Evaluated matrices of all bones by name."""
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return {bone.name: Matrix(bone.matrix) for bone in evaluated.pose.bones}


def new_generator(seed):
    """Random numbers that are the same in every run."""
    return random.Random(seed)
