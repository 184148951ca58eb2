"""The land of the main scene: the village of the snow scene on a clear winter evening, with a trodden way through the snow before it."""

import math

import numpy as np

from ..places import landscape
from ..stage import lighting, materials, shapes
from ..village import houses, props, terrain, trees

# The way that the pilot walks on: out of the village, and on past the camera. x, y, m.
WAY_START, WAY_ANGLE = (1.35, 6.49), math.radians(245.0)
TRODDEN, BEFORE, BEYOND = 0.09, (0.62, 8.6), ((-1.35, 0.7), (-2.2, -3.0), (-2.4, -9.0))  # m that it lies lower, and how it goes on
WAY_LENGTH = 4.6  # of its straight part
LEVEL_MIDDLE, LEVEL_REACH, LEVEL_END = (0.3, 2.4), (5.5, 4.2), 1.42  # where the ground is level, m, and where no more, by that
LEVEL = terrain.ground_at(3.0, 2.4)
LANTERNS = ((2.6, 16.4),)
FENCES = (
    ((-5.2, 8.9), (-6.4, 8.4), (-8.0, 7.9), (-9.8, 8.0)),
    ((4.2, 8.9), (5.6, 8.6), (7.2, 8.0), (8.8, 7.0), (10.4, 5.6)),
)
WHITE, BLUE = (0.80, 0.84, 0.90), (0.66, 0.73, 0.85)
LAMP_SHARE = 0.5  # of the light of lanterns and windows at night
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
    """Land, village, light and sky; gives the ground. covered: the collection of what snow lies on; the ground is white by itself."""
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
            lamp.data.use_shadow = False  # the sun's are enough, and each costs a picture of the village
    return ground


def height(x, y):
    """Height of the ground in metres at arrays of x and y: level round the way, which lies a little lower."""
    (middle_x, middle_y), (reach_x, reach_y) = LEVEL_MIDDLE, LEVEL_REACH
    far = np.hypot((x - middle_x) / reach_x, (y - middle_y) / reach_y)
    rest = landscape.smoothstep(far, 1.0, LEVEL_END)
    drifts = 0.035 * (landscape.fractal_noise(x, y, 1.7, 3, terrain.SEED + 40) - 0.5)
    on_way = terrain.trodden(x, y, (BEFORE, WAY_START, on_way_at(WAY_LENGTH)[:2], *BEYOND))
    level = LEVEL + drifts * (1.0 - on_way) - TRODDEN * on_way
    return level + rest * (terrain.height(x, y) - level)


def on_way_at(ahead, aside=0.0, high=0.0):
    """A place by how far it is along the way, to the left of it and above it."""
    cosine, sine = math.cos(WAY_ANGLE), math.sin(WAY_ANGLE)
    x, y = WAY_START
    return x + ahead * cosine - aside * sine, y + ahead * sine + aside * cosine, LEVEL - TRODDEN + high


def add_way(collection):
    """An empty that stands where the way begins; it leads along its -Y axis."""
    way = shapes.link_object(collection, "Way", None)
    way.location, way.rotation_euler.z = on_way_at(0.0), WAY_ANGLE + 0.5 * math.pi
    way.empty_display_size = 0.3
    return way


def _snow():
    """Snow in the sun: white, bluish in patches, with the grain of its crust."""
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
