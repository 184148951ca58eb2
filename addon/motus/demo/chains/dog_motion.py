"""The motion of the dog: it trots up to the bridge on a walker's legs, and looks up, bows and wags by keys; tail, ears and leash are chains."""

import math

import bpy
import numpy as np
from mathutils import Vector

from ..stage import bones, keying, shapes
from . import dog_bones, pinning

# Keys of the dog: (frame, x, y, direction in which it looks, from +Y, counter-clockwise, in degrees).
WAY = ((1, 2.55, -2.86, 84.0), (12, 2.38, -2.84, 84.0), (52, 1.42, -2.67, 86.0), (66, 1.24, -2.65, 96.0), (74, 1.22, -2.65, 99.0))
COLLAR = (-0.072, 0.200, 0.545)  # where the leash begins, in the dog's space, m
KNOT = (0.03, -0.55, 1.03)  # middle of the leash's windings around the post of the bridge, m
BEFORE_POST = 0.085  # m from there to where the leash ends
LEASH_LENGTH, LEASH_BONES = 3.5, 28
BOW, BOW_END, UP = 97, 132, 148  # frames at which the dog is down, rises, and stands again
LAST = 192
TAIL = {"frequency": 2.6, "tip_frequency": 0.45, "damping": 0.22, "gravity": 0.35, "drag": 0.5, "bend_limit": math.radians(45.0)}
EARS = {"frequency": 0.8, "tip_frequency": 0.5, "damping": 0.3, "drag": 2.6, "bend_limit": math.radians(55.0), "thickness": 0.012}
LEASH = {"frequency": 0.0, "drag": 0.35, "thickness": 0.012}
# Balls that tail, ears and leash do not enter: (bone, place in rest pose, radius), m. The roots of the chains are outside of them.
BALLS = (
    (dog_bones.HEAD, (0.0, 0.335, 0.655), 0.085),
    (dog_bones.HEAD, (0.0, 0.400, 0.600), 0.085),
    (dog_bones.BODY, (0.0, 0.120, 0.395), 0.130),
    (dog_bones.BODY, (0.0, -0.160, 0.410), 0.115),
    (dog_bones.BODY, (-0.070, 0.150, 0.365), 0.085),
    (dog_bones.BODY, (0.070, 0.150, 0.365), 0.085),
)


def _end():
    """Return where the leash ends: on the side of the post that faces the dog."""
    return KNOT[0], KNOT[1] - BEFORE_POST, KNOT[2]


def leash():
    """Return the places of the leash's bones in rest pose, in the dog's space, from the collar to the post as the dog first stands."""
    _, x, y, turn = WAY[0]
    angle = math.radians(turn)
    away = np.subtract(_end(), (x, y, 0.0))
    end = np.array((math.cos(angle) * away[0] + math.sin(angle) * away[1], math.cos(angle) * away[1] - math.sin(angle) * away[0], away[2]))
    start, share = np.array(COLLAR), np.linspace(0.0, 1.0, 13)[:, None]
    straight = np.linalg.norm(end - start)
    sag = straight * math.sqrt(max(3.0 / 8.0 * (LEASH_LENGTH / straight - 1.0), 0.0))
    line = start + share * (end - start) - np.array((0.0, 0.0, 4.0 * sag)) * share * (1.0 - share)
    return bones.along(line, LEASH_BONES + 1)


def animate(collection, rig, grounds, wind):
    """Key the dog, and add its legs and chains with the public operators. grounds: collection of the meshes that it walks on."""
    _key_way(rig)
    _add_legs(rig, grounds)
    _key_pose(rig)
    balls = _add_colliders(collection, rig)
    pinning.add(rig, [bones.names(dog_bones.TAIL, 1)[0]], wind, **TAIL)
    pinning.add(rig, [bones.names(ear, 1)[0] for ear in dog_bones.EARS], wind, **EARS)
    pinning.add(rig, [bones.names(dog_bones.LEASH, 1)[0]], wind, **LEASH)
    rig.motus.chains.colliders = balls
    knot = shapes.link_object(collection, "Leash Knot", None)
    knot.location, knot.empty_display_size = _end(), 0.1
    pinning.pin(rig, bones.names(dog_bones.LEASH, LEASH_BONES)[-1], knot)


