"""Late-afternoon light: a low warm sun, a sky with a gradient and thin clouds, and haze between the camera and the land."""

import math

import bpy
from mathutils import Vector

from . import materials, shapes

SUN_ELEVATION = math.radians(27.0)
SUN_AZIMUTH = math.radians(205.0)  # from +X, counter-clockwise
SUN_COLOR = (1.0, 0.71, 0.43)
SUN_STRENGTH = 5.6
SUN_ANGLE = math.radians(1.2)
# Sky colours from the horizon to the zenith: (sine of the elevation, linear rgb).
SKY_STOPS = (
    (0.0, (0.70, 0.67, 0.65)),
    (0.07, (0.47, 0.60, 0.76)),
    (0.25, (0.20, 0.40, 0.69)),
    (1.0, (0.055, 0.17, 0.44)),
)
GLOW_COLOR = (1.0, 0.62, 0.28, 1.0)
CLOUD_COLOR = (1.0, 0.86, 0.74, 1.0)
# View transform, look, exposure: the first row that this Blender version supports is used.
VIEWS = (
    ("AgX", "AgX - Punchy", 0.65),
    ("Filmic", "High Contrast", 0.05),
    ("Filmic", "Filmic - High Contrast", 0.05),
)
# Width in pixels of the map by which Cycles samples the world's light; its own choice of 2048 takes three seconds per frame.
SKY_MAP = 256
HAZE_DISTANCE = 3400.0  # distance in m at which the haze hides 63 % of a surface
HAZE_LIMIT = 0.93


def sun_direction(elevation=SUN_ELEVATION, azimuth=SUN_AZIMUTH):
    """Return the unit vector towards the sun. elevation, azimuth: in radians."""
    flat = math.cos(elevation)
    return Vector((flat * math.cos(azimuth), flat * math.sin(azimuth), math.sin(elevation)))


def build_sky_group():
    """Make a node group that gives the sky's colour in a direction, without clouds."""
    shader, entry, result = materials.new_group(materials.SKY_GROUP, [("Direction", "NodeSocketVector")], [("Color", "NodeSocketColor")])
    direction = entry.outputs["Direction"]
    height = shader.add("ShaderNodeSeparateXYZ", {0: direction}).outputs[2]
    sky = shader.ramp(shader.math("MAXIMUM", height, 0.0), SKY_STOPS)
    toward = shader.add("ShaderNodeVectorMath", {0: direction, 1: sun_direction()}, operation="DOT_PRODUCT")
    facing = shader.math("MAXIMUM", toward.outputs["Value"], 0.0)
    halo = shader.math("MULTIPLY", shader.math("POWER", facing, 5.0), 0.45)
    core = shader.math("MULTIPLY", shader.math("POWER", facing, 60.0), 0.8)
    glow = shader.math("ADD", halo, core)
    shader.feed(result.inputs[0], shader.mix(glow, sky, GLOW_COLOR, blend="ADD"))
    return shader.tree


def build_haze_group(sky):
    """Make a node group that mixes a surface's shader with haze by the distance from the camera. sky: node group of the sky."""
    shader, entry, result = materials.new_group(materials.HAZE_GROUP, [("Surface", "NodeSocketShader")], [("Surface", "NodeSocketShader")])
    distance = shader.add("ShaderNodeCameraData").outputs["View Distance"]
    clear = shader.math("POWER", math.exp(-1.0 / HAZE_DISTANCE), distance)
    amount = shader.math("MULTIPLY", shader.math("SUBTRACT", 1.0, clear), HAZE_LIMIT)
    path = shader.add("ShaderNodeLightPath")
    visible = shader.math("MAXIMUM", path.outputs["Is Camera Ray"], path.outputs["Is Glossy Ray"])
    incoming = shader.add("ShaderNodeNewGeometry").outputs["Incoming"]
    view = shader.add("ShaderNodeVectorMath", {0: incoming, "Scale": -1.0}, operation="SCALE").outputs[0]
    air = shader.add("ShaderNodeEmission", {"Color": shader.group(sky, {"Direction": view}).outputs[0]})
    mixed = shader.add(
        "ShaderNodeMixShader",
        {0: shader.math("MULTIPLY", amount, visible), 1: entry.outputs["Surface"], 2: air.outputs[0]},
    )
    shader.feed(result.inputs[0], mixed.outputs[0])
    return shader.tree


