"""A second system, for the tests of what all systems share: things that circle a target.

The owner itself circles, or a bone of it (`bone`), or a list of other objects (`followers`), each one step behind the
one before.
"""

import math

import bpy
from mathutils import Euler, Quaternion, Vector

import support

core = support.addon("core.declare")
settings = support.addon("core.settings")
deleted = support.addon("core.file.deleted")
TILT = Euler((0.3, -0.2, 0.1)).to_quaternion()
STEP = 0.25

solve_calls = 0
"""How often solve() was called."""

NO_TARGET = core.Problem("The orbit needs a target")
NO_RADIUS = core.Problem("The orbit has no radius", blocking=False)


class MOTUS_PG_toy_follower(bpy.types.PropertyGroup):
    object: bpy.props.PointerProperty(type=bpy.types.Object)


class MOTUS_PG_orbit(settings.SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(default=1.0, min=0.0, max=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    target: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    radius: bpy.props.FloatProperty(default=2.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    speed: bpy.props.FloatProperty(default=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    use_location: bpy.props.BoolProperty(default=True, update=settings.rewire)
    use_rotation: bpy.props.BoolProperty(default=True, update=settings.rewire)
    bone: bpy.props.StringProperty(update=settings.rewire)
    followers: bpy.props.CollectionProperty(type=MOTUS_PG_toy_follower)


def pose(target, radius, speed, seconds, index=0):
    """Location and rotation, in world space, of the thing `index` that circles the matrix `target`."""
    angle = speed * seconds - STEP * index
    offset = radius * Vector((math.cos(angle), math.sin(angle), 0.1 * math.sin(3.0 * angle)))
    return target.translation + offset, Quaternion((0.0, 0.0, 1.0), angle) @ TILT


def solve(context, target, radius, speed):
    global solve_calls
    solve_calls += 1
    if target is None or deleted.is_deleted(context.settings.target):
        return NO_TARGET
    for index in range(len(context.locations)):
        location, rotation = pose(target, radius, speed, context.frame / context.fps, index)
        context.locations[index] = location
        context.rotations[index] = rotation
    context.outputs[0] = speed * context.frame / context.fps
    return NO_RADIUS if radius == 0.0 else core.OK


def channels(settings):
    return frozenset(name for name in ("location", "rotation") if getattr(settings, f"use_{name}"))


def members(owner):
    settings = owner.motus.orbit
    if settings.followers:
        return [one.object for one in settings.followers if one.object]
    if settings.bone:
        bone = owner.pose.bones.get(settings.bone)
        return [bone] if bone else []
    return [owner]


SYSTEM = core.System(
    name="orbit",
    label="Orbit",
    settings=MOTUS_PG_orbit,
    classes=(MOTUS_PG_toy_follower, MOTUS_PG_orbit),
    inputs=(core.Matrix("target", of="target"), core.Setting("radius"), core.Setting("speed")),
    solve=solve,
    problems=(NO_TARGET, NO_RADIUS),
    outputs=("angle",),
    channels=channels,
    members=members,
)


def register():
    """Register the add-on once more, with this system in its list."""
    support.register_systems(SYSTEM)


def unregister():
    """Leave the add-on as it was installed."""
    support.unregister_systems(SYSTEM)


def new_object(name, location=(0.0, 0.0, 0.0), data=None):
    """An object, an empty unless data is given, in the scene."""
    return support.link(name, data, location)


def new_rig(name="Rig", bones=3):
    """An armature with a chain of bones "Bone.0", "Bone.1", ... that are not connected."""
    rig = new_object(name, data=bpy.data.armatures.new(name))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for index in range(bones):
        bone = rig.data.edit_bones.new(f"Bone.{index}")
        bone.head, bone.tail = (0.1, 0.0, index), (0.2, 0.1 * index, index + 0.8)
        bone.roll = 0.4 * index
        bone.parent, parent = parent, bone
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def new_target():
    """An empty that moves along X by keys, 0.1 a frame, away from the origin."""
    target = new_object("Target", (1.0, 2.0, 3.0))
    curve = target.driver_add("location", 0)
    curve.driver.expression = "1.0 + 0.1*frame"
    return target


def orbit(owner, target, **settings):
    """Attach the system to an owner; returns its settings. followers: objects."""
    group = owner.motus.orbit
    for follower in settings.pop("followers", ()):
        group.followers.add().object = follower
    for name, value in settings.items():
        setattr(group, name, value)
    group.target = target
    support.addon("core.wiring").attach(SYSTEM, owner)
    return group


def expected(owner, index=0):
    """What pose() says for the present frame and the owner's settings: (location, rotation)."""
    scene, settings = bpy.context.scene, owner.motus.orbit
    target = settings.target.evaluated_get(bpy.context.evaluated_depsgraph_get())
    seconds = scene.frame_current_final * scene.render.fps_base / scene.render.fps
    return pose(target.matrix_world, settings.radius, settings.speed, seconds, index)


def world_matrix(thing):
    """Evaluated matrix in world space of an Object or PoseBone."""
    evaluated = thing.id_data.evaluated_get(bpy.context.evaluated_depsgraph_get())
    if isinstance(thing, bpy.types.PoseBone):
        return evaluated.matrix_world @ evaluated.pose.bones[thing.name].matrix
    return evaluated.matrix_world.copy()
