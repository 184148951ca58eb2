"""The scene "Motus Flight": an aeroplane on a banked course over a lake, and a train on its shore."""

import bpy

from ..flying import aeroplane, flight
from ..places import landscape, woods
from ..stage import lighting, staging
from . import cameras, props, railway

SCENE_NAME = "Motus Flight"
FRAMES_PER_SECOND = 24


def build(context):
    """Build the scene, show it in the window and return it."""
    scene = staging.new_scene(context, SCENE_NAME, FRAMES_PER_SECOND)
    land, air, views = (staging.new_collection(scene, name) for name in ("Landscape", "Flight", "Cameras"))
    haze = _build_light(scene, land)
    landscape.build(land, haze)
    line = railway.add_line(land)
    woods.build(land, haze, line.is_clear)
    railway.build(land, line, haze)
    course, imported = flight.import_course(scene)
    _adopt(course, air, imported)
    flight.lift_course(course)
    flight.draw_course(course)
    length = flight.course_length(course)
    lap = length / flight.SPEED
    plane = aeroplane.build(air)
    flight.fly(plane, course)
    props.build(air, course, length, haze, line.is_clear)
    cameras.build(scene, views, course, plane, lap)
    scene.frame_start, scene.frame_end = int(flight.FIRST_FRAME), round(lap * FRAMES_PER_SECOND)
    scene.frame_set(scene.frame_start)
    return scene


def _adopt(course, collection, imported):
    """Move the imported course to a collection of the scene, and remove the collections that the importer has made."""
    for other in list(course.users_collection):
        other.objects.unlink(course)
    collection.objects.link(course)
    for empty in imported:
        bpy.data.collections.remove(empty)


def _build_light(scene, collection):
    """Add sky and sun, and set the view transform. Returns the haze's node group for the materials."""
    sky = lighting.build_sky_group()
    scene.world = lighting.build_world(sky)
    lighting.add_sun(collection)
    lighting.set_color_management(scene)
    return lighting.build_haze_group(sky)
