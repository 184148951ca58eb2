"""Solver of snow: it reads the emitter's settings, lets the native library compute the flakes, and fills the emitter's points.

A Problem is a sentence that the panel shows.
"""

from typing import NamedTuple

from ..core import rigs
from ..core.animation import strips
from ..core.declare import Geometries, Geometry, Matrix, OwnMatrix, Points, Problem, Setting
from ..core.evaluated.shares import waits_for_all
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.scenery import meshes
from . import births, colliders, flakes, landings, view

NO_SURFACE = Problem("Choose the mesh that emits the flakes")
SURFACE_DELETED = Problem("The mesh that emits the flakes is in no collection any more: choose another one")
NO_FACES = Problem("The mesh that emits the flakes has no faces")
UNKNOWN = Problem("The emitter's motion is not known ahead, and flakes are born where it stands now: record it, or key it", False)
NO_FLAKES = Problem("Choose what flakes look like: there is no such object or collection", False)
FLAT = Problem("The emitter has a scale of 0, and can show no flakes")
UNBAKEABLE = Problem("Flakes are computed on each frame: there is nothing to bake")
UNKNOWN_WIND = Problem("The wind is not known ahead, and blows on all frames as it does now: key it, or record it", blocking=False)
FINDING = Problem("Flakes appear as soon as it is known where they land", blocking=False)
PROBLEMS = (
    *colliders.PROBLEMS,
    NO_SURFACE,
    SURFACE_DELETED,
    NO_FACES,
    *view.PROBLEMS,
    UNKNOWN,
    UNKNOWN_WIND,
    FINDING,
    NO_FLAKES,
    FLAT,
    flakes.NOT_FINITE,
    flakes.TOO_MANY,
    flakes.OUT_OF_RANGE,
)


def _unneeded(settings):
    """Names of the attributes that Blender does not need for the look of the flakes, and that are therefore left out.

    Motion blur of instances does not need their velocity, and bare points do not show a rotation.
    """
    if settings.all_attributes:
        return ()
    return ("turn",) if settings.look == 'POINTS' else ("velocity",)


# The colour is named "tint" because Cycles gives an attribute named "color" a meaning of its own.
POINTS = Points(
    attributes=(("velocity", 'VECTOR'), ("radius", 'FLOAT'), ("tint", 'COLOR'), ("age", 'FLOAT'), ("turn", 'QUATERNION'), ("id", 'INT')),
    capacity=flakes.MOST,
    unneeded=_unneeded,
)
INPUTS = (
    OwnMatrix("emitter"),
    Matrix("placed", of="surface"),
    Geometry("surface", of="surface"),
    Matrix("seeing", of="camera"),
    view.Lens("lens", of="camera"),
    Geometries("landed_on", of=colliders.objects),
    Setting("influence"),
)


class _Read(NamedTuple):
    """Settings of an emitter that each solve needs, read once for as long as nothing animates them.

    life: most seconds that a flake lives. start: first frame. shown: share of the flakes in the viewport, 0 to 1.
    """

    shape: str
    look: str
    life: float
    start: float
    shown: float
    use_ground: bool
    lands: bool

    @classmethod
    def of(cls, settings):
        """Read the settings."""
        return cls(
            settings.shape,
            settings.look,
            flakes.longest_life(settings),
            settings.start_frame,
            settings.preview / 100.0,
            settings.use_ground,
            colliders.are_any(settings),
        )


