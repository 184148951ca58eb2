"""The cameras of the demo flight: a chase camera on a second path, and standing cameras; timeline markers cut between them."""

from dataclasses import dataclass

import bpy
from mathutils import Vector

from ..flying import flight
from ..places import landscape
from ..stage import shapes

CHASE_DISTANCE = 13.0  # m behind the aeroplane
CHASE_PULL, CHASE_LIFT = -2.5, 3.6  # the camera's path lies this far outside and above the course, m
CHASE_LENS = 28.0
CHASE_SHIFT = 0.02  # vertical shift of the picture, in picture widths, to show more sky
LOOK_AHEAD = 20.0  # m in front of the aeroplane
LOOK_AHEAD_BANK = 0.45  # share of the bank that the camera's horizon takes


@dataclass(frozen=True)
class Stand:
    """A standing camera, on the ground or on a mast beside the course. Its place is relative to the aeroplane's place at a given time."""

    name: str
    cut: float  # seconds into the flight at which the film cuts to it
    passing: float  # seconds into the flight; the offsets below start from the aeroplane's place at that time
    ahead: float  # m along the flight's direction
    outward: float  # m to the right of the flight's direction
    up: float  # m
    lens: float  # mm
    shift: tuple  # of the picture, in widths


STANDS = (
    Stand("Wide Camera", cut=0.0, passing=0.9, ahead=-14.0, outward=12.0, up=7.0, lens=22.0, shift=(0.12, 0.12)),
    Stand("Fly-By Camera", cut=8.2, passing=9.6, ahead=19.0, outward=-20.0, up=-2.0, lens=46.0, shift=(-0.04, 0.05)),
)
CHASE_CUTS = (1.8, 10.4)  # seconds into the flight at which the film cuts to the chase camera


def build(scene, collection, course, plane, lap):
    """Add all cameras, and the timeline markers that cut between them. lap: seconds of one lap."""
    chase = _add_chase_camera(collection, course, lap)
    for stand in STANDS:
        camera = _add_standing_camera(collection, course, plane, stand)
        _cut_to(scene, camera, stand.cut)
    for seconds in CHASE_CUTS:
        _cut_to(scene, chase, seconds)
    scene.camera = chase


def frame_at(scene, seconds):
    """Return the frame of the scene at a time of the flight, in seconds."""
    return round(flight.FIRST_FRAME + seconds * scene.render.fps / scene.render.fps_base)


def _cut_to(scene, camera, seconds):
    marker = scene.timeline_markers.new(camera.name, frame=frame_at(scene, seconds))
    marker.camera = camera


def _add_chase_camera(collection, course, lap):
    """Add a camera on a second path that looks at a point ahead of the aeroplane and banks with the aeroplane."""
    ahead = shapes.link_object(collection, "Look Ahead", None)
    ahead.empty_display_size = 1.5
    flight.follow(
        ahead,
        course,
        timing="SPEED",
        speed=flight.SPEED,
        offset=LOOK_AHEAD,
        orientation="BANKING",
        bank_strength=LOOK_AHEAD_BANK,
        bank_smoothing=2.0 * flight.BANK_SMOOTHING,
        forward_axis="POS_Y",
        up_axis="POS_Z",
    )
    path = _outer_path(collection, course, CHASE_PULL, CHASE_LIFT)
    camera = _add_camera(collection, "Chase Camera", CHASE_LENS)
    # The two paths differ in length; equal times for a lap keep the camera near the aeroplane.
    flight.follow(camera, path, timing="DURATION", duration=lap, offset=-CHASE_DISTANCE, orientation="NONE")
    camera.data.shift_y = CHASE_SHIFT
    _track(camera, ahead, lean=True)
    return camera


def _add_standing_camera(collection, course, plane, stand):
    position, direction = flight.place_on_course(course, stand.passing * flight.SPEED)
    right = Vector((direction.y, -direction.x, 0.0))
    camera = _add_camera(collection, stand.name, stand.lens)
    camera.location = position + direction * stand.ahead + right * stand.outward + Vector((0.0, 0.0, stand.up))
    camera.data.shift_x, camera.data.shift_y = stand.shift
    _track(camera, plane)
    return camera


def _outer_path(collection, course, pull, lift):
    """Make a copy of a course, with each knot moved away from the origin by `pull` and up by `lift`, in m."""
    path = shapes.link_object(collection, "Camera Path", course.data.copy())
    path.data.name = "Camera Path"
    path.data.bevel_depth = 0.0
    path.data.materials.clear()
    path.hide_render = True
    points = path.data.splines[0].bezier_points
    outward = [Vector((p.co.x, p.co.y, 0.0)).normalized() * pull + Vector((0.0, 0.0, lift)) for p in points]
    flight.move_points(points, lambda position, index: position + outward[index])
    return path


def _add_camera(collection, name, lens):
    """Add a camera whose clipping range reaches to the end of the land."""
    data = bpy.data.cameras.new(name)
    data.lens = lens
    data.clip_start, data.clip_end = 0.5, 3.0 * landscape.EXTENT
    return shapes.link_object(collection, name, data)


def _track(camera, target, lean=False):
    """Aim a camera at a target. lean: whether the camera's up is the target's Z axis instead of the world's."""
    constraint = camera.constraints.new("TRACK_TO")
    constraint.target = target
    constraint.track_axis, constraint.up_axis = "TRACK_NEGATIVE_Z", "UP_Y"
    constraint.use_target_z = lean
