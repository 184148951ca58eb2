"""The lookout: a wooden deck with a railing above the lake of the scene "Motus Flight", with a crate and flower pots."""

import math

import numpy as np

from ..flying import aeroplane
from ..places import landscape
from ..stage import materials, shapes
from . import flower

PLACE = (-103.7, -245.4, 31.0)  # of the deck in the land, m
HEADING = math.radians(-24.0)  # angle from the land's +Y to the deck's +Y, which points towards the lake

DECK_X, DECK_Y = (-0.68, 3.4), (-5.2, 1.06)
PLANK, GAP, PLANK_THICKNESS = 0.145, 0.008, 0.035
RAIL_Y, RAIL_X = 0.92, -0.53  # y of the railing behind the pilot, and x of the railing at the pilot's right hand
RAIL_TOP, RAIL_SIZE = 0.90, 0.075
POST, NEWEL_Y = 0.085, -0.14  # width of a post; y at which the railing at the right hand ends
BALL_RADIUS = 0.068
BALL_CENTRE = (RAIL_X, NEWEL_Y, 1.0)
CRATE = (1.30, 0.30, 0.44)  # x, y, height; m
MODEL_SCALE = 0.088
BALUSTER = (  # profile: radius, height; m
    (0.013, 0.89),
    (0.014, 0.82),
    (0.020, 0.78),
    (0.013, 0.74),
    (0.017, 0.62),
    (0.022, 0.52),
    (0.017, 0.42),
    (0.013, 0.28),
    (0.020, 0.24),
    (0.014, 0.20),
    (0.013, 0.15),
)
POT = (  # profile: radius, height; m
    (0.004, 0.27),
    (0.135, 0.27),
    (0.14, 0.30),
    (0.165, 0.305),
    (0.170, 0.28),
    (0.165, 0.25),
    (0.148, 0.245),
    (0.130, 0.12),
    (0.108, 0.0),
    (0.004, 0.0),
)
POTS = ((1.96, 0.62, 1.0), (2.34, 0.40, 0.72))  # x, y, size

# Material slots: the wood's fibres are along Y in planks, along Z in posts, along X in rails.
PLANKS, PLANKS_DARK, PLANKS_LIGHT, POSTS, RAILS, RAILS_DARK = range(6)


def add_stage(collection):
    """Add the empty to which everything on the lookout is parented: X to the pilot's left, -Y in the direction that the pilot faces."""
    stage = shapes.link_object(collection, "Lookout", None)
    stage.empty_display_size = 0.5
    stage.location, stage.rotation_euler.z = PLACE, HEADING
    return stage


def build(collection, stage):
    """Add deck, railing, crate and flower pots."""
    timber = _timber()
    shapes.link_object(collection, "Deck", _deck_mesh(timber), stage)
    shapes.link_object(collection, "Railing", _railing_mesh(timber), stage)
    _add_crate(collection, stage, timber)
    for index, (x, y, size) in enumerate((*POTS, (*flower.PLACE, flower.POT_SIZE))):
        pot = shapes.link_object(collection, f"Flower Pot {index + 1}", _pot_mesh(index), stage)
        pot.location, pot.scale = (x, y, 0.0), (size,) * 3


def _timber():
    """List the materials of wood for the material slots."""
    middle = ((0.31, 0.165, 0.078), (0.19, 0.092, 0.042))
    dark = ((0.235, 0.118, 0.056), (0.14, 0.064, 0.030))
    light = ((0.40, 0.225, 0.110), (0.27, 0.138, 0.064))
    along_x, along_y, along_z = (1.5, 28.0, 28.0), (28.0, 1.5, 28.0), (28.0, 28.0, 2.0)
    return [
        materials.wood(name, *colors, stretch, roughness=0.58)
        for name, colors, stretch in (
            ("Planks", middle, along_y),
            ("Dark Planks", dark, along_y),
            ("Light Planks", light, along_y),
            ("Posts", middle, along_z),
            ("Rails", light, along_x),
            ("Dark Rails", dark, along_x),
        )
    ]


