"""The spider of the main scene, which walks over the snow to the landed aeroplane."""

import bpy
import numpy as np

from ..flying import flight
from . import terrain

SPAN, COLOR = 0.60, (0.62, 0.10, 0.02, 1.0)  # m
WAY = ((-3.6, 4.0), (-2.5, 3.25), (-1.6, 2.75), (-0.85, 2.15), (-0.22, 1.62))  # x, y of the path, which ends in front of the aeroplane
START, SECONDS, EASE_IN, EASE_OUT = -24.0, 10.8, 0.04, 0.16  # first frame, duration in s, and the shares of the duration that easing takes
WALKER = {"gait": "TETRAPOD", "stride": 0.24, "clearance": 0.07}


def build(context, collection, ground):
    """Build the spider and its path with the public operators. ground: object on which the spider walks."""
    view_layer = context.view_layer
    view_layer.active_layer_collection = view_layer.layer_collection.children[collection.name]
    places = [(x, y, float(terrain.height(np.array(x), np.array(y)))) for x, y in WAY]
    _check(bpy.ops.motus.spider_add(location=places[0], size=SPAN, color=COLOR, ground=ground.name, **WALKER))
    spider = context.object
    course = flight.add_course(collection, places)
    course.name = "Spider Course"
    _check(
        bpy.ops.motus.path_follow_add(
            object=spider.name,
            curve=course.name,
            start_frame=START,
            timing="DURATION",
            duration=SECONDS,
            ease_in=EASE_IN,
            ease_out=EASE_OUT,
            orientation="WORLD_UP",
            forward_axis="POS_Y",
            up_axis="POS_Z",
        )
    )
    return spider


def _check(result):
    if result != {"FINISHED"}:
        raise RuntimeError("The spider could not be set on its way")
