"""The land of the main scene: the snow scene's village on a clear winter evening, with a trodden path through the snow."""

import math

import numpy as np

from ..places import landscape
from ..stage import lighting, materials, shapes
from ..village import houses, props, terrain, trees

# The path on which the pilot walks: out of the village, and past the camera. Positions are x, y in m.
WAY_START, WAY_ANGLE = (1.35, 6.49), math.radians(245.0)
# m by which the path lies lower; points through which the path goes before and after its straight part.
TRODDEN, BEFORE, BEYOND = 0.09, (0.62, 8.6), ((-1.35, 0.7), (-2.2, -3.0), (-2.4, -9.0))
WAY_LENGTH = 4.6  # length of the path's straight part, m
# Middle and half axes, in m, of the ellipse of level ground; multiple of the half axes at which the ground is not affected any more.
LEVEL_MIDDLE, LEVEL_REACH, LEVEL_END = (0.3, 2.4), (5.5, 4.2), 1.42
LEVEL = terrain.ground_at(3.0, 2.4)
LANTERNS = ((2.6, 16.4),)
FENCES = (
    ((-5.2, 8.9), (-6.4, 8.4), (-8.0, 7.9), (-9.8, 8.0)),
    ((4.2, 8.9), (5.6, 8.6), (7.2, 8.0), (8.8, 7.0), (10.4, 5.6)),
)
WHITE, BLUE = (0.80, 0.84, 0.90), (0.66, 0.73, 0.85)
LAMP_SHARE = 0.5  # share of the brightness that lanterns and windows have at night
SUN_ELEVATION, SUN_AZIMUTH = math.radians(29.0), math.radians(211.0)
SUN_COLOR, SUN_STRENGTH, SUN_ANGLE = (1.0, 0.66, 0.40), 4.2, math.radians(1.5)
# Sky colours from the horizon to the zenith: (sine of the elevation, linear rgb).
SKY_STOPS = (
    (0.0, (0.98, 0.66, 0.46)),
    (0.10, (0.82, 0.66, 0.62)),
    (0.32, (0.36, 0.50, 0.74)),
    (1.0, (0.07, 0.19, 0.48)),
)
SKY_STRENGTH = 0.62
VIEWS = (("AgX", "AgX - Medium High Contrast", 0.15), ("Filmic", "Medium High Contrast", -0.1))


def build(scene, collection, covered):
    """Build land, village, light and sky. Returns the ground's object, whose material is snow.

    covered: collection of the objects on which snow lies.
    """
    scene.world = lighting.build_gradient_world(
        "Motus Winter Sky", SKY_STOPS, SKY_STRENGTH, lambda shader, height: shader.math("MAXIMUM", height, 0.0)
    )
    lighting.set_color_management(scene, VIEWS)
    lighting.add_sun(collection, SUN_ELEVATION, SUN_AZIMUTH, SUN_COLOR, SUN_STRENGTH, SUN_ANGLE)
    snow = _snow()
    terrain.add_far_land(collection, snow)
    ground = terrain.add_ground(collection, snow, height, step=0.2)
    houses.build(collection, covered)
    props.build(collection, covered, LANTERNS, FENCES)
    white = terrain.whitening(scene, terrain.SNOWY, terrain.SNOWY)
    trees.build(collection, covered, terrain.mottled("Wood Needles", (0.014, 0.040, 0.026), (0.026, 0.060, 0.040), 3.0, white))
    for lamp in collection.objects:
        if lamp.type == 'LIGHT' and lamp.data.type != 'SUN':
            lamp.data.energy *= LAMP_SHARE
            lamp.data.use_shadow = False  # the sun's shadows are enough, and each shadow map costs a rendering of the village
    return ground


def height(x, y):
    """Return the height of the ground in metres at arrays of x and y: level around the path, which lies a little lower."""
    (middle_x, middle_y), (reach_x, reach_y) = LEVEL_MIDDLE, LEVEL_REACH
    far = np.hypot((x - middle_x) / reach_x, (y - middle_y) / reach_y)
    rest = landscape.smoothstep(far, 1.0, LEVEL_END)
    drifts = 0.035 * (landscape.fractal_noise(x, y, 1.7, 3, terrain.SEED + 40) - 0.5)
    on_way = terrain.trodden(x, y, (BEFORE, WAY_START, on_way_at(WAY_LENGTH)[:2], *BEYOND))
    level = LEVEL + drifts * (1.0 - on_way) - TRODDEN * on_way
    return level + rest * (terrain.height(x, y) - level)


def on_way_at(ahead, aside=0.0, high=0.0):
    """Return the (x, y, z) of a place from its distances along the path, to the left of the path and above it, in m."""
    cosine, sine = math.cos(WAY_ANGLE), math.sin(WAY_ANGLE)
    x, y = WAY_START
    return x + ahead * cosine - aside * sine, y + ahead * sine + aside * cosine, LEVEL - TRODDEN + high


def add_way(collection):
    """Add an empty at the start of the path. The path leads along the empty's -Y axis."""
    way = shapes.link_object(collection, "Way", None)
    way.location, way.rotation_euler.z = on_way_at(0.0), WAY_ANGLE + 0.5 * math.pi
    way.empty_display_size = 0.3
    return way


def _snow():
    """Make a material of snow in the sun: white with bluish patches and a grainy crust."""
    material, shader, output = materials.new_material("Snow Crust")
    place = shader.add("ShaderNodeNewGeometry").outputs["Position"]
    color = shader.ramp(shader.noise(place, 0.6, detail=5.0), ((0.35, BLUE), (0.65, WHITE)))
    grain = shader.math("ADD", shader.math("MULTIPLY", shader.noise(place, 2.2, detail=4.0), 0.7), shader.noise(place, 24.0, detail=2.0))
    bump = shader.add("ShaderNodeBump", {"Height": grain, "Strength": 0.35, "Distance": 0.05})
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.7, specular=0.25, normal=bump.outputs[0])
    materials.finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*WHITE, 1.0)
    return material
