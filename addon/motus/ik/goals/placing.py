"""Find where a chain's target and pole have to be so that the chain's pose stays as it is, and the axis about which the chain bends."""

import itertools
import math

from mathutils import Euler, Vector

from ...core.settings import targets
from .. import chains, forward
from . import places as goal_places
from .orientation import frame_of

CONTROL_KEY = "motus_ik_control"
"""Custom property that marks the empties and control bones that Motus has made as targets and poles."""

BENT = 1e-4  # rad: joints that bend by less do not show a plane, since the bones' positions are rounded
ROUNDS = 20  # most corrections of a new pole
STILL = 1e-7  # sine of half the error angle at which the corrections of a pole end
ALIGNED = 1e-6  # rad: orientations that differ by less count as equal; the difference is rounding
TARGET_SIZE, POLE_SIZE = 0.08, 0.05  # display sizes of new empties, in lengths of the chain
DEFAULT_LENGTH = 1.0  # m, used for a chain without length


def rest_joints(rig, chain):
    """Positions of a chain's joints at rest, from the root to the tip, in armature space."""
    bones = rig.data.bones
    last = bones[chain.effector]
    return [bones[name].head_local.copy() for name in chain.bones] + [(last.tail_local if chain.use_tail else last.head_local).copy()]


def posed_joints(rig, chain):
    """Positions of a chain's joints in the pose of the evaluated rig, from the root to the tip, in world space."""
    return [rig.matrix_world @ place for place in _joints_in_rig(rig, chain)]


def _joints_in_rig(rig, chain):
    """Positions of a chain's joints in the pose of the evaluated rig, from the root to the tip, in armature space."""
    bones = rig.pose.bones
    last = bones[chain.effector]
    return [bones[name].head for name in chain.bones] + [last.tail if chain.use_tail else last.head]


def length(joints):
    """Length of a chain from the positions of its joints: the sum of the distances from each joint to the next."""
    return sum((end - start).length for start, end in itertools.pairwise(joints))


def bend_normal(joints, least=BENT):
    """Unit normal of the plane in which a chain's joints bend; None if they bend by less than `least`, in radians.

    The vector normal x (tip - root) points to the side to which the chain bends. joints: positions from the root to the tip.
    """
    links = [end - start for start, end in itertools.pairwise(joints)]
    angles = [start.angle(end, 0.0) for start, end in itertools.pairwise(links)]
    along = joints[-1] - joints[0]
    normal = sum((along.cross(joint - joints[0]) for joint in joints[1:-1]), Vector())
    if not angles or max(angles) < least or normal.length_squared == 0.0:
        return None
    return normal.normalized()


def hinge_angle(rig, evaluated, chain, pole=None):
    """Bend Axis of a new entry: angle in radians about the first bone's Y axis.

    It is the axis about which the chain bends at rest. If the chain is straight at rest, it is the axis of the bend in the pose. If
    it is straight in the pose, too, it is the axis for which a pole at the world position `pole` turns nothing; 0 without a pole.
    """
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
    """Angle in radians about a bone's Y axis from its X axis to the normal of a bend. matrix: the bone's, in the space of the normal.

    In a mirrored matrix, it is the angle to the opposite of the normal, which there bends the chain to the side that is wanted.
    """
    local = matrix.to_3x3().inverted_safe() @ normal
    side = math.copysign(1.0, matrix.determinant())
    return math.atan2(-side * local.z, side * local.x)


def hinge_normal(evaluated, chain, angle):
    """World direction of a chain's Bend Axis, a unit vector. angle: the setting, radians about the first bone's Y axis."""
    local = Vector((math.cos(angle), 0.0, -math.sin(angle)))
    return ((evaluated.matrix_world @ evaluated.pose.bones[chain.bones[0]].matrix).to_3x3() @ local).normalized()


def effector_orientation(evaluated, chain):
    """World orientation, a Quaternion, of the bone that the chain's entry is named after."""
    return frame_of(evaluated.matrix_world @ evaluated.pose.bones[chain.effector].matrix)


def goal_matrix(context, target, bone):
    """Evaluated world matrix of a target or pole; None if the object lacks the bone. bone: "" for the object itself."""
    return goal_places.world_matrix(target.evaluated_get(context.view_layer.depsgraph), bone)


def rotation_offset(context, evaluated, chain, target, bone):
    """Rotation offset, an Euler, with which a chain keeps the present orientation of its last bone for a target.

    It is a turn in the target's own space, after which the target is oriented as the bone is now.
    """
    space = goal_matrix(context, target, bone).to_3x3()
    turn = frame_of(space.inverted_safe() @ effector_orientation(evaluated, chain).to_matrix())
    return turn.to_euler('XYZ') if turn.angle > ALIGNED else Euler()


def pole_place(rig, entry, depsgraph, turned):
    """World position of a pole that leaves a chain posed as it is without a pole. The chain's root if the rig is scaled to nothing.

    turned: Pole Angle, in radians, by which the present pose is turned.
    """
    evaluated = rig.evaluated_get(depsgraph)
    chain = chains.find(rig, entry)
    root = evaluated.matrix_world @ evaluated.pose.bones[chain.bones[0]].head
    found = forward.solver_of(rig, entry.name, depsgraph)
    pole = _pole_of_solution(*found, entry, root, turned) if found else root  # type: ignore[call-arg]
    return Vector(pole) if all(map(math.isfinite, pole)) else root  # not finite: the rig is scaled to nothing