def build_world(sky):
    """Make the world: the sky with a flat layer of thin high clouds. sky: node group of the sky."""

    def color(shader, direction):
        clear = shader.group(sky, {"Direction": direction}).outputs[0]
        return shader.mix(_cloud_cover(shader, direction), clear, CLOUD_COLOR)

    return _add_world("Motus Sky", color)


def _add_world(name, color, strength=1.0):
    """Make a world. color(shader, direction): function that adds nodes and returns the socket with the sky's colour in a direction."""
    world = bpy.data.worlds.new(name)
    if not world.use_nodes:
        world.use_nodes = True
    world.node_tree.nodes.clear()
    shader = materials.Shader(world.node_tree)
    direction = shader.add("ShaderNodeTexCoord").outputs["Generated"]
    background = shader.add("ShaderNodeBackground", {"Color": color(shader, direction), "Strength": strength})
    output = shader.add("ShaderNodeOutputWorld")
    shader.feed(output.inputs["Surface"], background.outputs[0])
    cycles = getattr(world, "cycles", None)  # the attribute does not exist if the Cycles add-on is disabled
    if cycles:
        cycles.sampling_method, cycles.sample_map_resolution = 'MANUAL', SKY_MAP
    return world


def _cloud_cover(shader, direction):
    """Return the socket with the density of clouds in a direction: noise on a plane overhead, fading out at the horizon."""
    height = shader.add("ShaderNodeSeparateXYZ", {0: direction}).outputs[2]
    lifted = shader.math("DIVIDE", 1.0, shader.math("ADD", shader.math("MAXIMUM", height, 0.0), 0.12))
    plane = shader.add("ShaderNodeVectorMath", {0: direction, "Scale": lifted}, operation="SCALE").outputs[0]
    stretched = shader.add("ShaderNodeVectorMath", {0: plane, 1: (0.45, 1.25, 0.0)}, operation="MULTIPLY").outputs[0]
    cover = shader.ramp(shader.noise(stretched, 1.5, detail=7.0), ((0.50, (0.0,) * 3), (0.78, (1.0,) * 3)))
    fade = shader.math("MULTIPLY", height, 7.0, clamp=True)
    return shader.math("MULTIPLY", shader.math("MULTIPLY", cover, fade), 0.75)


def add_sun(collection, elevation=SUN_ELEVATION, azimuth=SUN_AZIMUTH, color=SUN_COLOR, strength=SUN_STRENGTH, angle=SUN_ANGLE):
    """Add the sun lamp. elevation, azimuth, angle: in radians; angle is the sun's angular diameter."""
    lamp = bpy.data.lights.new("Sun", "SUN")
    lamp.energy, lamp.color, lamp.angle = strength, color, angle
    sun = shapes.link_object(collection, "Sun", lamp)
    direction = sun_direction(elevation, azimuth)
    sun.rotation_euler = direction.to_track_quat("Z", "Y").to_euler()
    sun.location = direction * 200.0
    return sun


def set_color_management(scene, views=VIEWS):
    """Set the first view transform with its look and exposure that this Blender version supports. views: (transform, look, exposure)."""
    view = scene.view_settings
    for transform, look, exposure in views:
        try:
            view.view_transform = transform
            view.look = look
        except TypeError:  # this Blender does not know the name
            continue
        view.exposure = exposure
        break


def build_gradient_world(name, stops, strength, of_height):
    """Make a world whose sky is a gradient over the elevation.

    stops: (position, rgb) rows. of_height(shader, height): function that adds nodes and returns the socket with the position on the
    gradient; height is the socket with the sine of the elevation.
    """

    def color(shader, direction):
        height = shader.add("ShaderNodeSeparateXYZ", {0: direction}).outputs[2]
        return shader.ramp(of_height(shader, height), stops)

    return _add_world(name, color, strength)
