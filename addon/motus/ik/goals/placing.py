"""Where a chain's target and pole have to stand so that the pose stays as it is, and about which axis it bends."""

import itertools
import math

import bpy
from mathutils import Euler, Vector

from ...core.file import libraries
from .. import chains, forward
from . import places as goal_places
from .orientation import frame_of

CONTROL_KEY = "motus_ik_control"
"""Custom property of the empties that are made along with an entry."""

BENT = 1e-4  # rad: of less, rounding of the bones' places leaves no plane
ROUNDS = 20  # of turning a pole back
STILL = 1e-7  # half an angle, rad
ALIGNED = 1e-6  # rad: what rounding leaves between orientations that are the same
TARGET_SIZE, POLE_SIZE = 0.08, 0.05  # of the chain's length
DEFAULT_LENGTH = 1.0  # m, of a chain without length


def rest_joints(rig, chain):
    """Places of the chain's joints at rest, from the root to the tip, in armature space."""
    bones = rig.data.bones
    last = bones[chain.effector]
    return [bones[name].head_local.copy() for name in chain.bones] + [(last.tail_local if chain.use_tail else last.head_local).copy()]


def posed_joints(rig, chain):
    """Places of the chain's joints as the evaluated rig is posed, from the root to the tip, in world space."""
    return [rig.matrix_world @ place for place in _joints_in_rig(rig, chain)]


def _joints_in_rig(rig, chain):
    """Places of the chain's joints as the evaluated rig is posed, from the root to the tip, in armature space."""
    bones = rig.pose.bones
    last = bones[chain.effector]
    return [bones[name].head for name in chain.bones] + [last.tail if chain.use_tail else last.head]


def length(joints):
    """Length of a chain of joints."""
    return sum((end - start).length for start, end in itertools.pairwise(joints))


def bend_normal(joints, least=BENT):
    """Unit normal of the plane that the joints bend in (normal x (tip - root) points to the bend's side).

    None where they bend by less than `least`, rad.
    """
    links = [end - start for start, end in itertools.pairwise(joints)]
    angles = [start.angle(end, 0.0) for start, end in itertools.pairwise(links)]
    along = joints[-1] - joints[0]
    normal = sum((along.cross(joint - joints[0]) for joint in joints[1:-1]), Vector())
    if not angles or max(angles) < least or normal.length_squared == 0.0:
        return None
    return normal.normalized()


def hinge_angle(rig, evaluated, chain, pole=None):
    """Bend Axis of a new entry: the joint's own at rest, else as posed; else such that the pole (a place) turns nothing; else 0."""
    normal = bend_normal(rest_joints(rig, chain))
    if normal:
        return _about(rig.data.bones[chain.bones[0]].matrix_local, normal)
    normal = bend_normal(_joints_in_rig(evaluated, chain))
    if normal:
        return _about(evaluated.pose.bones[chain.bones[0]].matrix, normal)
    if pole is not None:
        joints = posed_joints(evaluated, chain)
        normal = (joints[-1] - joints[0]).cross(pole - joints[0])
        if normal.length > 1e-6 * length(joints) ** 2:
            return _about(evaluated.matrix_world @ evaluated.pose.bones[chain.bones[0]].matrix, normal)
    return 0.0


def _about(matrix, normal):
    """Angle about a bone's Y from its X axis to the normal of a bend; in a mirrored matrix to its opposite, which bends the same way."""
    local = matrix.to_3x3().inverted_safe() @ normal
    side = math.copysign(1.0, matrix.determinant())
    return math.atan2(-side * local.z, side * local.x)


def hinge_normal(evaluated, chain, angle):
    """World direction of the first bone's Bend Axis."""
    local = Vector((math.cos(angle), 0.0, -math.sin(angle)))
    return ((evaluated.matrix_world @ evaluated.pose.bones[chain.bones[0]].matrix).to_3x3() @ local).normalized()


def effector_orientation(evaluated, chain):
    """World orientation of the bone that the entry is named after."""
    return frame_of(evaluated.matrix_world @ evaluated.pose.bones[chain.effector].matrix)