def _pole_of_solution(solver, rows, entry, root, turned):
    def put(**values):
        for name, value in values.items():
            solver.settings[rows.index, solver.columns[name]] = value

    put(is_on=1.0, position_weight=1.0, pole_angle=entry.pole_angle - turned)
    put(bend=-1.0 if entry.bend == 'AWAY' else 1.0)  # the solver reads this setting only for chains that have a pole
    pole = Vector(solver.match()[1][rows.index].tolist())
    put(pole_angle=turned)
    wanted = _frame_of_first(solver, rows, (math.nan,) * 3)
    put(pole_angle=entry.pole_angle)
    return min(_poles_from(pole, solver, rows, root, wanted))[1]


def _poles_from(pole, solver, rows, root, wanted):
    """Yield (error, pole) of rounds that improve a pole until the first bone has the wanted orientation.

    error: sine of half the angle by which the first bone misses that orientation. pole: world position; each round turns it about
    the root, by the opposite of the error of the round before. The first pole is exact only if the target is at the tip of the
    animated pose and no joint limits are kept.
    """
    for _ in range(ROUNDS):
        turn = _frame_of_first(solver, rows, pole) @ wanted.inverted()
        away = Vector(turn[1:]).length
        yield away, tuple(pole)
        if away < STILL:
            break
        pole = root + turn.inverted() @ (pole - root)


def _frame_of_first(solver, rows, pole):
    """World orientation, a Quaternion, of a chain's first bone in the solution with a pole at a world position; NaN for no pole."""
    solver.poles[rows.index] = pole
    solver.solve()
    return frame_of(solver.poses(rows)[int(solver.settings[rows.index, solver.columns["left_out"]])])


def pole_angle(rig, entry, depsgraph, place, keeps_pose):
    """(error, Pole Angle in radians) with which a chain whose pole is at a world position has the pose that is wanted.

    keeps_pose: whether that is its present pose; otherwise it is the one that the chain has without a pole. error: sine of half the angle
    by which the first bone misses it. None if the chain is not solved, or cannot be as its rig is scaled to nothing.
    """
    found = forward.solver_of(rig, entry.name, depsgraph)
    if found is None:
        return None
    solver, rows = found
    table, columns = solver.settings, solver.columns

    def frame_at(pole, angle):
        table[rows.index, columns["pole_angle"]] = angle
        return _frame_of_first(solver, rows, pole)

    table[rows.index, columns["is_on"]] = table[rows.index, columns["position_weight"]] = 1.0
    now = tuple(solver.poles[rows.index])
    wanted = frame_at(now, entry.pole_angle) if keeps_pose else frame_at((math.nan,) * 3, 0.0)
    table[rows.index, columns["bend"]] = -1.0 if entry.bend == 'AWAY' else 1.0
    bones = rig.evaluated_get(depsgraph).pose.bones
    root = solver.world @ bones[rows.bones[int(table[rows.index, columns["left_out"]])]].head
    axis = (Vector(solver.targets[rows.index, 12:15]) - root).normalized()
    side = math.copysign(1.0, solver.world.determinant())  # in a mirrored rig angles turn the other way
    found = min(_angles_from(entry.pole_angle, lambda angle: wanted @ frame_at(place, angle).inverted(), side * axis))
    return found if all(map(math.isfinite, found)) else None


def _angles_from(angle, missing, axis):
    """Yield (error, Pole Angle) of rounds that improve an angle, each by what the turn missing(angle) is about the chain's line.

    error: sine of half the missing turn. axis: unit vector from the root to the target.
    """
    for _ in range(ROUNDS):
        turn = missing(angle)
        vector = Vector(turn[1:])
        yield vector.length, math.remainder(angle, math.tau)
        if vector.length < STILL:
            break
        angle += 2.0 * math.atan2(vector.dot(axis), turn.w)


def new_target(context, evaluated, chain):
    """Make an empty at a chain's tip as its target, with the orientation of the entry's bone. Returns the empty."""
    joints = posed_joints(evaluated, chain)
    empty = _empty(context, evaluated, f"{evaluated.name} {chain.effector} Target", 'CUBE')
    empty.empty_display_size = TARGET_SIZE * (length(joints) or DEFAULT_LENGTH)
    matrix = effector_orientation(evaluated, chain).to_matrix().to_4x4()
    matrix.translation = joints[-1]
    empty.matrix_world = matrix
    return empty


def new_pole(context, rig, entry, turned):
    """Make an empty as the pole of an entry, at the side to which the chain bends. Returns the empty.

    turned: Pole Angle, in radians, by which the present pose is turned.
    """
    evaluated = rig.evaluated_get(context.view_layer.depsgraph)
    empty = _empty(context, evaluated, f"{rig.name} {entry.name} Pole", 'SPHERE')
    joints = posed_joints(evaluated, chains.find(rig, entry))
    empty.empty_display_size = POLE_SIZE * (length(joints) or DEFAULT_LENGTH)
    empty.location = pole_place(rig, entry, context.view_layer.depsgraph, turned)
    return empty


def _empty(context, evaluated, name, shape):
    empty = targets.new_empty(context, evaluated.original, name, CONTROL_KEY)
    empty.empty_display_type = shape
    return empty
