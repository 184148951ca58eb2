"""A turntable in the garden: a wooden man walks on it, and a wooden horse goes from walk to trot, canter and gallop."""

import math

import bpy
import numpy as np
from mathutils import Vector

from ..stage import keying, materials, shapes
from . import garden

PLACE = (1.95, -4.55)
RADIUS, THICK, HIGH = 0.80, 0.05, 0.22  # m; height of the deck above the ground
# Turns by frame: of the deck, and of the man and the horse in the world.
DECK_TURNS = ((1, 0.0), (288, -0.9))
MAN_TURNS = ((1, 0.1), (288, 0.9))
HORSE_TURNS = ((1, 0.62), (80, 0.62), (150, 1.25), (220, 2.3), (288, 3.7))
HORSE_GAITS = ((1, "WALK"), (100, "TROT"), (160, "CANTER"), (210, "GALLOP"))
MAN_WAY, HORSE_WAY = 0.66, 0.44  # m from the middle of the deck
# x, y of each hip, and their height, m.
MAN_HIPS, MAN_HIGH = ((-0.035, 0.0), (0.035, 0.0)), 0.15
HORSE_HIPS, HORSE_HIGH = ((-0.035, 0.085), (0.035, 0.085), (-0.035, -0.085), (0.035, -0.085)), 0.14
ANKLE = 0.028
CAMERA, AIM, LENS = (-1.55, -1.0, 0.86), (0.0, 0.0, 0.04), 36.0  # m from the middle of the deck


def build(collection, views):
    """Add the turntable with its toys to a collection, and a camera that looks at them to the collection `views`."""
    wood = materials.wood("Toy Wood", (0.55, 0.33, 0.15), (0.36, 0.19, 0.07), (6.0, 6.0, 40.0))
    paints = [
        materials.principled(f"Toy {name}", color=color, roughness=0.4)
        for name, color in (("Red", (0.52, 0.05, 0.03)), ("Blue", (0.03, 0.12, 0.36)), ("White", (0.75, 0.7, 0.6)))
    ]
    x, y = PLACE
    middle = Vector((x, y, float(garden.height(np.array([x]), np.array([y]))[0]) + HIGH))
    carrier = shapes.link_object(collection, "Turntable", None)
    carrier.location, carrier.empty_display_size = middle, 0.2
    _turn(carrier, DECK_TURNS)
    deck = shapes.link_object(collection, "Turntable Deck", _deck(wood, paints), carrier)
    stand = shapes.link_object(collection, "Turntable Stand", _stand(wood))
    stand.location = middle
    man = _toy(collection, "Toy Man", (middle, MAN_TURNS, MAN_WAY), (MAN_HIPS, MAN_HIGH), _man(wood, paints), (wood, _shoe(paints[0])))
    _walk(man, deck, carrier, MAN_HIGH, gait="WALK", use_soles=True, heel=0.02, toe=0.05, clearance=0.025)
    horse = _toy(
        collection,
        "Toy Horse",
        (middle, HORSE_TURNS, HORSE_WAY),
        (HORSE_HIPS, HORSE_HIGH),
        _horse(wood, paints),
        (wood, _shoe(paints[1], 0.6)),
    )
    _walk(horse, deck, carrier, HORSE_HIGH, clearance=0.04, cadence=0.6)
    for frame, gait in HORSE_GAITS:
        horse.motus.walker.gait = gait
        horse.keyframe_insert("motus.walker.gait", frame=frame)
    _add_camera(views, middle)


def _turn(thing, turns):
    keying.key(thing, "rotation_euler", ((frame, math.tau * turn) for frame, turn in turns), 2)


def _toy(collection, name, way, legs, shape, parts):
    """Add a toy that goes around the turntable; returns its body, an empty that looks along its way.

    way: (middle of the turntable, turns by frame, distance from the middle). legs: (hips, their height). shape: mesh of what is seen of the
    body. parts: (material of the legs, mesh of the feet).
    """
    (middle, turns, distance), (hips, height), (wood, foot_mesh) = way, legs, parts
    pivot = shapes.link_object(collection, f"{name} Way", None)
    pivot.location, pivot.empty_display_size = middle, 0.05
    _turn(pivot, turns)
    body = shapes.link_object(collection, name, None, pivot)
    body.location.x, body.empty_display_size = distance, 0.05
    seen = shapes.link_object(collection, f"{name} Body", shape, body)
    for index, (x, y) in enumerate(hips):
        foot = shapes.link_object(collection, f"{name} Foot {index + 1}", foot_mesh)
        foot.parent, foot.location = body, (x, y, ANKLE)
        leg = shapes.link_object(collection, f"{name} Leg {index + 1}", _rod(wood), seen)
        leg.location = (x, y, height)
        reach = leg.constraints.new("STRETCH_TO")
        reach.target, reach.rest_length, reach.volume = foot, 1.0, "NO_VOLUME"
    bpy.context.view_layer.update()
    return body


