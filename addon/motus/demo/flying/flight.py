"""The flight: a course that is imported from an SVG file and raised above the land, and the aeroplane that follows the course."""

import itertools
import math
from pathlib import Path

import bpy
from mathutils import Vector
from mathutils.geometry import interpolate_bezier

from ..places import landscape
from ..stage import materials, shapes

COURSE_FILE = Path(__file__).with_name("course.svg")
COURSE_WIDTH = 540.0  # metres from the course's western to its eastern end
# Height above the ground for each control point of the file, m, so that the course climbs and dives.
CLEARANCES = (26.0, 30.0, 46.0, 40.0, 26.0, 34.0, 44.0, 30.0, 26.0, 44.0, 36.0)
COURSE_THICKNESS = 0.03
COURSE_COLOR = (1.0, 0.80, 0.45)
DASHES = 22.0  # per segment of the curve

SPEED = 34.0  # m/s
FIRST_FRAME = 1.0
BANK_SMOOTHING = 12.0  # m
BANK_LIMIT = math.radians(62.0)


def import_course(scene):
    """Import the course with Blender's SVG importer as a flat cyclic Bézier curve around the origin."""
    _enable_importer()
    known = set(scene.objects)
    collections = set(bpy.data.collections)
    bpy.ops.import_curve.svg(filepath=str(COURSE_FILE))
    course = next(thing for thing in scene.objects if thing not in known and thing.type == "CURVE")
    imported = [collection for collection in bpy.data.collections if collection not in collections]
    course.name = course.data.name = "Course"
    points = course.data.splines[0].bezier_points
    west, east = min(p.co.x for p in points), max(p.co.x for p in points)
    south, north = min(p.co.y for p in points), max(p.co.y for p in points)
    centre = Vector(((west + east) / 2.0, (south + north) / 2.0, 0.0))
    scale = COURSE_WIDTH / (east - west)
    move_points(points, lambda position, _index: (position - centre) * scale)
    return course, imported


def _enable_importer():
    """Enable Blender's SVG importer, an add-on that may be switched off."""
    import addon_utils

    if not addon_utils.check("io_curve_svg")[1]:
        addon_utils.enable("io_curve_svg")


def lift_course(course):
    """Raise the flat course above the land. Handles follow the slope, so that the course stays smooth."""
    course.data.dimensions = "3D"
    points = course.data.splines[0].bezier_points
    levels = [_ground_below(points, i) + CLEARANCES[i % len(CLEARANCES)] for i in range(len(points))]
    for i, point in enumerate(points):
        before, after = points[i - 1].co, points[(i + 1) % len(points)].co
        run = (point.co - before).length + (after - point.co).length
        slope = (levels[(i + 1) % len(points)] - levels[i - 1]) / run
        for handle, direction in ((point.handle_left, -1.0), (point.handle_right, 1.0)):
            handle.z = levels[i] + direction * slope * (handle - point.co).xy.length
    for point, level in zip(points, levels):
        point.co.z = level


def _ground_below(points, index):
    """Return the height of the highest ground below the two half segments at a point of the course, at least the water level."""
    last, here, following = points[index - 1], points[index], points[(index + 1) % len(points)]
    way = interpolate_bezier(last.co, last.handle_right, here.handle_left, here.co, 9)[4:]
    way += interpolate_bezier(here.co, here.handle_right, following.handle_left, following.co, 9)[:5]
    heights = landscape.height([p.x for p in way], [p.y for p in way])
    return max(landscape.WATER_LEVEL, float(heights.max()))


def move_points(points, move):
    """Apply move(position, point index) to the knots and handles of a spline."""
    for index, point in enumerate(points):
        moved = [move(Vector(v), index) for v in (point.handle_left, point.co, point.handle_right)]
        point.handle_left, point.co, point.handle_right = moved


def add_course(collection, knots, is_cyclic=False):
    """Add a smooth Bézier curve through knots as a course, which is not rendered."""
    data = bpy.data.curves.new("Course", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("BEZIER")
    spline.bezier_points.add(len(knots) - 1)
    for point, place in zip(spline.bezier_points, knots):
        point.co = place
        point.handle_left_type = point.handle_right_type = "AUTO"
    spline.use_cyclic_u = is_cyclic
    course = shapes.link_object(collection, "Course", data)
    course.hide_render = True
    return course


def course_length(course):
    """Return the approximate length of the course in metres, summed over short chords; it is precise enough for planning frames."""
    return sum((b - a).length for a, b in chords(course.data.splines[0]))


def place_on_course(course, distance):
    """Return (position, horizontal direction of flight) at a distance along the course, in m, for placing cameras beside the course."""
    distance %= course_length(course)
    for a, b in chords(course.data.splines[0]):
        distance -= (b - a).length
        if distance <= 0.0:
            break
    return b, Vector((b.x - a.x, b.y - a.y, 0.0)).normalized()


def chords(spline):
    """Yield short chords along a Bézier spline, as pairs of positions."""
    points = list(spline.bezier_points)
    for point, following in zip(points, [*points[1:], points[0]] if spline.use_cyclic_u else points[1:]):
        way = interpolate_bezier(point.co, point.handle_right, following.handle_left, following.co, 200)
        yield from itertools.pairwise(way)


def draw_course(course):
    """Make the course visible as a thin dashed line of light; it remains a curve that the user can edit."""
    course.data.bevel_depth = COURSE_THICKNESS
    course.data.bevel_resolution = 1
    course.data.materials.clear()
    material, shader, output = materials.new_material("Course Line")
    along = shader.add("ShaderNodeSeparateXYZ", {0: shader.add("ShaderNodeTexCoord").outputs["UV"]}).outputs[0]
    count = DASHES * len(course.data.splines[0].bezier_points)
    dash = shader.math("GREATER_THAN", shader.math("FRACT", shader.math("MULTIPLY", along, count)), 0.5)
    glow = shader.add("ShaderNodeEmission", {"Color": (*COURSE_COLOR, 1.0), "Strength": 1.5})
    clear = shader.add("ShaderNodeBsdfTransparent")
    mixed = shader.add("ShaderNodeMixShader", {0: dash, 1: clear.outputs[0], 2: glow.outputs[0]})
    materials.finish(material, shader, output, mixed.outputs[0])
    materials.make_transparent(material)
    course.data.materials.append(material)


def follow(follower, curve, **settings):
    """Let an object follow a curve, with the add-on's public operator. settings: keywords of motus.path_follow_add."""
    result = bpy.ops.motus.path_follow_add(object=follower.name, curve=curve.name, start_frame=FIRST_FRAME, extend="LOOP", **settings)
    if result != {"FINISHED"}:
        raise RuntimeError(f"{follower.name} could not be put on {curve.name}")


def fly(aeroplane, course):
    """Let the aeroplane follow the course at constant speed, banked in the bends."""
    follow(
        aeroplane,
        course,
        timing="SPEED",
        speed=SPEED,
        orientation="BANKING",
        bank_limit=BANK_LIMIT,
        bank_smoothing=BANK_SMOOTHING,
        forward_axis="POS_Y",
        up_axis="POS_Z",
    )
