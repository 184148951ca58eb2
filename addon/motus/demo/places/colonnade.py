"""A plain of sand with dunes, and the columns of an old temple at several distances from the camera."""

import numpy as np

from ..stage import materials, shapes
from . import landscape

SEED = 311
REACH, GRID = 1500.0, 220  # half the side of the ground in m, and vertices along a side
LEVEL, DUNES = 130.0, 420.0  # m from the temple: where the plain ends, and where the dunes are high
DUNE_HEIGHT = 46.0
# x, y, height in m of each column; lower ones are broken.
COLUMNS = (
    (-21.0, 25.0, 14.0),
    (-4.0, 28.0, 14.0),
    (18.0, 15.0, 5.2),
    (25.0, 32.0, 14.0),
    (-2.0, 38.0, 7.5),
    (20.0, 48.0, 14.0),
    (-25.0, 48.0, 11.0),
    (-32.0, 72.0, 14.0),
    (-3.0, 72.0, 14.0),
    (27.0, 58.0, 14.0),
    (-8.0, 86.0, 14.0),
    (16.0, 92.0, 9.0),
    (39.0, 62.0, 14.0),
    (-44.0, 60.0, 14.0),
    (47.0, 92.0, 14.0),
    (-46.0, 104.0, 14.0),
    (8.0, 72.0, 14.0),
    (22.0, 118.0, 14.0),
    (-16.0, 122.0, 14.0),
)
WHOLE = 14.0
LINTELS = ((8, 16), (5, 9), (7, 13))  # columns that carry a beam together
RADIUS, FLUTES, FLUTE_DEPTH = 1.05, 20, 0.055
SEGMENTS = 8 * FLUTES
SAND, SHADE = (0.56, 0.35, 0.18), (0.40, 0.23, 0.11)
STONE, STAIN = (0.66, 0.55, 0.40), (0.40, 0.30, 0.20)


def build(collection, haze):
    """Add ground, columns, beams and fallen stones. haze: node group of the haze."""
    sand = _weathered("Desert Sand", haze, SHADE, SAND, 0.25, roughness=0.9)
    stone = _weathered("Temple Stone", haze, STAIN, STONE, 1.6, roughness=0.75)
    shapes.link_object(collection, "Desert", _ground_mesh(sand))
    for index, (x, y, height) in enumerate(COLUMNS):
        column = shapes.link_object(collection, f"Column {index + 1}", _column_mesh(index, height, stone))
        column.location = (x, y, 0.0)
    shapes.link_object(collection, "Lintels", _lintel_mesh(stone))
    shapes.link_object(collection, "Fallen Drums", _drum_mesh(stone))


def _height(x, y):
    """Return the height of the ground in metres at arrays of x and y: level around the temple."""
    far = np.hypot(x, y - 60.0)
    ridges = 1.0 - np.abs(2.0 * landscape.fractal_noise(x, y, 310.0, 3, SEED) - 1.0)
    ripples = 0.10 * landscape.fractal_noise(x, y, 5.0, 2, SEED + 7)
    return DUNE_HEIGHT * landscape.smoothstep(far, LEVEL, DUNES) * ridges**2 + ripples


def _ground_mesh(sand):
    axis = np.linspace(-1.0, 1.0, GRID)
    warped = REACH * (0.1 * axis + 0.9 * axis**3)
    x, y = np.meshgrid(warped, warped + 60.0)
    builder = shapes.MeshBuilder()
    builder.add(shapes.loft(np.stack((x, y, _height(x, y)), axis=-1), closed=False))
    return builder.build("Desert", [sand])