# --- timber ----------------------------------------------------------------------------------------------------------


def _luck(index, salt):
    """Return a repeatable random value in [0, 1). index: of the part. salt: tells apart the several random values of one part."""
    return float(landscape.lattice(np.int64(index), np.int64(salt), landscape.SEED + 400))


def _add_beam(builder, size, centre, slot, bevel=0.006):
    builder.add(shapes.beam(size, centre, bevel), slot, smooth=False)


def _deck_mesh(timber):
    builder = shapes.MeshBuilder()
    count = int((DECK_X[1] - DECK_X[0]) / PLANK)
    for index in range(count):
        x = DECK_X[0] + (index + 0.5) * PLANK
        # Each row of the deck is two planks, which meet at a random place.
        joint = DECK_Y[0] + (0.25 + 0.5 * _luck(index, 1)) * (DECK_Y[1] - DECK_Y[0])
        for part, (start, end) in enumerate(((DECK_Y[0], joint - 0.003), (joint + 0.003, DECK_Y[1]))):
            slot = (PLANKS, PLANKS_DARK, PLANKS, PLANKS_LIGHT)[int(4 * _luck(index, 2 + part))]
            size = (PLANK - GAP, end - start, PLANK_THICKNESS)
            _add_beam(builder, size, (x, 0.5 * (start + end), -0.5 * PLANK_THICKNESS), slot, 0.004)
    for y in np.arange(DECK_Y[0] + 0.3, DECK_Y[1], 0.85):
        width = DECK_X[1] - DECK_X[0]
        _add_beam(builder, (width, 0.09, 0.16), (DECK_X[0] + width / 2, y, -PLANK_THICKNESS - 0.08), RAILS_DARK)
    for x in (DECK_X[0] + 0.12, DECK_X[1] - 0.12):
        for y in (DECK_Y[0] + 0.3, DECK_Y[1] - 0.12):  # type: ignore[assignment]
            _add_beam(builder, (0.18, 0.18, 11.0), (x, y, -5.7), POSTS)
    return builder.build("Deck", timber)


def _railing_mesh(timber):
    builder = shapes.MeshBuilder()
    posts = [(x, RAIL_Y) for x in np.arange(RAIL_X, DECK_X[1], 1.30)]
    for x, y in posts:
        _add_beam(builder, (POST, POST, RAIL_TOP), (x, y, RAIL_TOP / 2), POSTS)
    _add_newel(builder)
    back = DECK_X[1] - RAIL_X
    side = RAIL_Y - NEWEL_Y
    for height, depth in ((RAIL_TOP, 0.045), (0.14, 0.05)):
        _add_beam(builder, (back, RAIL_SIZE * 1.5, depth), (RAIL_X + back / 2, RAIL_Y, height), RAILS)
        _add_beam(builder, (RAIL_SIZE * 1.4, side, depth), (RAIL_X, NEWEL_Y + side / 2, height - 0.0004), PLANKS_LIGHT)
    for x in np.arange(RAIL_X + 0.13, DECK_X[1], 0.13):
        _add_baluster(builder, x, RAIL_Y)
    for y in np.arange(NEWEL_Y + 0.13, RAIL_Y - 0.06, 0.13):  # type: ignore[assignment]
        _add_baluster(builder, RAIL_X, y)
    return builder.build("Railing", timber)


def _add_baluster(builder, x, y):
    """Add a turned bar between the two rails."""
    builder.add(shapes.upright(shapes.lathe(shapes.smooth_profile_points(BALUSTER, 30), 12), (x, y, 0.0)), POSTS)


def _add_newel(builder):
    """Add the post at the railing's end, with the ball on which the pilot's hand rests."""
    x, y, z = BALL_CENTRE
    height = BALL_CENTRE[2] - 0.145
    _add_beam(builder, (POST, POST, height), (x, y, height / 2), POSTS)
    neck = (
        (0.030, z - 0.05),
        (0.026, z - 0.066),
        (0.045, z - 0.078),
        (0.060, z - 0.088),
        (0.062, height + 0.05),
        (0.058, height + 0.035),
        (0.052, height + 0.02),
        (0.066, height + 0.012),
        (0.066, height),
    )
    builder.add(shapes.upright(shapes.lathe(neck, 32), (x, y, 0.0)), POSTS)
    builder.add(shapes.sphere(BALL_RADIUS, BALL_CENTRE, segments=40, rings=26), POSTS)


