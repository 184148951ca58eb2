"""A rope bridge: planks on two ropes and two handrails, all of them chains that are pinned at their far ends."""

import math

import numpy as np

from ..stage import bones, materials, shapes
from . import gorge, pinning

COUNT = 28  # bones of each rope, with a plank each
SLACK = 1.022  # length of a rope, in distances between its ends
DECK, RAILS = {"deck.L": (0.40, 0.0), "deck.R": (-0.40, 0.0)}, {"rail.L": (0.52, 0.92), "rail.R": (-0.52, 0.92)}
"""Ropes: {name: (y, height of its ends)}, m."""
ROPE_RADIUS, PLANK = 0.019, (0.155, 1.02, 0.032)  # m
LOAD_SIZE = 2.6  # radius in m of the balls that press the ropes down where somebody walks
LOAD = 0.45  # how far down the ropes are pressed amid the bridge, from 0, where they would hang, to 1, where they would be taut
PLANK_TOP = 0.045  # height of the planks above the ropes, m


def hanging(count):
    """Return (x, height) of `count` places at equal distances along a rope that hangs between its ends: a catenary."""
    low, high = 1e-3, 10.0
    for _ in range(80):
        half = 0.5 * (low + high)  # half of the span, in parameters of the catenary
        low, high = (low, half) if math.sinh(half) / half > SLACK else (half, high)
    scale = 0.5 * gorge.SPAN / half
    arc = np.linspace(-1.0, 1.0, count) * scale * math.sinh(half)
    x = scale * np.arcsinh(arc / scale)
    return np.column_stack((-0.5 * gorge.SPAN + x, scale * (np.cosh(x / scale) - math.cosh(half))))[::-1]


def way(count):
    """Return (x, height) of `count` places on the way over the bridge, on the planks where the ropes are pressed down."""
    x, high = hanging(400)[::-1].T
    wanted = np.linspace(-gorge.SPAN, 0.0, count)
    longest, focus = 0.5 * SLACK * gorge.SPAN, 0.5 * gorge.SPAN
    # A weight on a rope that does not stretch moves on an ellipse whose foci are the rope's ends.
    taut = -math.sqrt(longest**2 - focus**2) * np.sqrt(1.0 - ((wanted + focus) / longest) ** 2)
    loose = np.interp(wanted, x, high)
    load = LOAD * (1.0 - ((wanted + focus) / focus) ** 2)
    return np.column_stack((wanted, loose + load * (taut - loose) + PLANK_TOP))


def build(context, collection, ends, wind):
    """Build the bridge with its chains. ends: collection of the empties that its far ends are pinned to. Returns its two rigs."""
    places = hanging(COUNT + 1)
    rigs = []
    for name, ropes in (("Bridge Deck", DECK), ("Bridge Rails", RAILS)):
        armature = bones.Armature(context, collection, name)
        with armature:
            for rope, (y, high) in ropes.items():
                armature.add_row(rope, "", _at(places, y, high))
        rigs.append(armature.object)
    deck, rails = rigs
    hemp = materials.principled("Bridge Hemp", color=(0.42, 0.30, 0.16), roughness=0.9, specular=0.1)
    _add_deck(collection, deck, places, hemp)
    _add_rails(collection, rails, places, hemp)
    _add_hangers(collection, deck, rails, places, hemp)
    _add_windings(collection, hemp)
    for rig, ropes, settings in ((deck, DECK, {"drag": 0.22}), (rails, RAILS, {"drag": 0.45})):
        pinning.hang(rig, [bones.names(rope, COUNT) for rope in ropes], ends, wind, **settings)
    return rigs


def press(spider, rigs, collections):
    """Let the ropes be pressed down where the spider is: each rig gets a ball above the spider. collections: one for each ball."""
    for rig, ropes, collection in zip(rigs, (DECK, RAILS), collections):
        side, high = next(iter(ropes.values()))
        ball = shapes.link_object(collection, f"{rig.name} Load", None, spider)
        ball.empty_display_type, ball.empty_display_size = "SPHERE", LOAD_SIZE
        # The ropes touch the ball at its sides, above its lowest place.
        ball.location.z = math.sqrt(LOAD_SIZE**2 - side**2) + high - PLANK_TOP
        rig.motus.chains.colliders = collection


