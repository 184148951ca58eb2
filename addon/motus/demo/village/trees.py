"""The trees of the village: firs, bare trees whose branches turn white, and the wood behind the village, of instanced firs."""

import math

import numpy as np

from ..places import landscape, woods
from ..stage import materials, shapes
from . import terrain

# Base, top and width of each cone of branches of a fir of height 1.
SKIRTS = ((0.08, 0.42, 0.26), (0.24, 0.58, 0.22), (0.40, 0.74, 0.175), (0.56, 0.88, 0.13), (0.72, 1.0, 0.085))
# x, y, height in m of the firs in the village.
NEAR = (
    (-3.2, 7.6, 3.4),
    (8.6, 8.4, 4.6),
    (10.4, 13.2, 6.6),
    (-11.2, 11.0, 6.2),
    (-9.9, 17.6, 7.4),
    (4.2, 19.0, 5.6),
    (5.6, 26.0, 7.8),
    (-6.4, 25.6, 8.2),
    (14.2, 17.5, 7.6),
    (-14.2, 16.0, 7.8),
    (0.9, 17.4, 2.6),
    (13.6, 26.0, 8.6),
)
# x, y, height in m and seed of the bare trees.
BARE = ((-5.0, 6.2, 4.6, 3), (2.1, 15.6, 4.4, 11), (7.0, 16.2, 5.2, 5))
SIDES = 6  # vertices around a branch
FORKS, SHRINK, LEAN = 4, 0.70, 0.62  # number of forks, factor of the length at each fork, lean at each fork in radians
TREES, CLEARING = 2600, 13.5


def build(collection, covered, branches):
    """Add firs and bare trees in the village, and the wood behind the village. branches: material of the wood's firs."""
    needles = materials.principled("Fir Needles", color=(0.016, 0.042, 0.030), roughness=0.85, specular=0.15)
    bark = terrain.mottled("Evening Bark", (0.035, 0.026, 0.022), (0.075, 0.058, 0.048), 9.0)
    builder = shapes.MeshBuilder()
    for number, (x, y, high) in enumerate(NEAR):
        _add_fir(builder, (x, y, terrain.ground_at(x, y) - 0.1), high, 2.4 * number)
    shapes.link_object(covered, "Firs", builder.build("Firs", [needles, bark]))
    builder = shapes.MeshBuilder()
    for x, y, high, seed in BARE:
        _add_bare_tree(builder, np.array((x, y, terrain.ground_at(x, y) - 0.1)), high, np.random.RandomState(seed))
    shapes.link_object(covered, "Bare Trees", builder.build("Bare Trees", [bark]))
    single = shapes.MeshBuilder()
    _add_fir(single, (0.0, 0.0, 0.0), 1.0, 0.0)
    fir = shapes.link_object(collection, "Wood Fir", single.build("Wood Fir", [branches, bark]))
    woods.add_forest(collection, "Wood", fir, _places(), (3.5, 8.5), terrain.SEED + 30)


def _add_fir(builder, place, high, turn):
    builder.add(shapes.upright(_scaled(shapes.lathe(((0.03, 0.2), (0.03, 0.0)), segments=7), high), place), 1)
    for number, (base, top, width) in enumerate(SKIRTS):
        middle = base + 0.45 * (top - base)
        profile = ((0.001, top), (width * 0.42, middle), (width, base))
        skirt = _ragged(shapes.lathe(profile, segments=18), width, turn + number)
        builder.add(shapes.upright(_scaled(skirt, high), place))


def _scaled(part, size):
    vertices, faces = part
    return vertices * size, faces


def _ragged(part, width, turn):
    """Return a cone of branches whose edge is wavy."""
    vertices, faces = part
    angle = np.arctan2(vertices[:, 2], vertices[:, 0])
    far = np.hypot(vertices[:, 0], vertices[:, 2]) / width
    wave = np.sin(9.0 * angle + 3.0 + turn)
    out = 1.0 + 0.20 * far * wave
    vertices = vertices * np.column_stack((out, np.ones_like(out), out))
    vertices[:, 1] -= 0.05 * far * (wave + 1.0) * width
    return vertices, faces


def _add_bare_tree(builder, place, high, random):
    """Add a bare tree: a trunk that forks into ever thinner branches."""
    trunk = 0.34 * high
    _add_branch(builder, place, np.array((0.03, 0.02, 1.0)), trunk, 0.045 * high, FORKS, random)


def _add_branch(builder, start, direction, length, radius, forks, random):
    direction = direction / np.linalg.norm(direction)
    end = start + length * direction
    thin = radius * (0.62 if forks else 0.35)
    builder.add(_tube(start, end, radius, thin))
    if not forks:
        return
    first = random.uniform(0.0, 2.0 * math.pi)
    aside, other = _across(direction)
    for number in range(3):
        turn = first + 2.0 * math.pi * (number + random.uniform(-0.2, 0.2)) / 3.0
        lean = LEAN * random.uniform(0.6, 1.35)
        out = math.cos(lean) * direction + math.sin(lean) * (math.cos(turn) * aside + math.sin(turn) * other)
        foot = start + random.uniform(0.7, 1.0) * length * direction
        _add_branch(builder, foot, out + (0.0, 0.0, 0.10), length * SHRINK * random.uniform(0.85, 1.1), thin, forks - 1, random)


def _across(direction):
    """Return two unit vectors that are perpendicular to a direction and to each other."""
    aside = np.cross(direction, (0.0, 1.0, 0.0) if abs(direction[1]) < 0.9 else (1.0, 0.0, 0.0))
    aside /= np.linalg.norm(aside)
    return aside, np.cross(direction, aside)


def _tube(start, end, wide, thin):
    aside, other = _across((end - start) / np.linalg.norm(end - start))
    around = [math.cos(turn) * aside + math.sin(turn) * other for turn in shapes.ring(SIDES)]
    rows = [
        [place + radius * out for out in around]
        for place, radius in ((start, wide), (0.5 * (start + end), 0.5 * (wide + thin)), (end, thin))
    ]
    vertices, faces = shapes.loft(np.array(rows))
    return vertices, faces[:, ::-1]


def _places():
    """Return places (m, 3) of the wood's firs: dense behind the village, a few at its sides, none in the village."""
    index = np.arange(TREES)
    luck = [landscape.lattice(index, np.full(TREES, row), terrain.SEED + 20) for row in range(3)]
    x, y = (luck[0] * 2.0 - 1.0) * 70.0, luck[1] * 95.0 - 6.0
    from_middle = np.hypot(x / 1.25, (y - 14.0) / 1.35)
    chance = landscape.smoothstep(from_middle, CLEARING, CLEARING + 12.0)
    keep = (luck[2] < chance) & (np.abs(x - 0.6) > 2.5 + 0.20 * (y + 8.0) * (y < 10.0))
    return np.column_stack((x, y, terrain.height(x, y) - 0.1))[keep]
