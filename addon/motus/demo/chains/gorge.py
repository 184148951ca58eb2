"""The place of the scene: two cliffs high above a lake, with grass, stones and the posts of the bridge. The dog's cliff is at +X."""

import math
import random

import numpy as np

from ..places import landscape, rocks, woods
from ..stage import bones, lighting, materials, shapes, staging

SEED = 23
OVER = (205.0, -300.0, 66.0)  # place of the scene's origin in the landscape, m
SPAN = 6.4  # m between the posts of the two cliffs, which stand at x = 0 and x = -SPAN
# Outlines of the cliffs' tops, x and y in m, counter-clockwise.
NEAR_CLIFF = (
    (-0.10, -0.9),
    (0.25, -2.0),
    (-0.15, -3.2),
    (0.7, -4.6),
    (1.6, -8.5),
    (7.5, -9.0),
    (9.5, -3.0),
    (7.5, 1.2),
    (3.2, 2.4),
    (0.6, 1.5),
    (-0.22, 0.6),
)
FAR_CLIFF = ((-6.2, -0.9), (-6.05, 0.3), (-6.3, 1.4), (-8.2, 3.6), (-12.5, 4.0), (-14.5, 0.8), (-12.0, -2.4), (-8.6, -2.6))
DEEP = 64.0  # m
BUMPS = 0.05  # m
POSTS = {(x, y): high for x in (0.03, -SPAN - 0.03) for y, high in ((-0.55, 1.12), (0.55, 2.15))}
"""Posts of the bridge: {(x, y): height}, m."""
# x, y, radius, height in m of the stones on the cliffs.
STONES = (
    (2.9, -0.9, 0.42, 0.34),
    (3.6, -0.3, 0.66, 0.62),
    (0.75, 1.1, 0.30, 0.22),
    (0.35, -3.55, 0.26, 0.17),
    (4.6, -2.2, 0.4, 0.26),
    (-7.6, 1.5, 0.6, 0.55),
    (-7.2, -1.3, 0.4, 0.3),
    (-8.8, 0.9, 0.9, 1.0),
    (2.05, 0.95, 0.24, 0.16),
)
TUFTS, BLADES = 900, 13
# x, y of groups of flowers, and how many there are in each.
FLOWERS = (
    (0.72, -3.05, 9),
    (0.52, -1.55, 8),
    (1.75, -3.35, 7),
    (2.4, -1.6, 8),
    (0.95, -4.1, 6),
    (1.3, -1.2, 6),
    (0.5, -2.55, 5),
    (2.9, -2.7, 6),
    (-7.0, -0.9, 6),
)
PETAL = 0.026  # length of a petal, m


def height(x, y):
    """Return the height of the cliffs' tops in m at arrays x and y, without the stones."""
    flat = landscape.smoothstep(np.minimum(np.hypot(x, y), np.hypot(x + SPAN, y)), 0.6, 1.4)
    return BUMPS * flat * (2.0 * landscape.fractal_noise(np.asarray(x) + 40.0, np.asarray(y) + 40.0, 2.6, 3, SEED) - 1.0)


def build(scene, cliffs, plants):
    """Add the land far below, the cliffs with posts and stones, and grass. Returns the haze's node group. cliffs, plants: collections."""
    sky = lighting.build_sky_group()
    scene.world = lighting.build_world(sky)
    haze = lighting.build_haze_group(sky)
    land = staging.new_collection(scene, "Landscape")
    landscape.build(land, haze)
    woods.build(land, haze)
    for thing in land.objects:
        if thing.parent is None:
            thing.location = [-place for place in OVER]
    rock = _cliff_rock()
    for name, outline in (("Near Cliff", NEAR_CLIFF), ("Far Cliff", FAR_CLIFF)):
        shapes.link_object(cliffs, name, _cliff(name, outline, rock))
    shapes.link_object(cliffs, "Gorge Stones", _stones())
    shapes.link_object(plants, "Bridge Posts", _posts())
    shapes.link_object(plants, "Gorge Grass", _grass())
    shapes.link_object(plants, "Gorge Flowers", _flowers())
    return haze


def _outline(points, count):
    """Return a smooth closed line through points at equal distances, (count, 2)."""
    points = np.asarray(points)
    knots = np.concatenate((points[-3:], points, points[:3]))
    curve = shapes.smooth_profile(np.column_stack((np.arange(len(knots)), knots)), 4000)
    curve = curve[(curve[:, 0] >= 3.0) & (curve[:, 0] <= 3.0 + len(points)), 1:]
    way = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))))
    wanted = np.linspace(0.0, way[-1], count, endpoint=False)
    return np.stack([np.interp(wanted, way, curve[:, axis]) for axis in range(2)], axis=1)


