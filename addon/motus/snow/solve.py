"""Snow: what its solver reads, and the one call of the library."""

from ..core import deleted
from ..core.system import Geometry, Matrix, OwnMatrix, Points, Problem, Setting
from . import births, flakes

NO_SURFACE = Problem("Choose a mesh that flakes leave")
SURFACE_DELETED = Problem("The mesh that flakes leave is in no collection any more: choose another one")
NO_FACES = Problem("The mesh that flakes leave has no faces")
UNKNOWN = Problem(
    "The emitter's motion is not known ahead, and flakes are born where it stands now: record it, or key it", False)
NO_FLAKES = Problem("Choose what flakes look like: there is no such object or collection", False)
FLAT = Problem("The emitter has a scale of 0, and can show no flakes")
UNBAKEABLE = Problem("Flakes are computed on each frame: there is nothing to bake")
NO_COLLIDER = Problem("The collider is gone: flakes fall on without it", blocking=False)
COLLIDER_WITHOUT_FACES = Problem("The collider has no faces: flakes fall through it", blocking=False)
COLLIDER_MOVES = Problem("The collider moves: flakes land where it is on the present frame", blocking=False)
PROBLEMS = (NO_COLLIDER, COLLIDER_WITHOUT_FACES, COLLIDER_MOVES, NO_SURFACE, SURFACE_DELETED, NO_FACES, UNKNOWN, NO_FLAKES, FLAT, flakes.NOT_FINITE, flakes.TOO_MANY,
            flakes.OUT_OF_RANGE)


def _unneeded(settings):
    """Instances are blurred by their own motion, and bare points do not show how they are turned."""
    if settings.all_attributes:
        return ()
    return ("turn",) if settings.look == 'POINTS' else ("velocity",)


# Cycles has an own sense for an attribute that is named "color".
POINTS = Points(
    attributes=(("velocity", 'VECTOR'), ("radius", 'FLOAT'), ("tint", 'COLOR'), ("age", 'FLOAT'), ("turn", 'QUATERNION'),
                ("id", 'INT')),
    capacity=flakes.MOST, unneeded=_unneeded)
INPUTS = (OwnMatrix("emitter"), Matrix("placed", of="surface"), Geometry("surface", of="surface"),
          Matrix("standing", of="collider"), Geometry("collider", of="collider"), Setting("influence"))


def solve(context, emitter, placed, surface, standing, collider, influence):
    """Flakes in world space."""
    settings = context.settings
    keywords = context.kept("keywords", None, lambda: flakes.numbers(settings))
    if isinstance(keywords, Problem):
        return keywords
    if influence <= 0.0:
        return None
    if emitter is None or emitter.determinant() == 0.0:
        return FLAT
    faces = None
    if settings.shape == 'SURFACE':
        emitter, faces = placed, _faces(context, placed, surface)
        if isinstance(faces, Problem):
            return faces
    poses, problem = _poses(context, emitter)
    if poses is None:
        return flakes.NOT_FINITE
    scene = context.depsgraph.scene
    acceleration = tuple(scene.gravity) if scene.use_gravity else (0.0, 0.0, 0.0)
    barrier, fault = _barrier(context, standing, collider) if settings.collider else (None, None)
    snow = flakes.made(keywords, acceleration, poses, faces, barrier)
    if isinstance(snow, Problem):
        return snow
    share = settings.preview / 100.0 if context.depsgraph.mode == 'VIEWPORT' else 1.0
    flakes.fill(context.points, snow, (context.frame - settings.start_frame) / context.fps, share)
    return problem or fault or _look_problem(settings)


def source(owner):
    """The object at whose poses flakes are born: the emitter, or the one whose faces they leave."""
    settings = owner.motus.snow
    return settings.surface if settings.shape == 'SURFACE' else owner


def _poses(context, present):
    """(Poses, Problem or None); None for poses that are not finite."""
    settings = context.settings
    poses, is_known = births.over_time(
        source(context.owner), context.depsgraph.scene, present, context.frame, flakes.longest_life(settings),
        settings.start_frame, context.fps)
    return poses, None if is_known else UNKNOWN


def _faces(context, placed, surface):
    found = context.target("surface")
    if found is None or placed is None or surface is None or found.type != 'MESH':
        return NO_SURFACE
    if deleted.is_deleted(found):
        return SURFACE_DELETED
    return births.faces(surface.data) or NO_FACES


def _barrier(context, standing, collider):
    """(the native SnowCollider or None, Problem or None)."""
    found = context.target("collider")
    if found is None or standing is None or collider is None or found.type != 'MESH' or deleted.is_deleted(found):
        return None, NO_COLLIDER
    faces = births.faces(collider.data)
    barrier = faces and flakes.collider(births.placed(faces, standing))
    if barrier is None:
        return None, COLLIDER_WITHOUT_FACES
    moved = births.track(found, context.depsgraph.scene)
    return barrier, COLLIDER_MOVES if not moved.is_known or moved.extent is not None else None


def _look_problem(settings):
    is_missing = settings.look == 'OBJECT' and settings.flake is None or (
        settings.look == 'COLLECTION' and settings.flakes is None)
    return NO_FLAKES if is_missing else None
