"""The picture of the gaits on the page of walkers, made through the add-on's own operators and the plans that they make."""

import math

import bpy
import numpy as np

import stage
import support

GAITS = ("Tripod", "Tetrapod", "Ripple", "Wave", "Trot", "Pace")
SPACING, BELOW = 1.55, -1.05
SECONDS, SWINGING, STANDING = 2.0, (0.92, 0.36, 0.05, 1.0), (0.16, 0.24, 0.34, 1.0)
BAR, ROW = 0.052, 0.098
LAST = 97


def render_all(folder):
    """Render the picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    scene = stage.new_scene((0.66, 0.72, 0.78), 0.75)
    scene.frame_end = 240
    stage.add_floor(stage.glossy_material("Floor", (0.56, 0.62, 0.66, 1.0), 0.95)).location.z = -0.004
    stage.add_sun((math.radians(24), math.radians(-14), 0.0), 2.2, softness=12.0)
    colors = [stage.flat_material(name, color) for name, color in (("Standing", STANDING), ("Swinging", SWINGING))]
    spiders = [_spider(index, gait) for index, gait in enumerate(GAITS)]
    for index, (gait, spider) in enumerate(zip(GAITS, spiders)):
        _tell(index, gait, spider, colors)
    scene.frame_set(1)
    stage.add_camera(scene, (0.0, -0.42, 10.0), (0.0, -0.42, 0.0), width=SPACING * len(GAITS) + 0.1).rotation_euler = (0.0, 0.0, 0.0)
    return [stage.render(scene, folder / "walker_gaits.png", (1280, 400), samples=64)]


def _x(index):
    return (index - (len(GAITS) - 1) / 2) * SPACING


def _spider(index, gait):
    """A spider that has come walking, and is in its stride on the first frame."""
    bpy.ops.motus.spider_add(location=(_x(index), 0.0, 0.0), gait=gait.upper(), cadence=1.0, stride=0.34, body_height=0.0, body_tilt=0.0)
    spider = bpy.context.object
    for frame, y in ((1 - LAST, -2.0), (LAST, 2.0)):
        spider.location.y = y
        spider.keyframe_insert("location", frame=frame)
    for curve in support.addon("core.blender.actions").fcurves(spider):
        for point in curve.keyframe_points:
            point.interpolation = 'LINEAR'
    return spider


def _walker(spider):
    plan = support.addon("walker.plan")
    evaluated = spider.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return plan.of(evaluated, bpy.context.scene, plan.read(evaluated.motus.walker)).walker


def _tell(index, gait, spider, colors):
    """The gait's name, a mark under each foot, and a bar for each leg: when it stands, and when it swings."""
    standing, swinging = colors
    scene = bpy.context.scene
    scene.frame_set(1)
    walker, now = _walker(spider), scene.frame_current / 24.0
    for place, swing in zip(walker.feet(now), walker.swing(now)):
        _disc((place[0], place[1], 0.002), 0.052, swinging if swing > 0.0 else standing)
    stage.add_text(gait, (_x(index), 0.66, 0.0), 0.15, upright=False)
    times = np.linspace(now, now + SECONDS, 241)
    swings = walker.swing(times) > 0.0
    names = [leg.name for leg in spider.motus.walker.legs]
    order = sorted(range(len(names)), key=lambda leg: (names[leg][-1], names[leg]))
    for row, leg in enumerate(order):
        y = BELOW - row * ROW
        stage.add_text(_short(names[leg]), (_x(index) - 0.62, y - 0.022, 0.0), 0.075, upright=False)
        edges = np.flatnonzero(np.diff(swings[:, leg].astype(int)))
        for first, last in zip((0, *edges + 1), (*edges + 1, len(times) - 1)):
            _bar(_x(index) - 0.52, y, first / 240.0, last / 240.0, swinging if swings[first, leg] else standing)


def _short(name):
    """L1 of "foot 1.L"."""
    number, _, side = name.rpartition(" ")[2].partition(".")
    return f"{side}{number}"


def _disc(place, radius, material):
    corners = [(radius * math.cos(turn), radius * math.sin(turn), 0.0) for turn in np.arange(24) * math.tau / 24]
    _flat("Mark", corners, material).location = place


def _bar(x, y, first, last, material):
    left, right = x + 1.16 * first, x + 1.16 * last
    _flat(
        "Bar", [(left, y - 0.5 * BAR, 0.0), (right, y - 0.5 * BAR, 0.0), (right, y + 0.5 * BAR, 0.0), (left, y + 0.5 * BAR, 0.0)], material
    )


def _flat(name, corners, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], [tuple(range(len(corners)))])
    mesh.materials.append(material)
    return stage.link(bpy.data.objects.new(name, mesh))
