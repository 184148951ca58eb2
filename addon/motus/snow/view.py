"""The part of space that a camera sees, in which flakes come into being."""

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
"""Half of what a camera sees by, at most."""
_OF_LENS = "lens", "sensor_width", "sensor_height", "shift_x", "shift_y"
"""Of a camera's data, the numbers that what it sees follows from."""


@dataclass(frozen=True)
class Lens:
    """Focal length, mm, of the camera object that the pointer setting `of` names; None without it.

    The solver runs again whenever the camera's data are edited.
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
    """The original cameras that the timeline's markers bind, if flakes follow markers and the chosen camera is one of them; else none."""
    chosen = pointed(settings, "camera")
    if chosen is None or not settings.follow_markers or settings.shape != 'CAMERA':
        return []
    bound = list(dict.fromkeys(marker.camera.original for marker in scene.timeline_markers if marker.camera))
    return bound if chosen.original in bound else []


def filming(camera, settings, depsgraph, frame):
    """The evaluated camera in whose view flakes are born on a frame: the one that is bound there, or the chosen one."""
    scene = depsgraph.scene
    if not cameras(settings, scene):
        return camera
    # As Blender has it: before the first marker its camera counts, and those that are not rendered do not.
    bound = sorted(
        ((marker.frame, marker.camera) for marker in scene.timeline_markers if marker.camera and not marker.camera.hide_render),
        key=lambda one: one[0],
    )
    passed = [one for at, one in bound if at <= frame] or [one for _, one in bound[:1]]
    return passed[-1].evaluated_get(depsgraph) if passed else camera


def names(settings, scenes):
    """The names of the cameras that the solver waits for in some scenes, beside the chosen one, a line each."""
    found = {camera.name for scene in scenes for camera in cameras(settings, scene)}
    return "\n".join(sorted(found))


def angles(camera, matrix, scene):
    """Half the angles, in X and Y, by which an evaluated camera sees, at the widest that its lens ever is; or a Problem."""
    if camera is None or matrix is None or camera.type != 'CAMERA':
        return NO_CAMERA
    if deleted.is_deleted(camera):
        return CAMERA_DELETED
    if camera.data.type != 'PERSP':
        return NO_PERSPECTIVE
    data = camera.data
    sensor = "sensor_height" if data.sensor_fit == 'VERTICAL' else "sensor_width"
    # Flakes of all times are born in the same view: whatever is seen on any frame.
    wider = _on_all_frames(data, sensor).max() / max(1.0, _on_all_frames(data, "lens").min())
    shifts = (np.abs(_on_all_frames(data, name)).max() for name in ("shift_x", "shift_y"))
    return tuple(min(math.atan(wider * (half + shift)), WIDEST) for half, shift in zip(_halves(data, scene.render), shifts))


def _halves(data, render):
    """Half the picture's width and height, in sizes of the sensor. Not by view_frame(), whose bits differ with lens and shift."""
    width, height = render.resolution_x * render.pixel_aspect_x, render.resolution_y * render.pixel_aspect_y
    fitted = {'HORIZONTAL': width, 'VERTICAL': height}.get(data.sensor_fit, max(width, height))
    return 0.5 * width / fitted, 0.5 * height / fitted


def lens_problem(data):
    """LENS_UNKNOWN of a camera's data whose lens may be another one on other frames, and nobody can tell which; else None."""
    if data.animation_data is None or all(tracks.property_track(data, name).is_known for name in _OF_LENS):
        return None
    return LENS_UNKNOWN


def _on_all_frames(data, name):
    """Values of a number of a camera's data, (n,): those of its keys, and between; or its present one."""
    track = tracks.property_track(data, name) if data.animation_data is not None else None
    if track is None or not track.is_known or track.extent is None:
        return np.array([getattr(data, name)], float)
    first, last = (min(max(at, -1e6), 1e6) for at in track.extent)
    return track.values(np.array(track.bounds(first, last), float))
