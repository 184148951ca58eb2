"""The land: hills around a lake, a ring of mountains, and fields. It does not vary between machines or runs."""

import numpy as np

from ..stage import materials, shapes

SEED = 11
EXTENT = 3600.0  # half the side of the terrain, m
GRID = 360  # vertices along a side
FINE_SHARE = 0.2  # spacing of vertices in the middle, where cameras look, relative to the average spacing
WATER_LEVEL = 0.0
LAKE_RADII = (185.0, 118.0)
LAKE_CENTRE = (0.0, -10.0)
MOUNTAINS_START, MOUNTAINS_FULL = 750.0, 2300.0  # m from the middle at which mountains begin and have their full height
MOUNTAIN_HEIGHT = 620.0
SNOW_LINE = 370.0

SAND = (0.55, 0.43, 0.27)
MEADOW = (0.17, 0.27, 0.045)
DRY_GRASS = (0.36, 0.33, 0.085)
WOODLAND = (0.055, 0.115, 0.03)
ROCK = (0.15, 0.125, 0.12)
SNOW = (0.82, 0.84, 0.90)
FIELD_COLORS = (
    (0.0, (0.50, 0.37, 0.10)),
    (0.25, (0.20, 0.31, 0.05)),
    (0.45, (0.62, 0.48, 0.16)),
    (0.62, (0.11, 0.21, 0.04)),
    (0.8, (0.33, 0.36, 0.07)),
    (0.92, (0.32, 0.19, 0.09)),
)


# --- heights ---------------------------------------------------------------------------------------------------------


def value_noise(x, y, seed):
    """Return smooth noise in [0, 1] at arrays of x and y: random values at whole numbers, with quintic interpolation between them."""
    column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    fx, fy = _quintic(x - column), _quintic(y - row)
    lower = lattice(column, row, seed) * (1 - fx) + lattice(column + 1, row, seed) * fx
    upper = lattice(column, row + 1, seed) * (1 - fx) + lattice(column + 1, row + 1, seed) * fx
    return lower * (1 - fy) + upper * fy


def fractal_noise(x, y, wavelength, octaves, seed):
    """Return a sum of octaves of value noise, each with half the height and wavelength of the one before; in [0, 1], 0.5 on average."""
    total, weight = 0.0, 0.0
    for octave in range(octaves):
        scale = 2.0**octave / wavelength
        total = total + value_noise(x * scale, y * scale, seed + octave) * 0.5**octave
        weight += 0.5**octave
    return total / weight


def ridged_noise(x, y, wavelength, octaves, seed):
    """Return a sum of octaves of value noise that is folded at 0.5, so that it forms ridges; in [0, 1]."""
    total, weight = 0.0, 0.0
    for octave in range(octaves):
        scale = 2.0**octave / wavelength
        fold = 1.0 - np.abs(2.0 * value_noise(x * scale, y * scale, seed + octave) - 1.0)
        total = total + fold**2 * 0.47**octave
        weight += 0.47**octave
    return total / weight


def height(x, y):
    """Return the height of the ground in metres at arrays of x and y; ground below 0 lies under the lake."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    hills = 6.0 + 62.0 * fractal_noise(x, y, 310.0, 5, SEED) ** 1.6 + 2.5 * fractal_noise(x, y, 46.0, 3, SEED + 20)
    shore = lake_distance(x, y)
    land = hills * smoothstep(shore, 0.0, 1.9) + 2.2 * smoothstep(shore, -0.1, 0.25)
    bed = -7.0 * smoothstep(-shore, -0.05, 0.6)
    radius = np.hypot(x, y)
    rise = smoothstep(radius, MOUNTAINS_START, MOUNTAINS_FULL)
    peaks = MOUNTAIN_HEIGHT * rise * (0.15 + ridged_noise(x, y, 1500.0, 6, SEED + 40))
    return land + bed + peaks


def lake_distance(x, y):
    """Return the signed distance from the lake's shore in lake radii, bays included: negative on the water, 0 at the shore."""
    u, v = (x - LAKE_CENTRE[0]) / LAKE_RADII[0], (y - LAKE_CENTRE[1]) / LAKE_RADII[1]
    bays = 0.9 * (fractal_noise(x, y, 130.0, 4, SEED + 60) - 0.5)
    return np.hypot(u, v) - 1.0 + bays