def _key_way(rig):
    for frame, x, y, turn in WAY:
        rig.location, rig.rotation_euler = (x, y, 0.0), (0.0, 0.0, math.radians(turn))
        rig.keyframe_insert("location", frame=frame)
        rig.keyframe_insert("rotation_euler", frame=frame)
    bpy.context.scene.frame_set(1)  # so that the dog stands where its first keys have it, while its legs are added


def _add_legs(rig, grounds):
    for name in dog_bones.LEGS:
        pinning.check(
            bpy.ops.motus.ik_add(
                object=rig.name,
                bone=dog_bones.LOWER + name,
                target=rig.name,
                target_bone=dog_bones.FOOT + name,
                chain_length=2,
                softness=0.02,
            )
        )
    pinning.check(
        bpy.ops.motus.walker_add(
            object=rig.name,
            body=dog_bones.BODY,
            grounds=grounds.name,
            gait="TROT",
            stride=0.19,
            cadence=1.6,
            clearance=0.06,
            frequency=3.0,
            damping=0.6,
            reach_up=0.3,
            reach_down=0.3,
        )
    )


def _key_pose(rig):
    """Key how the dog bows, looks up and wags."""
    pose = rig.pose.bones
    for bone in pose:
        bone.rotation_mode = "XYZ"
    down, up = math.radians(-15.0), 0.0
    body, neck, head, wag = (pose[name] for name in (dog_bones.BODY, dog_bones.NECK, dog_bones.HEAD, dog_bones.WAG))
    bow = ((80, up), (87, math.radians(2.0)), (BOW, down), (BOW + 14, 0.9 * down), (BOW_END, down), (UP, math.radians(1.5)), (UP + 10, up))
    keying.key(body, "rotation_euler", bow, 0)
    keying.key(body, "location", [(frame, 0.09 * angle / math.radians(15.0) if angle < 0.0 else 0.0) for frame, angle in bow], 2)
    lifted = ((1, 0.0), (60, 0.0), (76, 0.10), (86, 0.04), (BOW, 0.22), (BOW_END, 0.24), (UP, 0.06), (LAST, 0.10))
    keying.key(neck, "rotation_euler", lifted, 0)
    keying.key(head, "rotation_euler", [(frame, 0.6 * value) for frame, value in lifted], 0)
    turns = ((1, 0.0), (62, 0.0), (76, 0.42), (86, 0.36), (BOW, 0.20), (110, 0.05), (120, -0.05), (BOW_END, 0.05), (UP, 0.40), (LAST, 0.34))
    keying.key(head, "rotation_euler", turns, 2)
    tilts = ((1, 0.0), (70, 0.0), (78, 0.16), (84, 0.16), (92, 0.0), (UP, 0.0), (UP + 9, -0.20), (LAST, -0.18))
    keying.key(head, "rotation_euler", tilts, 1)
    for frame in range(1, LAST + 13, 6):
        wide = math.radians(14.0 if frame < 60 else 34.0 if BOW - 6 <= frame <= UP else 26.0)
        keying.key(wag, "rotation_euler", ((frame, wide if frame // 6 % 2 else -wide),), 2)


def _add_colliders(collection, rig):
    """Add what tail, ears and leash do not enter: balls in the dog, and the ground. Returns their collection."""
    balls = bpy.data.collections.new("Motus Dog Colliders")
    collection.children.link(balls)
    bpy.context.view_layer.update()
    for bone, place, radius in BALLS:
        ball = shapes.link_object(balls, f"Dog Ball {bone}", None, rig)
        ball.empty_display_type, ball.empty_display_size = "SPHERE", radius
        ball.parent_type, ball.parent_bone = "BONE", bone
        # An object on a bone stands at the bone's tail.
        carrier = rig.data.bones[bone]
        matrix = carrier.matrix_local.copy()
        matrix.translation = carrier.tail_local
        ball.location = matrix.inverted() @ Vector(place)
    plane = shapes.link_object(balls, "Dog Ground", None)
    plane.location.z = 0.01
    return balls
