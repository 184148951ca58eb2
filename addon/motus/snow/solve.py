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
from ..core.lazy import numpy as np
from ..core.scenery import meshes
from . import births, clock, colliders, flakes, landings, view

NO_SURFACE = Problem("Choose the mesh that emits the flakes")
SURFACE_DELETED = Problem("The mesh that emits the flakes is in no collection any more: choose another one")
NO_FACES = Problem("The mesh that emits the flakes has no faces")
UNKNOWN = Problem("The emitter's motion is not known ahead, and flakes are born where it stands now: record it, or key it", False)
NO_FLAKES = Problem("Choose what flakes look like: there is no such object or collection", False)
FLAT = Problem("The emitter has a scale of 0, and can show no flakes")
UNBAKEABLE = Problem("Flakes are computed on each frame: there is nothing to bake")
UNKNOWN_WIND = Problem("The wind is not known ahead, and blows on all frames as it does now: key it, or record it", blocking=False)
UNKNOWN_RATE = Problem("The rate is not known ahead, and counts for all frames as it is now: key it, or record it", blocking=False)
FINDING = Problem("Flakes appear as soon as it is known where they land", blocking=False)
PROBLEMS = (
    *colliders.PROBLEMS,
    NO_SURFACE,
    SURFACE_DELETED,
    NO_FACES,
    *view.PROBLEMS,
    UNKNOWN,
    UNKNOWN_WIND,
    UNKNOWN_RATE,
    *clock.PROBLEMS,
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

    life: most own seconds that a flake lives. shown: share of the flakes in the viewport, 0 to 1.
    is_local: whether flakes follow the emitter. has_scale: whether the emitter's scale counts for their size.
    """

    shape: str
    look: str
    life: float
    shown: float
    is_local: bool
    has_scale: bool
    use_ground: bool
    lands: bool

    @classmethod
    def of(cls, settings):
        """Read the settings."""
        return cls(
            settings.shape,
            settings.look,
            flakes.longest_life(settings),
            settings.preview / 100.0,
            settings.use_local,
            settings.use_scale,
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
    own, loop, late = context.kept("time", context.fps, lambda: _time(context, read))
    if late is clock.TOO_SHORT:
        return late
    poses, problem = _poses(context, camera or source(context.owner), emitter, angles, read, own, loop)
    wind, rate, unsure = context.kept("over time", None, lambda: _over_time(context, read, own, loop))
    if poses is None or wind is None or rate is None:
        return flakes.NOT_FINITE
    acceleration = tuple(scene.gravity) if scene.use_gravity else (0.0, 0.0, 0.0)
    barrier, carriers, fault = colliders.barrier(context, own, loop, read.life) if read.lands else (None, (), None)
    count = 0.0
    if loop:
        keywords, rate, count = flakes.looped(keywords, rate, loop.period)
    snow = flakes.made(keywords, acceleration, poses, wind, rate, faces, angles, barrier, carriers)
    if isinstance(snow, Problem):
        return snow
    when = flakes.moments(own, loop, context.frame, read.life, count)
    is_viewport = not waits_for_all(context.depsgraph)
    is_found = not (is_viewport and landings.are_left(context, snow, when, read.lands or read.use_ground))
    found = flakes.fill(context.points, snow, when, read.shown if is_viewport else 1.0, is_found)
    if read.has_scale and read.shape != 'CAMERA':
        found["radius"] *= np.float32(abs(emitter.determinant()) ** (1.0 / 3.0))
    if "velocity" in found and (own.keyed or own.speed != 1.0):
        found["velocity"] *= np.float32(own.speed_at(loop.within(context.frame) if loop else context.frame))
    return problem or unseen or late or unsure or fault or (None if is_found else FINDING) or _look_problem(settings, read.look)


def _time(context, read):
    """Return (Clock, Loop or None, Problem to show or None) of the emitter. read: the emitter's _Read."""
    own, is_known = clock.read(context.owner, context.fps)
    own, loop, problem = clock.looped(context.settings, own, read.life)
    return own, loop, problem or (None if is_known else clock.UNKNOWN)


def _over_time(context, read, own, loop):
    """Return (wind, rate, Problem to show or None) over the lives of the flakes; the wind or rate is None if it is not finite."""
    wind, is_wind_known = births.winds(context.owner, context.frame, read.life, own, loop)
    rate, is_rate_known = births.rate_of(context.owner, context.frame, own, loop)
    return wind, rate, UNKNOWN_WIND if not is_wind_known else UNKNOWN_RATE if not is_rate_known else None


def source(owner):
    """Object whose motion gives the places where flakes are born: the emitter, the mesh that emits them, or the camera.

    owner: emitter. None if the mesh or camera is not chosen.
    """
    settings = owner.motus.snow
    return {'SURFACE': pointed(settings, "surface"), 'CAMERA': pointed(settings, "camera")}.get(settings.shape, owner)


def _poses(context, born_at, present, angles, read, own, loop):
    """Return (births.Poses over time, Problem to show or None); the Poses are None if they are not finite.

    born_at: object whose poses count. present: its world matrix now. angles: half the angles of a camera's view, otherwise None.
    read: the emitter's _Read. own, loop: its Clock, and Loop or None.
    """
    settings, scene = context.settings, context.depsgraph.scene
    if read.is_local and angles is None:  # all flakes are where they would be if the emitter had always stood where it stands now
        return births.standing(present), None
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
        own,
        loop,
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