def smoothstep(value, low, high):
    """Return 0 for values below `low`, 1 for values above `high`, and a smooth transition between."""
    t = np.clip((value - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def _quintic(t):
    return t * t * t * (t * (6.0 * t - 15.0) + 10.0)


def lattice(column, row, seed):
    """Return a repeatable random value in [0, 1) for each lattice point, by an integer hash: it is equal on all machines."""
    with np.errstate(over="ignore"):
        mixed = column * np.int64(374761393) + row * np.int64(668265263) + np.int64(seed) * np.int64(1274126177)
        mixed = (mixed ^ (mixed >> np.int64(13))) * np.int64(1103515245)
        mixed = mixed ^ (mixed >> np.int64(16))
    return (mixed & np.int64(0xFFFFF)) / float(0x100000)


# --- terrain ---------------------------------------------------------------------------------------------------------


def add_terrain(collection, haze):
    """Add the ground as one mesh, with its colour and its share of fields as vertex attributes."""
    axis = np.linspace(-1.0, 1.0, GRID)
    warped = EXTENT * (FINE_SHARE * axis + (1.0 - FINE_SHARE) * axis**3)
    x, y = np.meshgrid(warped, warped)
    z = height(x, y)
    builder = shapes.MeshBuilder()
    builder.add(shapes.loft(np.stack((x, y, z), axis=-1), closed=False))
    mesh = builder.build("Terrain", [_ground_material(haze)])
    steepness = _steepness(warped, z)
    color = ground_color(x, y, z, steepness)
    fields = field_share(x, y, z, steepness)
    layer = mesh.attributes.new("ground", "FLOAT_COLOR", "POINT")
    layer.data.foreach_set("color", np.dstack((color, fields)).astype(np.float32).ravel())
    return shapes.link_object(collection, "Terrain", mesh)


def add_lake(collection, haze):
    """Add the water's surface, a little larger than the lake."""
    builder = shapes.MeshBuilder()
    size = (5.0 * LAKE_RADII[0], 5.0 * LAKE_RADII[1])
    corners = [(sx * size[0] / 2, sy * size[1] / 2, WATER_LEVEL) for sy in (-1, 1) for sx in (-1, 1)]
    builder.add((corners, [(0, 1, 3, 2)]))
    return shapes.link_object(collection, "Lake", builder.build("Lake", [_water_material(haze)]))


def ground_color(x, y, z, steepness):
    """Return the linear rgb of the ground by height, slope and patches of noise."""
    patches = fractal_noise(x, y, 90.0, 4, SEED + 80)[..., None]
    color = _blend(MEADOW, DRY_GRASS, smoothstep(patches, 0.35, 0.7))
    color = _blend(color, WOODLAND, wood_share(x, y, z, steepness)[..., None] * 0.85)
    color = _blend(color, WOODLAND, smoothstep(z, 60.0, 130.0)[..., None] * 0.8)
    bare = np.maximum(smoothstep(steepness, 0.45, 0.8), smoothstep(z + 60.0 * patches[..., 0], 200.0, 300.0))
    color = _blend(color, ROCK, bare[..., None])
    snow = smoothstep(z + 120.0 * patches[..., 0], SNOW_LINE, SNOW_LINE + 90.0)
    snow *= 1.0 - smoothstep(steepness, 0.75, 1.15)
    color = _blend(color, SNOW, snow[..., None])
    return _blend(color, SAND, (1.0 - smoothstep(z, 0.5, 1.7))[..., None])


def wood_share(x, y, z, steepness):
    """Return how wooded places are, from 0 to 1."""
    woods = smoothstep(fractal_noise(x, y, 170.0, 4, SEED + 100), 0.50, 0.62)
    between = smoothstep(z, 2.5, 5.0) * (1.0 - smoothstep(z, 190.0, 260.0))
    return woods * between * (1.0 - smoothstep(steepness, 0.6, 0.9))


def field_share(x, y, z, steepness):
    """Return the share of tilled land at places, from 0 to 1: it is on gentle slopes away from the shore and the woods."""
    gentle = 1.0 - smoothstep(steepness, 0.16, 0.24)
    return gentle * smoothstep(z, 3.0, 4.5) * (1.0 - smoothstep(z, 55.0, 75.0)) * (1.0 - wood_share(x, y, z, steepness))


def steepness_at(x, y, step=2.0):
    """Return the slope of the ground (rise over run) at arrays of x and y."""
    return np.hypot(height(x + step, y) - height(x - step, y), height(x, y + step) - height(x, y - step)) / (2 * step)


def _steepness(axis, z):
    dy, dx = np.gradient(z, axis, axis)
    return np.hypot(dx, dy)


def _blend(first, second, share):
    return np.asarray(first) * (1.0 - share) + np.asarray(second) * share


def _ground_material(haze):
    material, shader, output = materials.new_material("Ground")
    position = shader.add("ShaderNodeNewGeometry").outputs["Position"]
    ground = shader.add("ShaderNodeAttribute", attribute_name="ground")
    cells = shader.add("ShaderNodeTexVoronoi", {"Vector": position, "Scale": 1.0 / 70.0}, voronoi_dimensions="2D")
    pick = shader.add("ShaderNodeSeparateXYZ", {0: cells.outputs["Color"]}).outputs[0]
    crops = shader.ramp(pick, FIELD_COLORS, interpolation="CONSTANT")
    color = shader.mix(ground.outputs["Alpha"], ground.outputs["Color"], crops)
    grain = shader.ramp(shader.noise(position, 0.22, detail=6.0), ((0.3, (0.72,) * 3), (0.7, (1.22,) * 3)))
    node = shader.add("ShaderNodeBsdfPrincipled")
    tufts = shader.noise(position, 0.35, detail=5.0)
    bump = shader.add("ShaderNodeBump", {"Height": tufts, "Strength": 0.5, "Distance": 1.2})
    materials.set_principled(
        shader,
        node,
        color=shader.mix(1.0, color, grain, blend="MULTIPLY"),
        roughness=0.95,
        specular=0.1,
        normal=bump.outputs[0],
    )
    materials.finish(material, shader, output, node.outputs[0], haze)
    material.diffuse_color = (*MEADOW, 1.0)
    return material


def _water_material(haze):
    material, shader, output = materials.new_material("Water")
    position = shader.add("ShaderNodeNewGeometry").outputs["Position"]
    ripples = shader.noise(position, 0.25, detail=5.0)
    bump = shader.add("ShaderNodeBump", {"Height": ripples, "Strength": 0.16, "Distance": 0.6})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=(0.012, 0.075, 0.095), roughness=0.06, specular=0.6, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0], haze)
    material.diffuse_color = (0.05, 0.2, 0.3, 1.0)
    return material


def build(collection, haze):
    """Add terrain and lake. haze: node group of the haze."""
    add_terrain(collection, haze)
    add_lake(collection, haze)
