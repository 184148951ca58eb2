"""What a camera sees, in which flakes come into being."""

import math
from dataclasses import dataclass

from ..core import deleted, tracks
from ..core.lazy import numpy as np
from ..core.system import Problem, Variable, pointed

NO_CAMERA = Problem("Choose a camera in whose view flakes come into being")
CAMERA_DELETED = Problem("The camera is in no collection any more: choose another one")
NO_PERSPECTIVE = Problem("Flakes come into being in the view of a perspective camera alone")
LENS_UNKNOWN = Problem(
    "The camera's lens is not known ahead, and flakes are born in what it sees now: key it, or record it", False)
PROBLEMS = NO_CAMERA, CAMERA_DELETED, NO_PERSPECTIVE, LENS_UNKNOWN
WIDEST = math.radians(89.0)
"""Half of what a camera sees by, at most."""


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


def angles(camera, matrix, scene):
    """Half the angles, in X and Y, by which an evaluated camera sees, at the widest that its lens ever is; or a Problem."""
    if camera is None or matrix is None or camera.type != 'CAMERA':
        return NO_CAMERA
    if deleted.is_deleted(camera):
        return CAMERA_DELETED
    if camera.data.type != 'PERSP':
        return NO_PERSPECTIVE
    corners = np.abs(np.array([tuple(corner) for corner in camera.data.view_frame(scene=scene)]))
    longer = camera.data.lens / _shortest(camera.data)
    tangents = longer * corners[:, :2].max(axis=0) / corners[:, 2].min()
    return tuple(min(math.atan(tangent), WIDEST) for tangent in tangents.tolist())


def lens_problem(data):
    """LENS_UNKNOWN of a camera's data whose lens may be another one on other frames, and nobody can tell which; else None."""
    return None if data.animation_data is None or tracks.property_track(data, "lens").is_known else LENS_UNKNOWN


def _shortest(data):
    """The least focal length of all frames, so that flakes of all times are born in the same view."""
    if data.animation_data is None:
        return data.lens
    track = tracks.property_track(data, "lens")
    if not track.is_known or track.extent is None:
        return data.lens
    first, last = (min(max(at, -1e6), 1e6) for at in track.extent)
    return max(1.0, float(track.values(np.array(track.bounds(first, last), float)).min()))