def _at(places, y, high):
    return np.column_stack((places[:, 0], np.full(len(places), y), places[:, 1] + high))


def _add_rope(skin, rope, places):
    """Add a rope along a row of bones."""
    part, at = bones.tube(places, ROPE_RADIUS, sides=10)
    skin.add(part, 0, bones.shares_along(bones.names(rope, COUNT), at))


def _add_deck(collection, rig, places, hemp):
    """Add the ropes of the deck with the planks on them. A plank's ends go with the bones of both ropes."""
    skin, chance = bones.Skin(), np.random.RandomState(5)
    for rope, (y, high) in DECK.items():
        _add_rope(skin, rope, _at(places, y, high))
    left, right = (bones.names(rope, COUNT) for rope in DECK)
    wide = abs(DECK["deck.L"][0])
    for index in range(COUNT):
        middle, along = 0.5 * (places[index] + places[index + 1]), places[index + 1] - places[index]
        turn = math.atan2(along[1], along[0]) - math.pi
        size = PLANK * (1.0 + 0.05 * chance.uniform(-1.0, 1.0, 3))
        vertices, faces = shapes.beam(size, (0.0, 0.02 * chance.uniform(-1.0, 1.0), PLANK_TOP - 0.5 * PLANK[2]), 0.006)
        skew = 0.03 * chance.uniform(-1.0, 1.0)
        x, z = vertices[:, 0] + skew * vertices[:, 1], vertices[:, 2]
        turned = np.column_stack(
            (middle[0] + math.cos(turn) * x - math.sin(turn) * z, vertices[:, 1], middle[1] + math.sin(turn) * x + math.cos(turn) * z)
        )
        share = 0.5 + 0.5 * turned[:, 1] / wide
        skin.add(
            (turned, faces),
            1 + index % 3,
            {left[index]: np.clip(share, 0.0, 1.0), right[index]: np.clip(1.0 - share, 0.0, 1.0)},
            smooth=False,
        )
    timbers = (
        ((0.36, 0.25, 0.155), (0.17, 0.115, 0.07)),
        ((0.30, 0.215, 0.145), (0.13, 0.09, 0.06)),
        ((0.42, 0.30, 0.19), (0.21, 0.145, 0.09)),
    )
    slots = [
        hemp,
        *(materials.wood(f"Plank {index}", *colors, (16.0, 1.3, 16.0), roughness=0.75) for index, colors in enumerate(timbers, 1)),
    ]
    bones.carry(skin.finish(collection, "Bridge Planks", slots), rig)


def _add_rails(collection, rig, places, hemp):
    skin = bones.Skin()
    for rope, (y, high) in RAILS.items():
        _add_rope(skin, rope, _at(places, y, high))
    bones.carry(skin.finish(collection, "Bridge Handrails", [hemp]), rig)


def _add_windings(collection, hemp):
    """Add the windings by which the handrails hold on to the posts."""
    builder = shapes.MeshBuilder()
    for x, y in gorge.POSTS:
        for turn in range(4):
            place = x, y, RAILS["rail.L"][1] + 0.036 * (turn - 1.5)
            builder.add(shapes.upright(shapes.torus(0.080, ROPE_RADIUS, 40, 10), place))
    shapes.link_object(collection, "Bridge Windings", builder.build("Bridge Windings", [hemp]))


def _add_hangers(collection, deck, rails, places, hemp):
    """Add thin ropes from the handrails to the deck: one end of each goes with the one rig, one end with the other."""
    skin = bones.Skin()
    for (upper, (y, high)), (lower, (near, low)) in zip(RAILS.items(), DECK.items()):
        for index in range(1, COUNT, 2):
            ends = np.array([(places[index][0], y, places[index][1] + high), (places[index][0], near, places[index][1] + low)])
            (vertices, faces), at = bones.tube(ends, 0.0085, sides=8, across=(1.0, 0.0, 0.0), rings=1)
            carrier = {bones.names(upper, COUNT)[index]: (at < 0.5) * 1.0, bones.names(lower, COUNT)[index]: (at > 0.5) * 1.0}
            skin.add((vertices, faces), 0, carrier)
    bones.carry(skin.finish(collection, "Bridge Hangers", [hemp]), deck, rails)
