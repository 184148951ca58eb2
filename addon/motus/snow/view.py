"""View of a camera, in which flakes are born: which camera counts, and the angles of its view."""

import math
from dataclasses import dataclass

from ..core import tracks
from ..core.declare import Problem, Variable
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np

NO_CAMERA = Problem("Choose a camera in whose view the flakes are born")
CAMERA_DELETED = Problem("The camera is in no collection any more: choose another one")
NO_PERSPECTIVE = Problem("Flakes are born only in the view of a perspective camera")
LENS_UNKNOWN = Problem("The camera's lens is not known ahead, and flakes are born in what it sees now: key it, or record it", False)
PROBLEMS = NO_CAMERA, CAMERA_DELETED, NO_PERSPECTIVE, LENS_UNKNOWN
WIDEST = math.radians(89.0)
"""Largest half angle of a camera's view, in radians, that is used."""
_OF_LENS = "lens", "sensor_width", "sensor_height", "shift_x", "shift_y"
"""Properties of a Camera datablock that its view depends on."""


@dataclass(frozen=True)
class Lens:
    """Declared input of a solver: focal length, in mm, of the camera object that the pointer setting `of` names.

    None if there is no such camera. Because of this input the solver runs again whenever the camera's data are edited.
    """

    name: str
    of: str

    def variable(self, _owner, settings):
        camera = pointed(settings, self.of)
        return Variable('CAMERA', camera.data, "lens") if camera is not None and camera.type == 'CAMERA' else None

    @staticmethod
    def read(value, _settings):
        return value or None


def cameras(settings, scene):
    """List the original cameras that timeline markers of a scene bind, if an emitter's flakes follow the markers.

    Empty if Follow Markers is off, or if no marker binds the chosen camera.
    """
    chosen = pointed(settings, "camera")
    if chosen is None or not settings.follow_markers or settings.shape != 'CAMERA':
        return []
    bound = list(dict.fromkeys(marker.camera.original for marker in scene.timeline_markers if marker.camera))
    return bound if chosen.original in bound else []


def filming(camera, settings, depsgraph, frame):
    """Return the evaluated camera in whose view flakes are born: the one that markers bind at a frame, or else the chosen camera.

    camera: chosen camera, evaluated. settings: of an emitter.
    """
    scene = depsgraph.scene
    if not cameras(settings, scene):
        return camera
    # Blender does the same: before the first marker that marker's camera counts, and cameras that are not rendered are skipped.
    bound = sorted(
        ((marker.frame, marker.camera) for marker in scene.timeline_markers if marker.camera and not marker.camera.hide_render),
        key=lambda one: one[0],
    )
    passed = [one for at, one in bound if at <= frame] or [one for _, one in bound[:1]]
    return passed[-1].evaluated_get(depsgraph) if passed else camera


def names(settings, scenes):
    """Return the names of the cameras that timeline markers of the scenes bind for an emitter, sorted, one on each line."""
    found = {camera.name for scene in scenes for camera in cameras(settings, scene)}
    return "\n".join(sorted(found))


def angles(camera, matrix, scene):
    """Return half the angles of a camera's view in X and Y, radians, for its widest lens on any frame.

    Returns a Problem if the camera is missing, deleted or not a perspective camera. camera: evaluated object, or None.
    matrix: world matrix of the camera, or None.
    """
    if camera is None or matrix is None or camera.type != 'CAMERA':
        return NO_CAMERA
    if deleted.is_deleted(camera):
        return CAMERA_DELETED
    if camera.data.type != 'PERSP':
        return NO_PERSPECTIVE
    data = camera.data
    sensor = "sensor_height" if data.sensor_fit == 'VERTICAL' else "sensor_width"
    # Flakes of all times are born in one view, which contains the views of all frames.
    wider = _on_all_frames(data, sensor).max() / max(1.0, _on_all_frames(data, "lens").min())
    shifts = (np.abs(_on_all_frames(data, name)).max() for name in ("shift_x", "shift_y"))
    return tuple(min(math.atan(wider * (half + shift)), WIDEST) for half, shift in zip(_halves(data, scene.render), shifts))


def _halves(data, render):
    """Half the picture's width and height, in multiples of the sensor's size.

    Camera.view_frame() is not used: its result changes in the last bits with lens and shift. render: RenderSettings of the scene.
    """
    width, height = render.resolution_x * render.pixel_aspect_x, render.resolution_y * render.pixel_aspect_y
    fitted = {'HORIZONTAL': width, 'VERTICAL': height}.get(data.sensor_fit, max(width, height))
    return 0.5 * width / fitted, 0.5 * height / fitted


def lens_problem(data):
    """Return the Problem LENS_UNKNOWN if a camera's lens is animated in a way that is not known ahead, such as by a driver; else None."""
    if data.animation_data is None or all(tracks.property_track(data, name).is_known for name in _OF_LENS):
        return None
    return LENS_UNKNOWN


def _on_all_frames(data, name):
    """Values (n,) that a number property of a camera's data has at its keys and between them; only the present value if it has no keys."""
    track = tracks.property_track(data, name) if data.animation_data is not None else None
    if track is None or not track.is_known or track.extent is None:
        return np.array([getattr(data, name)], float)
    first, last = (min(max(at, -1e6), 1e6) for at in track.extent)
    return track.values(np.array(track.bounds(first, last), float))
