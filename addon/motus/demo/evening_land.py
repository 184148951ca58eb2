"""The land of the evening scene: snowy ground that rises to a wood of firs, with hills behind."""

import math

import numpy as np

from . import landscape, materials, shapes, woods

SEED = 77
HALF = 90.0  # m, half the side of the ground
GRID = 260
CABIN = (3.6, 13.5)  # where the ground is level
PATH = ((0.8, -12.0), (0.4, 0.0), (1.2, 6.0), (3.0, 10.5))  # trodden to the cabin
WHITE, SHADE = (0.86, 0.90, 0.97), (0.62, 0.70, 0.86)
TREES, CLEARING = 2600, 9.5
# A fir of unit height: base, top and width of each skirt.
SKIRTS = ((0.08, 0.42, 0.26), (0.24, 0.58, 0.22), (0.40, 0.74, 0.175), (0.56, 0.88, 0.13), (0.72, 1.0, 0.085))


def height(x, y):
    """Height of the ground in metres at arrays of x and y."""
    rolling = 1.7 * (landscape.fractal_noise(x, y, 16.0, 4, SEED) - 0.5)
    rise = 7.0 * landscape.smoothstep(np.asarray(y, float), 20.0, 70.0) + 0.10 * np.maximum(np.abs(x) - 12.0, 0.0)
    hills = 16.0 * landscape.smoothstep(np.hypot(x, y), 60.0, 90.0) * landscape.fractal_noise(x, y, 45.0, 3, SEED + 9)
    far = np.hypot(np.asarray(x) - CABIN[0], np.asarray(y) - CABIN[1])
    level = landscape.smoothstep(far, 2.6, 7.0)
    return level * rolling + rise + hills - 0.16 * _trodden(x, y)


def _trodden(x, y):
    """How much of a place is path, 0 to 1."""
    nearest = np.full(np.broadcast(x, y).shape, np.inf)
    for (ax, ay), (bx, by) in zip(PATH, PATH[1:]):
        along = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2), 0.0, 1.0)
        nearest = np.minimum(nearest, np.hypot(x - ax - along * (bx - ax), y - ay - along * (by - ay)))
    return 1.0 - landscape.smoothstep(nearest, 0.25, 0.75)


def build(collection, snow):
    """Ground and firs. snow: the ground's material."""
    axis = np.linspace(-1.0, 1.0, GRID)
    warped = HALF * (0.25 * axis + 0.75 * axis ** 3)
    x, y = np.meshgrid(warped, warped + 8.0)
    builder = shapes.MeshBuilder()
    builder.add(shapes.loft(np.stack((x, y, height(x, y)), axis=-1), closed=False))
    shapes.link_object(collection, "Snowy Ground", builder.build("Snowy Ground", [snow]))
    woods.add_forest(collection, "Snowy Firs", _fir(collection), _places(), (3.5, 8.5), SEED + 30)


def _places():
    """Places (m, 3) of firs: dense behind, a few at the sides, none before the cabin or on the path."""
    index = np.arange(TREES)
    luck = [landscape.lattice(index, np.full(TREES, row), SEED + 20) for row in range(3)]
    x, y = (luck[0] * 2.0 - 1.0) * 70.0, luck[1] * 85.0 - 6.0
    from_middle = np.hypot(x / 1.25, (y - 9.0) / 1.35)
    chance = landscape.smoothstep(from_middle, CLEARING, CLEARING + 12.0)
    keep = (luck[2] < chance) & (np.abs(x - 0.6) > 2.5 + 0.16 * (y + 8.0) * (y < 8.0))
    return np.column_stack((x, y, height(x, y) - 0.1))[keep]


def _fir(collection):
    """A fir of unit height whose branches carry snow."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.upright(shapes.lathe(((0.03, 0.2), (0.03, 0.0)), segments=7)), 1)
    for base, top, width in SKIRTS:
        middle = base + 0.45 * (top - base)
        profile = ((0.001, top), (width * 0.42, middle), (width, base), (0.02, base + 0.05))
        builder.add(shapes.upright(_ragged(shapes.lathe(profile, segments=18), width)))
    mesh = builder.build("Snowy Fir", [_branch_material(), materials.principled("Evening Bark", color=(0.05, 0.035, 0.03))])
    return shapes.link_object(collection, "Snowy Fir", mesh)


def _ragged(part, width):
    """A skirt whose edge goes in and out, branch by branch."""
    vertices, faces = part
    angle = np.arctan2(vertices[:, 2], vertices[:, 0])
    far = np.hypot(vertices[:, 0], vertices[:, 2]) / width
    out = 1.0 + 0.20 * far * np.sin(9.0 * angle + 3.0)
    vertices = vertices * np.column_stack((out, np.ones_like(out), out))
    vertices[:, 1] -= 0.05 * far * (np.sin(9.0 * angle + 3.0) + 1.0) * width
    return vertices, faces


def snow_material():
    """Snow: white, a little blue where it is hollow, with fine grain."""
    material, shader, output = materials.new_material("Evening Snow")
    position = shader.add("ShaderNodeNewGeometry").outputs["Position"]
    color = shader.ramp(shader.noise(position, 0.6, detail=6.0), ((0.35, SHADE), (0.65, WHITE)))
    bump = shader.add("ShaderNodeBump", {"Height": shader.noise(position, 7.0, detail=8.0), "Strength": 0.35, "Distance": 0.05})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.6, specular=0.35, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*WHITE, 1.0)
    return material


def covered(name, color, least=0.35, roughness=0.8):
    """A material that carries snow wherever it faces up."""
    material, shader, output = materials.new_material(name)
    geometry = shader.add("ShaderNodeNewGeometry")
    up = shader.add("ShaderNodeSeparateXYZ", {0: geometry.outputs["Normal"]}).outputs[2]
    grain = shader.math("MULTIPLY", shader.math("SUBTRACT", shader.noise(geometry.outputs["Position"], 3.0), 0.5), 0.5)
    lies = shader.math("MULTIPLY", shader.math("SUBTRACT", shader.math("ADD", up, grain), least), 6.0, clamp=True)
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(
        shader, node, color=shader.mix(lies, (*color, 1.0), (*WHITE, 1.0)), roughness=roughness, specular=0.2)
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*color, 1.0)
    return material


def _branch_material():
    return covered("Snowy Needles", (0.018, 0.045, 0.032), least=0.12)


def ground_at(x, y):
    """Height of the ground in metres at one place."""
    return float(height(np.array([x], float), np.array([y], float))[0])


def turned(vertices, angle):
    """Vertices (n, 3) turned about Z."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.asarray(vertices) @ np.array(((cosine, sine, 0.0), (-sine, cosine, 0.0), (0.0, 0.0, 1.0)))