def solve(context, emitter, placed, surface, seeing, lens, landed_on, influence):
    """Compute the flakes at the frame of the context, in world space, as the points of the emitter; returns the Problem to show, or None.

    emitter: world matrix of the emitter. placed, surface: world matrix and evaluated object of the mesh that emits flakes.
    seeing: world matrix of the chosen camera. lens: an input only so that the solver runs again if the lens changes.
    landed_on: colliders, an input only so that Blender evaluates them first. influence: 0 hides the snow.
    """
    settings = context.settings
    keywords = context.kept("keywords", None, lambda: flakes.numbers(settings))
    if isinstance(keywords, Problem):
        return keywords
    if influence <= 0.0:
        return None
    if emitter is None or emitter.determinant() == 0.0:
        return FLAT
    scene, read = context.depsgraph.scene, context.kept("read", None, lambda: _Read.of(settings))
    faces = camera = angles = unseen = None
    if read.shape == 'SURFACE':
        emitter, faces = placed, _faces(context, placed, surface)
        if isinstance(faces, Problem):
            return faces
    elif read.shape == 'CAMERA':
        if not set(view.names(settings, [scene]).splitlines()).issubset(settings.reads.splitlines()):
            context.wants_to_settle = True
        camera = view.filming(context.target("camera"), settings, context.depsgraph, context.frame)
        emitter = seeing if camera == context.target("camera") else camera.matrix_world
        angles = view.angles(camera, emitter, scene)
        if isinstance(angles, Problem):
            return angles
        unseen = view.lens_problem(camera.data)
    poses, problem = _poses(context, camera or source(context.owner), emitter, angles, read)
    wind, is_sure = context.kept("wind", None, lambda: births.winds(context.owner, context.frame, read.life, read.start, context.fps))
    if poses is None or wind is None:
        return flakes.NOT_FINITE
    acceleration = tuple(scene.gravity) if scene.use_gravity else (0.0, 0.0, 0.0)
    barrier, fault = colliders.barrier(context) if read.lands else (None, None)
    snow = flakes.made(keywords, acceleration, poses, wind, faces, angles, barrier)
    if isinstance(snow, Problem):
        return snow
    seconds = (context.frame - read.start) / context.fps
    is_viewport = not waits_for_all(context.depsgraph)
    is_found = not (is_viewport and landings.are_left(context, snow, seconds, read.lands or read.use_ground))
    flakes.fill(context.points, snow, seconds, read.shown if is_viewport else 1.0, is_found)
    unsure = None if is_sure else UNKNOWN_WIND
    return problem or unseen or unsure or fault or (None if is_found else FINDING) or _look_problem(settings, read.look)


def source(owner):
    """Object whose motion gives the places where flakes are born: the emitter, the mesh that emits them, or the camera.

    owner: emitter. None if the mesh or camera is not chosen.
    """
    settings = owner.motus.snow
    return {'SURFACE': pointed(settings, "surface"), 'CAMERA': pointed(settings, "camera")}.get(settings.shape, owner)


def _poses(context, born_at, present, angles, read):
    """Return (births.Poses over time, Problem to show or None); the Poses are None if they are not finite.

    born_at: object whose poses count. present: its world matrix now. angles: half the angles of a camera's view, otherwise None.
    read: the emitter's _Read.
    """
    settings, scene = context.settings, context.depsgraph.scene
    if born_at == context.owner:
        keys = strips.stamp_of(born_at.animation_data)
        if context.kept("stands", keys, lambda: births.stands(born_at, scene)):
            return context.kept("standing", rigs.bytes_of(present), lambda: births.standing(present)), None
    poses, is_known = births.over_time(
        born_at,
        scene,
        present,
        context.frame,
        read.life,
        read.start,
        context.fps,
        None if angles is None else (angles, settings.closest, settings.farthest),
    )
    return poses, None if is_known else UNKNOWN


def _faces(context, placed, surface):
    found = context.target("surface")
    if found is None or placed is None or surface is None or found.type != 'MESH':
        return NO_SURFACE
    if deleted.is_deleted(found):
        return SURFACE_DELETED
    return meshes.faces(surface) or NO_FACES


def _look_problem(settings, look):
    is_missing = (look == 'OBJECT' and pointed(settings, "flake") is None) or (look == 'COLLECTION' and pointed(settings, "flakes") is None)
    return NO_FLAKES if is_missing else None