def goal_matrix(context, target, bone):
    """World matrix of a target or pole as it is evaluated."""
    return goal_places.world_matrix(target.evaluated_get(context.view_layer.depsgraph), bone)


def rotation_offset(context, evaluated, chain, target, bone):
    """The turn, in the target's own space, that makes its orientation that of the chain's last bone now."""
    space = goal_matrix(context, target, bone).to_3x3()
    turn = frame_of(space.inverted_safe() @ effector_orientation(evaluated, chain).to_matrix())
    return turn.to_euler('XYZ') if turn.angle > ALIGNED else Euler()


def pole_place(rig, entry, depsgraph, turned):
    """The place of a pole that leaves a chain posed as it is without a pole. turned: the Pole Angle that the chain has, rad."""
    evaluated = rig.evaluated_get(depsgraph)
    chain = chains.find(rig, entry)
    root = evaluated.matrix_world @ evaluated.pose.bones[chain.bones[0]].head
    found = forward.solver_of(rig, entry.name, depsgraph)
    pole = _pole_of_solution(*found, entry, root, turned) if found else root  # type: ignore[call-arg]
    return Vector(pole) if all(map(math.isfinite, pole)) else root  # of a rig that is scaled to nothing


def _pole_of_solution(solver, rows, entry, root, turned):
    def put(**values):
        for name, value in values.items():
            solver.settings[rows.index, solver.columns[name]] = value

    put(is_on=1.0, position_weight=1.0, pole_angle=entry.pole_angle - turned)
    put(bend=-1.0 if entry.bend == 'AWAY' else 1.0)  # read only of chains that have a pole
    pole = Vector(solver.match()[1][rows.index].tolist())
    put(pole_angle=turned)
    wanted = _frame_of_first(solver, rows, (math.nan,) * 3)
    put(pole_angle=entry.pole_angle)
    return min(_poles_from(pole, solver, rows, root, wanted))[1]


def _poles_from(pole, solver, rows, root, wanted):
    """Yield (error, pole) of rounds that improve a pole until the first bone has the wanted orientation.

    error: sine of half the angle by which the first bone is off. pole: the place in world space, turned about the root against
    the error of the round before. The first pole is exact only for a target at the tip of the animated pose, without limits.
    """
    for _ in range(ROUNDS):
        turn = _frame_of_first(solver, rows, pole) @ wanted.inverted()
        away = Vector(turn[1:]).length
        yield away, tuple(pole)
        if away < STILL:
            break
        pole = root + turn.inverted() @ (pole - root)


def _frame_of_first(solver, rows, pole):
    """World orientation of the chain's first bone in the solution with a pole."""
    solver.poles[rows.index] = pole
    solver.solve()
    return frame_of(solver.poses(rows)[int(solver.settings[rows.index, solver.columns["left_out"]])])


def new_target(context, evaluated, chain):
    """An empty on the chain's tip, turned as its last bone is."""
    joints = posed_joints(evaluated, chain)
    empty = _empty(context, evaluated, f"{evaluated.name} {chain.effector} Target", 'CUBE')
    empty.empty_display_size = TARGET_SIZE * (length(joints) or DEFAULT_LENGTH)
    matrix = effector_orientation(evaluated, chain).to_matrix().to_4x4()
    matrix.translation = joints[-1]
    empty.matrix_world = matrix
    return empty


def new_pole(context, rig, entry, turned):
    """An empty at the side that the chain bends to. turned: as for pole_place()."""
    evaluated = rig.evaluated_get(context.view_layer.depsgraph)
    empty = _empty(context, evaluated, f"{rig.name} {entry.name} Pole", 'SPHERE')
    joints = posed_joints(evaluated, chains.find(rig, entry))
    empty.empty_display_size = POLE_SIZE * (length(joints) or DEFAULT_LENGTH)
    empty.location = pole_place(rig, entry, context.view_layer.depsgraph, turned)
    return empty


def _empty(context, evaluated, name, shape):
    empty = bpy.data.objects.new(name, None)
    empty.empty_display_type = shape
    empty[CONTROL_KEY] = True
    libraries.collection_for(context, evaluated.original).objects.link(empty)
    return empty