def _cliff(name, points, rock):
    """Make a cliff: its top falls away at the edge, and its sides have ledges and clefts."""
    rim = _outline(points, 260)
    middle, count = rim.mean(axis=0), len(rim)
    outwards = np.roll(rim, -1, axis=0) - np.roll(rim, 1, axis=0)
    outwards = np.column_stack((outwards[:, 1], -outwards[:, 0])) / np.linalg.norm(outwards, axis=1)[:, None]
    rows = []
    for share in (*np.linspace(0.02, 0.9, 34), *np.linspace(0.915, 1.0, 10)):
        x, y = (middle + share * (rim - middle)).T
        rows.append(np.column_stack((x, y, height(x, y) - 0.20 * landscape.smoothstep(share, 0.955, 1.0) ** 2)))
    edge, turn = rows[-1][:, 2], shapes.ring(count)
    depths = *np.linspace(0.06, 5.0, 64), *np.geomspace(5.3, DEEP, 36)
    rows += [np.column_stack((rim + outwards * _ledges(turn, depth)[:, None], edge - depth)) for depth in depths]
    builder = shapes.MeshBuilder()
    builder.add(shapes.loft(np.stack(rows)[:, ::-1]))
    x, y = middle
    builder.add((np.vstack((rows[0], [(x, y, float(height(x, y)))])), [(count, index, (index + 1) % count) for index in range(count)]))
    return builder.build(name, [rock])


def _ledges(turn, depth):
    """Return how far the side of a cliff stands out from its rim, m. turn: around the cliff, (n,), in radians. depth: below the rim, m."""
    # Noise on a cylinder has no seam.
    u, v = 7.0 * np.cos(turn), 7.0 * np.sin(turn)
    ledge = landscape.fractal_noise(u + 30.0, v + 30.0 + 0.9 * depth, 1.7, 4, SEED + 3) - 0.5
    cleft = landscape.ridged_noise(u + 60.0 + 0.10 * depth, v + 60.0, 1.3, 3, SEED + 9) - 0.45
    layer = landscape.fractal_noise(np.full(len(turn), 7.3), 1.9 * depth + 0.35 * np.sin(3.0 * turn), 1.0, 3, SEED + 5) - 0.5
    rough = landscape.smoothstep(depth, 0.0, 0.8) * (0.9 * ledge + 0.55 * cleft + 0.55 * layer)
    return (rough + 0.05 * depth - 0.12 * landscape.smoothstep(depth, 0.0, 0.3)) * min(1.0 + depth / 12.0, 2.6)


