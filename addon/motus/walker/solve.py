"""Solvers of walkers: they look up the feet and the body in the plan of the shot, which plan.py makes.

A Problem is a sentence that the panel shows.
"""

from mathutils import Matrix

from ..core import rigs, tracks
from ..core.declare import Geometries, Problem
from ..core.evaluated.shares import waits_for_all
from ..core.file.stored import Damaged
from ..core.lazy import numpy as np
from ..core.tracks import rotations
from . import ground, groups, leaning, legs, plan, shared, soles

LOOPED = Problem("The body or the ground moves with what the walker drives: what would wait for itself is left alone", blocking=False)
LACKING = Problem("Some legs have no foot any more: add the walker again", blocking=False)
BODILESS = Problem("The body that rises and leans is gone, or hangs on something else: choose it anew", blocking=False)
UNREACHED = Problem("Some feet do not reach the ground at their footholds", blocking=False)
UNTIMED = Problem("Some steps cannot be when they are set", blocking=False)
BONES_CHANGED = Problem("The rig's bones have changed: press Refresh")
PROBLEMS = (*plan.PROBLEMS, LOOPED, LACKING, BODILESS, UNREACHED, UNTIMED, BONES_CHANGED)

MISTIMED = {"no_touch", "no_lift", "left_out"}
"""Reasons of walker.problems that tell of times, not of places."""

INPUTS = (Geometries("awaited", of=ground.objects),)


class Wired:
    """The row of a body bone in the arrays of its rig, and the rig's data that stay until its bones change (rigs.still())."""

    def __init__(self, rig, rows, name):
        self.still = rigs.still(rig, tuple(rows))
        self.row = rows[name]
        self._at_rest = None, None  # the Still, and the location channels of a body bone without a parent, which depend on nothing else

    def channels(self, bone):
        """3x3 matrix from the location channels of the body bone to the rig's space."""
        if bone.parent:
            return leaning.location_channels(bone, bone.parent.matrix)
        if self._at_rest[0] is not self.still:
            self._at_rest = self.still, leaning.location_channels(bone, None)
        return self._at_rest[1]


def solve(context, awaited):
    """Solve one group of a walker at the frame of the context; returns the Problem to show, or None.

    The group is either the feet, whose places are written into the context, or the body, whose location and rotation are written.
    awaited: ground meshes. They are a declared input only so that Blender evaluates them before the walker.
    """
    del awaited
    owner, scene = context.owner, context.depsgraph.scene
    noted = groups.parsed(context.data.get(groups.PLAN))
    found = shared.found(
        context,
        lambda: plan.of(
            owner,
            scene,
            context.kept("numbers", None, lambda: plan.read(context.settings)),
            None if waits_for_all(context.depsgraph) else context.frame,
        ),
    )
    if isinstance(found, Problem):
        return found
    seconds = context.frame / context.fps
    if context.group == groups.BODY:
        return _lean(context, found.walker, seconds)
    _stand(context, found.walker.feet(seconds), noted)
    if found.turns:
        _turn(context, soles.turned(found, seconds), noted)
    return _fault(found, noted)


def _fault(found, noted):
    if noted.is_looped:
        return LOOPED
    if noted.lacks:
        return LACKING
    if noted.is_bodiless:
        return BODILESS
    if found.fault:
        return found.fault
    if not found.troubles:
        return None
    return UNTIMED if found.troubles <= MISTIMED else UNREACHED


def _stand(context, places, noted):
    """Write the places (m, 3) of the feet into the context: in world space for objects, in the armature's space for bones.

    places: (legs, 3), world space, from the plan. noted: the groups.Noted of this group. Raises Damaged if they do not fit together.
    """
    legs_of, bones = noted.legs, noted.bones
    if len(legs_of) != len(context.locations) or (len(legs_of) and legs_of[-1] >= len(places)):
        raise Damaged("another number of feet")
    context.locations[:] = places[legs_of]
    if len(bones):
        inverse = np.array(context.owner.matrix_world.inverted_safe(), float)
        context.locations[bones] = context.locations[bones] @ inverse[:3, :3].T + inverse[:3, 3]


def _turn(context, turns, noted):
    """Write the turns of the feet into the context: in world space for objects, in the armature's space for bones.

    turns: (legs, 4), world space. noted: the groups.Noted of this group, which fits them.
    """
    context.rotations[:] = turns[noted.legs]
    if len(noted.bones):
        inverse = np.array(context.owner.matrix_world.to_quaternion().inverted())[None]
        context.rotations[noted.bones] = rotations.product(inverse, context.rotations[noted.bones])


def _lean(context, walker, seconds):
    lift, turn = leaning.share(*walker.body(seconds), context.settings.influence)  # type: ignore[call-arg]
    owner, body = context.owner, legs.body(context.owner)
    if body is None or len(context.locations) != 1:
        return BODILESS
    world = owner.matrix_world
    if owner.pose:
        try:
            known = rigs.plan(owner, f"{context.data[groups.PLAN]} {body.name}", lambda rig, rows: Wired(rig, rows, body.name))
        except KeyError:
            return BONES_CHANGED
        basis = Matrix(rigs.basis(owner, known.still)[known.row].reshape(4, 4).T.tolist())
        place = world @ leaning.posed(body, basis, body.parent and body.parent.matrix)
        axes = world.to_3x3() @ known.channels(body)
    else:
        place, axes = leaning.of_object(body, _basis(body, context.frame), world)
    context.locations[0], context.rotations[0] = leaning.relative(place, axes, world.translation, lift, turn)
    return None


def _basis(body, frame):
    """Matrix of an object's own location, rotation and scale at a frame, read from F-curves; the present one if they are not known.

    The solver cannot read the evaluated object: Blender evaluates it after the solver, whose result drives it.
    """
    track = tracks.own_track(body)
    if not track.is_known:
        return body.matrix_basis
    return Matrix(track.values([frame]).matrices[0].tolist())