def _column_mesh(index, height, stone):
    """Make the mesh of a column: a base, a fluted shaft that narrows upwards, and a capital if the column is whole."""
    builder = shapes.MeshBuilder()
    builder.add(shapes.box((3.0, 3.0, 0.5), (0.0, 0.0, 0.15)), smooth=False)
    builder.add(shapes.upright(shapes.lathe(((1.0, 0.95), (1.32, 0.86), (1.40, 0.66), (1.32, 0.46), (1.42, 0.40)))))
    builder.add(_shaft(index, height))
    if height == WHOLE:
        builder.add(shapes.upright(shapes.lathe(((1.30, height), (1.32, height - 0.12), (1.05, height - 0.55), (0.90, height - 0.75)), 64)))
        builder.add(shapes.box((2.9, 2.9, 0.6), (0.0, 0.0, height + 0.3)), smooth=False)
    return builder.build("Column", [stone])


def _shaft(index, height):
    heights = np.linspace(height, 0.9, 30)
    radii = RADIUS * (1.0 - 0.18 * (heights / WHOLE) ** 1.6)
    vertices, faces = shapes.lathe(((0.001, height), *zip(radii, heights)), SEGMENTS)
    angle = np.arctan2(vertices[:, 2], vertices[:, 0])
    depth = 1.0 - FLUTE_DEPTH * np.abs(np.sin(0.5 * FLUTES * angle))
    vertices[:, (0, 2)] *= depth[:, None]
    if height < WHOLE:
        # A broken column ends in a jagged slope.
        torn = landscape.value_noise(1.6 * vertices[:, 0], 1.6 * vertices[:, 2], SEED + index)
        top = vertices[:, 1] > height - 1e-6
        vertices[top, 1] += 0.9 * vertices[top, 0] + 1.3 * (torn[top] - 0.5)
    return shapes.upright((vertices, faces))


def _lintel_mesh(stone):
    builder = shapes.MeshBuilder()
    for one, other in LINTELS:
        (ax, ay, top), (bx, by, _) = COLUMNS[one], COLUMNS[other]
        middle, away = np.array((0.5 * (ax + bx), 0.5 * (ay + by), top + 1.3)), np.array((bx - ax, by - ay))
        length = float(np.hypot(*away))
        along = away / length
        vertices, faces = shapes.beam((length + 2.6, 2.0, 1.4), (0.0, 0.0, 0.0), 0.08)
        turned = vertices @ np.array(((along[0], along[1], 0.0), (-along[1], along[0], 0.0), (0.0, 0.0, 1.0)))
        builder.add((turned + middle, faces), smooth=False)
    return builder.build("Lintels", [stone])


def _drum_mesh(stone):
    """Make the mesh of pieces of broken columns that lie on the ground."""
    builder = shapes.MeshBuilder()
    for x, y, turn, length in ((13.5, 18.5, 0.6, 3.4), (4.0, 41.0, 2.2, 4.4), (-20.5, 52.0, 1.1, 2.8), (11.0, 90.0, 0.2, 3.6)):
        vertices, faces = _shaft(0, WHOLE)
        vertices = vertices[:, (0, 2, 1)] * (1.0, length / WHOLE, 1.0)
        cosine, sine = np.cos(turn), np.sin(turn)
        turned = vertices @ np.array(((cosine, sine, 0.0), (-sine, cosine, 0.0), (0.0, 0.0, 1.0)))
        builder.add((turned + (x, y, 0.8), faces[:, ::-1]))
    return builder.build("Fallen Drums", [stone])


def _weathered(name, haze, dark, light, scale, roughness):
    """Make a material with a grainy surface that varies between two colours. scale: of the noise."""
    material, shader, output = materials.new_material(name)
    place = shader.add("ShaderNodeNewGeometry").outputs["Position"]
    color = shader.ramp(shader.noise(place, scale, detail=7.0), ((0.36, dark), (0.62, light)))
    bump = shader.add("ShaderNodeBump", {"Height": shader.noise(place, 4.0 * scale, detail=8.0), "Strength": 0.4, "Distance": 0.12})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=roughness, specular=0.2, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0], haze)
    material.diffuse_color = (*light, 1.0)
    return material
