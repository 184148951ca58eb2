"""The pictures on the page of walkers that tell of gaits and soles, made through the add-on's own operators and the plans that they make."""

import math

import bpy
import numpy as np
from mathutils import Matrix, Quaternion

import stage
import support

GAITS = ("Tripod", "Tetrapod", "Ripple", "Wave", "Trot", "Pace")
SPACING, BELOW = 1.55, -1.05
SECONDS, SWINGING, STANDING = 2.0, (0.92, 0.36, 0.05, 1.0), (0.16, 0.24, 0.34, 1.0)
BAR, ROW = 0.052, 0.098
LAST = 97
CHANGES = ((1, "Walk"), (73, "Pace"), (145, "Trot"), (217, "Canter"), (289, "Gallop"))
LAST_OF_CHANGES, LONG = 361, 9.4
HORSE = (("L hind", -0.2, -0.5), ("L fore", -0.2, 0.5), ("R fore", 0.2, 0.5), ("R hind", 0.2, -0.5))
MOMENTS, APART = (0.0, 0.05, 0.12, 0.3, 0.45, 0.53, 0.599, 0.68, 0.8, 0.92), 0.36
ANKLE, HEEL, TOE = 0.09, 0.06, 0.16


def render_all(folder):
    """Render the pictures into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [
        _gaits(folder / "walker_gaits.png"),
        _changes(folder / "walker_changes.png"),
        _soles(folder / "walker_soles.png"),
    ]


def _gaits(file):
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
    return stage.render(scene, file, (1280, 400), samples=64)


def _changes(file):
    """A gait diagram of a horse whose gait is keyed: a row for each foot, with a bar for each stand."""
    scene = stage.new_scene((0.66, 0.72, 0.78), 0.75)
    scene.frame_end = LAST_OF_CHANGES
    standing = stage.flat_material("Standing", STANDING)
    line = stage.flat_material("Line", SWINGING)
    body = stage.link(bpy.data.objects.new("Body", None))
    feet = [stage.link(bpy.data.objects.new(name, None)) for name, *_ in HORSE]
    for foot, (_, x, y) in zip(feet, HORSE):
        foot.location = (x, y, 0.0)
    bpy.context.view_layer.update()
    bpy.ops.motus.walker_add(object=body.name, feet=",".join(foot.name for foot in feet), use_plane=True, stride=0.5, cadence=1.2)
    for frame, y in ((-24, 0.0), (LAST_OF_CHANGES + 24, 9.0)):
        body.location.y = y
        body.keyframe_insert("location", frame=frame)
    for frame, gait in CHANGES:
        body.motus.walker.gait = gait.upper()
        body.keyframe_insert("motus.walker.gait", frame=frame)
        _flat("Change", _box(LONG * (frame - 1) / (LAST_OF_CHANGES - 1), -0.58, 0.012, 1.06), line).location.z = -0.01
        stage.add_text(gait, (LONG * (frame - 1) / (LAST_OF_CHANGES - 1) + 0.1, 0.3, 0.0), 0.17, align='LEFT', upright=False)
    scene.frame_set(1)
    walker, times = _walker(body), np.arange(24.0, 24.0 * LAST_OF_CHANGES + 1.0) / 576.0
    stands = walker.swing(times) == 0.0
    for row, name in enumerate(feet):
        y = 0.12 - 0.2 * row
        stage.add_text(name.name, (-0.12, y - 0.05, 0.0), 0.13, align='RIGHT', upright=False)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], stands[:, row], [False])).astype(int)))
        for first, last in zip(edges[::2], edges[1::2]):
            left, right = (LONG * edge / len(times) for edge in (first, last))
            _flat("Stand", _box(left, y - 0.06, right - left, 0.12), standing)
    stage.add_camera(scene, (0.5 * LONG - 0.4, -0.1, 10.0), (0.0, 0.0, 0.0), width=LONG + 1.1).rotation_euler = (0.0, 0.0, 0.0)
    return stage.render(scene, file, (1280, 180), samples=32)


def _box(left, low, width, height):
    """Corners of a rectangle."""
    return [(left, low, 0.0), (left + width, low, 0.0), (left + width, low + height, 0.0), (left, low + height, 0.0)]


def _soles(file):
    """A foot of a biped at moments of one cycle, side by side: from the touch of its heel to the next one."""
    scene = stage.new_scene((0.66, 0.72, 0.78), 0.6)
    scene.frame_end = 240
    stage.add_floor(stage.glossy_material("Floor", (0.42, 0.48, 0.52, 1.0), 0.95))
    stage.add_sun((math.radians(38), math.radians(-14), 0.0), 1.7, softness=8.0)
    colors = [
        stage.glossy_material(name, color) for name, color in (("Standing", (0.05, 0.22, 0.5, 1.0)), ("Swinging", (0.9, 0.3, 0.05, 1.0)))
    ]
    body, step = _biped()
    walker = _walker(body)
    times = [step[0] + (step[1] - step[0]) * share for share in MOMENTS]
    for index, (moment, time) in enumerate(zip(MOMENTS, times)):
        turn, place = Quaternion(walker.turns(time)[0]), walker.feet(time)[0]
        x = (index - (len(MOMENTS) - 1) / 2) * APART
        foot = _foot(colors[int(walker.swing(time)[0] > 0.0)])
        foot.matrix_world = Matrix.Translation((x, 0.0, place[2])) @ turn.to_matrix().to_4x4()
        stage.add_text(f"{100.0 * moment:.0f} %", (x + 0.05, 0.0, 0.32), 0.05)
    stage.add_camera(scene, (0.05, -6.0, 1.0), (0.05, 0.0, 0.15), width=APART * len(MOMENTS) + 0.05)
    return stage.render(scene, file, (1280, 240), samples=64)


def _biped():
    """A body on two feet that walks along +X; (body, times of two touches of the first foot, s)."""
    body = stage.link(bpy.data.objects.new("Body", None))
    body.rotation_euler.z = math.radians(-90.0)
    feet = [stage.link(bpy.data.objects.new(f"Foot {side}", None)) for side in (-1, 1)]
    for side, foot in zip((-0.1, 0.1), feet):
        foot.location = (0.0, -side, ANKLE)
    bpy.context.view_layer.update()
    bpy.ops.motus.walker_add(
        object=body.name,
        feet=",".join(foot.name for foot in feet),
        gait='WALK',
        use_plane=True,
        use_soles=True,
        ankle=ANKLE,
        heel=HEEL,
        toe=TOE,
        stride=0.6,
        clearance=0.08,
    )
    for frame, x in ((1, 0.0), (240, 9.0)):
        body.location.x = x
        body.keyframe_insert("location", frame=frame)
    for curve in support.addon("core.blender.actions").fcurves(body):
        for point in curve.keyframe_points:
            point.interpolation = 'LINEAR'
    bpy.context.view_layer.update()
    steps = _walker(body).steps
    touches = steps["touch"][steps["leg"] == 0]
    return body, touches[3:5]


def _foot(material):
    """A shoe whose origin is at its ankle, and which looks along +Y."""
    outline = [(-HEEL, -ANKLE), (TOE, -ANKLE), (TOE + 0.01, -ANKLE + 0.025), (0.6 * TOE, -0.03), (0.035, 0.06), (-HEEL + 0.005, 0.06)]
    count, mesh = len(outline), bpy.data.meshes.new("Foot")
    mesh.from_pydata(
        [(side, y, z) for side in (-0.04, 0.04) for y, z in outline],
        [],
        [tuple(range(count))[::-1], tuple(range(count, 2 * count))]
        + [(one, (one + 1) % count, (one + 1) % count + count, one + count) for one in range(count)],
    )
    mesh.materials.append(material)
    return stage.link(bpy.data.objects.new("Foot", mesh))


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
    _flat("Bar", _box(x + 1.16 * first, y - 0.5 * BAR, 1.16 * (last - first), BAR), material)


def _flat(name, corners, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], [tuple(range(len(corners)))])
    mesh.materials.append(material)
    return stage.link(bpy.data.objects.new(name, mesh))