# --- props -----------------------------------------------------------------------------------------------------------


def _add_crate(collection, stage, timber):
    """Add a crate, and on it a model of the aeroplane of the scene "Motus Flight"."""
    x, y, height = CRATE
    builder = shapes.MeshBuilder()
    width, depth = 0.62, 0.46
    boards = 3
    for row in range(boards):
        z = (row + 0.5) * height / boards
        tall = height / boards - 0.010
        slot = (RAILS, RAILS_DARK, RAILS)[row]
        for sign in (-1.0, 1.0):
            _add_beam(builder, (width, 0.018, tall), (0.0, sign * depth / 2, z), slot, 0.003)
            _add_beam(builder, (0.018, depth, tall), (sign * width / 2, 0.0, z), slot, 0.003)
    for sx in (-1.0, 1.0):
        for sy in (-1.0, 1.0):
            corner = (sx * (width / 2 - 0.02), sy * (depth / 2 + 0.018), height / 2)
            _add_beam(builder, (0.05, 0.02, height), corner, POSTS, 0.003)
    for index in range(4):
        middle = (0.0, (index - 1.5) * depth / 4, height + 0.009)
        _add_beam(builder, (width + 0.03, depth / 4 - 0.006, 0.018), middle, RAILS, 0.003)
    crate = shapes.link_object(collection, "Crate", builder.build("Crate", timber), stage)
    crate.location, crate.rotation_euler.z = (x, y, 0.0), math.radians(-9.0)
    _add_model(collection, stage, (x - 0.02, y, height + 0.018))


def _add_model(collection, stage, place):
    """Add a model of the aeroplane of the scene "Motus Flight", with a propeller that does not turn."""
    model = aeroplane.build(collection)
    model.name, model.parent = "Model Aeroplane", stage
    model.scale = (MODEL_SCALE,) * 3
    model.location = (place[0], place[1], place[2] + MODEL_SCALE * 1.52)
    model.rotation_euler = (math.radians(5.0), 0.0, math.radians(118.0))
    for part in model.children:
        if part.animation_data:
            part.driver_remove("rotation_euler", 1)
            part.rotation_euler.y = 0.6
        elif part.name.startswith("Propeller Disc"):
            part.hide_render = part.hide_viewport = True


def _pot_mesh(seed):
    """Make the mesh of a clay pot with geraniums."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.upright(shapes.lathe(POT, 40)), 0)
    for index in range(70):
        angle, spread = index * 2.39996, math.sqrt((index + 0.5) / 70.0)
        height = 0.33 + 0.17 * (1.0 - spread**2) + 0.05 * _luck(index, seed)
        place = np.array((0.21 * spread * math.cos(angle), 0.21 * spread * math.sin(angle), height))
        if _luck(index, seed + 5) < 0.66:
            flat = 0.34 + 0.3 * _luck(index, seed + 9)
            builder.add(shapes.sphere(0.050, place, (1.0, 1.0, flat), 10, 7), 1)
            continue
        for petal in range(5):
            around = petal * 0.4 * math.pi + angle
            offset = np.array((0.020 * math.cos(around), 0.020 * math.sin(around), 0.055))
            builder.add(shapes.sphere(0.019, place + offset, (1.0, 1.0, 0.6), 10, 7), 2)
    return builder.build(
        "Flower Pot",
        [
            materials.principled("Clay", color=(0.42, 0.135, 0.06), roughness=0.8),
            materials.principled("Geranium Leaves", color=(0.055, 0.150, 0.030), roughness=0.7),
            materials.principled("Geranium Blossoms", color=((0.75, 0.05, 0.06), (0.88, 0.72, 0.62))[seed % 2], roughness=0.6),
        ],
    )