def _walk(body, deck, carrier, height, **settings):
    feet = [child.name for child in body.children if " Foot " in child.name]
    seen = next(child for child in body.children if child.name.endswith(" Body"))
    done = bpy.ops.motus.walker_add(
        object=body.name,
        feet=",".join(feet),
        body=seen.name,
        ground=deck.name,
        carrier=carrier.name,
        ankle=ANKLE,
        use_natural=True,
        hip_height=height,
        frequency=3.0,
        body_tilt=0.3,
        **settings,
    )
    if done != {"FINISHED"}:
        raise RuntimeError(f"{body.name} could not be made to walk")


def _deck(wood, paints):
    builder = shapes.MeshBuilder()
    rim = ((0.0, 0.0), (RADIUS - 0.02, 0.0), (RADIUS, -0.015), (RADIUS, -THICK), (0.0, -THICK))
    builder.add(shapes.upright(shapes.lathe(rim, 96)), 0, smooth=False)
    for index in range(12):
        turn = math.tau * index / 12
        spot = shapes.sphere(0.03, (0.75 * math.cos(turn), 0.75 * math.sin(turn), 0.0), (1.0, 1.0, 0.12))
        builder.add(spot, 1 + index % 3)
    return builder.build("Turntable Deck", [wood, *paints])


def _stand(wood):
    builder = shapes.MeshBuilder()
    builder.add(shapes.upright(shapes.lathe(((0.0, -THICK), (0.10, -THICK), (0.07, -0.12), (0.30, -0.34), (0.0, -0.34)), 48)))
    return builder.build("Turntable Stand", [wood])


def _man(wood, paints):
    """The body above the hips, its origin on the ground."""
    builder = shapes.MeshBuilder()
    builder.add(
        shapes.upright(shapes.lathe(((0.0, 0.27), (0.03, 0.265), (0.045, 0.24), (0.052, 0.16), (0.045, 0.13), (0.0, 0.128)), 32)), 1
    )
    builder.add(shapes.sphere(0.042, (0.0, 0.0, 0.305)), 0)
    builder.add(
        shapes.upright(shapes.lathe(((0.0, 0.375), (0.024, 0.37), (0.03, 0.33), (0.055, 0.325), (0.055, 0.318), (0.0, 0.318)), 32)), 2
    )
    builder.add(shapes.sphere(0.008, (0.0, 0.042, 0.305)), 1)
    return builder.build("Toy Man", [wood, *paints])


def _horse(wood, paints):
    builder = shapes.MeshBuilder()
    builder.add(shapes.sphere(0.06, (0.0, 0.0, 0.17), (0.85, 2.1, 0.95)), 0)
    builder.add(shapes.sphere(0.035, (0.0, 0.13, 0.235), (0.7, 1.0, 2.0)), 0)
    builder.add(shapes.sphere(0.03, (0.0, 0.175, 0.295), (0.75, 1.7, 0.9)), 0)
    builder.add(shapes.sphere(0.02, (0.0, 0.105, 0.275), (0.4, 0.8, 2.4)), 3)
    builder.add(shapes.sphere(0.02, (0.0, -0.135, 0.16), (0.6, 0.8, 2.6)), 3)
    builder.add(shapes.sphere(0.045, (0.0, -0.01, 0.208), (1.0, 1.0, 0.5)), 1)
    return builder.build("Toy Horse", [wood, *paints])


def _shoe(paint, length=1.0):
    """A shoe whose origin is at its ankle, and which looks along +Y."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.sphere(0.026, (0.0, 0.014 * length, -0.012), (0.7, 1.5 * length, 0.62)))
    builder.add(shapes.sphere(0.015, (0.0, 0.0, 0.0)))
    return builder.build("Toy Shoe", [paint])


def _rod(wood):
    """A rod from the origin to 1 m along +Y, which a constraint stretches to the foot."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.lathe(((0.0, 1.0), (0.008, 1.0), (0.011, 0.0), (0.0, 0.0)), 12))
    return builder.build("Toy Leg", [wood])


def _add_camera(collection, middle):
    data = bpy.data.cameras.new("Toy Camera")
    data.lens, data.clip_start = LENS, 0.05
    camera = shapes.link_object(collection, "Toy Camera", data)
    camera.location = middle + Vector(CAMERA)
    camera.rotation_euler = (Vector(AIM) - Vector(CAMERA)).to_track_quat("-Z", "Y").to_euler()
    data.dof.use_dof, data.dof.focus_distance, data.dof.aperture_fstop = True, (Vector(AIM) - Vector(CAMERA)).length, 5.6