def _cliff_rock():
    """Make a material of layered rock with grass on what faces upwards."""
    material, shader, output = materials.new_material("Gorge Cliff")
    place = shader.add("ShaderNodeTexCoord").outputs["Object"]
    squeezed = shader.add("ShaderNodeVectorMath", {0: place, 1: (0.35, 0.35, 2.4)}, operation="MULTIPLY").outputs[0]
    layers = shader.noise(squeezed, 1.1, detail=8.0)
    grain = shader.noise(place, 6.0, detail=7.0)
    both = shader.math("ADD", shader.math("MULTIPLY", layers, 0.7), shader.math("MULTIPLY", grain, 0.3))
    stone = shader.ramp(both, ((0.34, (0.085, 0.066, 0.055)), (0.52, (0.27, 0.215, 0.17)), (0.68, (0.44, 0.37, 0.30))))
    cells = shader.add(
        "ShaderNodeTexVoronoi",
        {"Vector": shader.add("ShaderNodeVectorMath", {0: place, 1: (0.8, 0.8, 1.7)}, operation="MULTIPLY").outputs[0], "Scale": 1.15},
        feature="DISTANCE_TO_EDGE",
    ).outputs["Distance"]
    cracks = shader.ramp(shader.math("ADD", cells, shader.math("MULTIPLY", grain, 0.22)), ((0.10, (0.55,) * 3), (0.16, (1.0,) * 3)))
    stone = shader.mix(1.0, stone, cracks, blend="MULTIPLY")
    patches = shader.noise(place, 1.3, detail=6.0)
    tufts = shader.noise(place, 22.0, detail=5.0)
    green = shader.ramp(
        shader.math("ADD", shader.math("MULTIPLY", patches, 0.65), shader.math("MULTIPLY", tufts, 0.35)),
        ((0.36, (0.145, 0.105, 0.055)), (0.47, (0.085, 0.125, 0.022)), (0.62, (0.165, 0.205, 0.040))),
    )
    up = shader.add("ShaderNodeSeparateXYZ", {0: shader.add("ShaderNodeNewGeometry").outputs["Normal"]}).outputs[2]
    share = shader.math(
        "MULTIPLY", shader.math("SUBTRACT", shader.math("ADD", up, shader.math("MULTIPLY", patches, 0.5)), 0.98), 9.0, clamp=True
    )
    node = shader.add("ShaderNodeBsdfPrincipled")
    bump = shader.add("ShaderNodeBump", {"Height": both, "Strength": 0.55, "Distance": 0.10})
    materials.set_principled(shader, node, color=shader.mix(share, stone, green), roughness=0.92, specular=0.15, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (0.25, 0.22, 0.17, 1.0)
    return material


def _stones():
    builder, chance = shapes.MeshBuilder(), random.Random(SEED)
    for index, (x, y, radius, high) in enumerate(STONES):
        ground = float(height(np.array(x), np.array(y)))
        builder.add(rocks.boulder((x, y, ground), radius, high, chance, index))
    return builder.build("Gorge Stones", [rocks.mossy("Gorge Stone", (0.10, 0.088, 0.075), (0.34, 0.30, 0.25))])


def _posts():
    builder = shapes.MeshBuilder()
    for (x, y), high in POSTS.items():
        builder.add(
            shapes.upright(
                shapes.lathe(((0.0, high), (0.055, high - 0.004), (0.072, high - 0.03), (0.075, 0.2), (0.088, -0.4)), 18), (x, y, 0.0)
            )
        )
    return builder.build(
        "Bridge Posts", [materials.wood("Post Timber", (0.30, 0.185, 0.10), (0.115, 0.066, 0.035), (9.0, 9.0, 0.8), roughness=0.75)]
    )


def _flowers():
    """Make groups of flowers: thin stalks with five petals around a yellow middle."""
    builder, chance = shapes.MeshBuilder(), random.Random(SEED + 7)
    for index, (x, y, count) in enumerate(FLOWERS):
        for _ in range(count):
            place = np.array((x + chance.gauss(0.0, 0.16), y + chance.gauss(0.0, 0.12), 0.0))
            place[2] = float(height(place[0], place[1]))
            top = place + (chance.uniform(-0.03, 0.03), chance.uniform(-0.03, 0.03), chance.uniform(0.09, 0.20))
            line = np.linspace(place, top, 3)
            builder.add(bones.tube(line, 0.0028, sides=5, rings=1)[0], 0)
            builder.add(shapes.sphere(0.009, top, (1.0, 1.0, 0.7), 8, 6), 1)
            turn = chance.uniform(0.0, math.tau)
            for angle in turn + shapes.ring(5):
                ahead = np.array((math.cos(angle), math.sin(angle), 0.35))
                side = np.array((-math.sin(angle), math.cos(angle), 0.0))
                outline = ((0.2, 0.0), (0.65, 0.32), (1.0, 0.0), (0.65, -0.32))
                builder.add(([top + PETAL * (along * ahead + across * side) for along, across in outline], [(0, 1, 2, 3)]), 2 + index % 3)
    colors = (("Flower Stalk", (0.07, 0.13, 0.02)), ("Flower Middle", (0.85, 0.50, 0.03)))
    petals = (("White Petals", (0.85, 0.84, 0.80)), ("Blue Petals", (0.13, 0.11, 0.62)), ("Yellow Petals", (0.90, 0.62, 0.05)))
    return builder.build("Gorge Flowers", [materials.principled(name, color=color, roughness=0.7) for name, color in (*colors, *petals)])


def _grass():
    """Make tufts of grass on the cliffs, dense where the camera is near and along the edges."""
    builder, chance = shapes.MeshBuilder(), random.Random(SEED + 2)
    near, far = (_outline(points, 200) for points in (NEAR_CLIFF, FAR_CLIFF))
    for index in range(TUFTS):
        rim = far if index % 5 == 0 else near
        edge, middle = rim[chance.randrange(len(rim))], rim.mean(axis=0)
        x, y = middle + (edge - middle) * (1.0 - abs(chance.gauss(0.0, 0.30)) - 0.03)
        if (abs(y) < 0.75 and -SPAN - 1.0 < x < 1.6) or (rim is near and y > -3.3 and abs(y + 2.45 - 0.1 * x) < 0.35 and x > 0.9):
            continue
        ground = float(height(np.array(x), np.array(y)))
        for _ in range(BLADES):
            builder.add(rocks.blade((x + chance.gauss(0.0, 0.06), y + chance.gauss(0.0, 0.06), ground - 0.02), chance))
    return builder.build("Gorge Grass", [rocks.grass("Gorge Blades")])
