"""Pull a point on a bone to a place in the world, with the chain that the bone belongs to.

If a solver drives the chain, the chain's target is moved; otherwise the bones of the chain are turned. A bone that is itself a target
or a pole is moved as a whole.
"""

from mathutils import Matrix, Quaternion, Vector

from ...core import native, rigs
from ...core.bake.sampling import rotation_path
from ...core.blender.datablocks import Named
from ...core.lazy import numpy as np
from ...core.refusals import Refused, check_bone, check_local
from ...core.translations import tr
from .. import chains, forward, groups, reading
from ..goals import controls
from ..keying import rotation_values

TIP = slice(-3, None)  # columns of IkPlan.REPORT with the position of the chain's tip
SHORTEST = 1e-6  # share of the bone's length: a point at the bone's head is moved so far along the bone
ROUNDS = 12
NEAR = 1e-6  # in lengths of the chain: distance at which the point counts as brought to its place
PROBE = 1e-4  # in lengths of the chain: by so much the target is moved to measure how the point follows
LONGEST_STEP = 0.5  # in lengths of the chain: longest step of the target in one round of the search


def grab(context, rig, bone, factor, chain_length=0):
    """Take hold of a point on a bone. Returns an object whose pull(place) moves the point, and whose restore() undoes all moves.

    factor: place of the point along the bone, 0 at its head, 1 at its tail. chain_length: number of bones that turn if no solver
    drives the bone; 0 takes the connected bones up to a branch. Raises Refused if the chain cannot be dragged.
    """
    check_bone(rig, bone)
    check_local(rig)
    context.view_layer.update()
    settings = rig.motus.ik
    index = chains.entry_with(rig, bone) if settings.is_active and not settings.is_baked else -1
    if index < 0:
        bones = free_chain(rig, bone, chain_length)
        if any((rig, bone) in groups.goals(entry) for entry in settings.entries):
            return _ControlGrab(context, rig, bone, factor)
        return _PoseGrab(context, rig, bones, factor)
    entry = settings.entries[index]
    chain = chains.find(rig, entry)
    if entry.is_muted or entry.position_weight * settings.influence == 0.0:
        bones = chain.driven[: chain.driven.index(bone) + 1]
        return _PoseGrab(context, rig, bones, factor, entry)
    return _TargetGrab(context, rig, entry, bone, factor)


def free_chain(rig, bone, chain_length):
    """Names of the bones, from the root, that turn if a bone is pulled that no solver drives.

    chain_length: their number; 0 takes the connected bones up to a branch. There are fewer if Motus drives a parent, or if the root is
    reached. Raises Refused if Motus drives the bone itself.
    """
    taken = chains.driven_elsewhere(rig, "") if not rig.motus.bake.is_baked else {}
    if bone in taken:
        label, entry = taken[bone]
        raise Refused(tr("{bone} is driven by {system} of {other}").format(bone=bone, system=tr(label), other=entry))
    last = rig.data.bones[bone]
    found = [bone]
    for child, parent in zip([last, *last.parent_recursive], last.parent_recursive):
        is_end = len(found) >= chain_length if chain_length else not child.use_connect or len(parent.children) > 1
        if is_end or parent.name in taken:
            break
        found.append(parent.name)
    return tuple(reversed(found))


def point_on(rig, depsgraph, bone, factor):
    """World position of a point on an evaluated bone. factor: 0 at the bone's head, 1 at its tail."""
    evaluated = rig.evaluated_get(depsgraph)
    posed = evaluated.pose.bones[bone]
    return evaluated.matrix_world @ posed.head.lerp(posed.tail, factor)


class _PoseGrab:
    """Pulls a point by turning the bones of a chain that no solver drives, by their own rotation channels."""

    def __init__(self, context, rig, bones, factor, entry=None):
        for name in bones:
            controls.check_undriven(rig.pose.bones[name], ("rotation",), name)
        depsgraph = context.view_layer.depsgraph
        evaluated = rig.evaluated_get(depsgraph)
        self.point = point_on(rig, depsgraph, bones[-1], factor)
        self.moved = [Named(rig, name) for name in bones]
        self.paths = [rotation_path(one.thing) for one in self.moved]
        self._before = [tuple(getattr(one.thing, path)) for one, path in zip(self.moved, self.paths)]
        self._limits = _limits(rig, evaluated, entry, bones, depsgraph)
        arrays = rigs.read(evaluated)
        rows = [arrays.names.index(name) for name in bones]
        # The chain ends at the point that is held, so its last bone is shortened.
        lengths = arrays.lengths.copy()
        lengths[rows[-1]] *= max(factor, SHORTEST)
        self._plan = native.module.IkPlan(rigs.parents(rig, list(arrays.names)), [rows], [rows[-1]], [])
        self._bones = self._plan.bones(self._plan.rest(arrays.rest, lengths, arrays.inheritance), arrays.basis)
        # The array that was read is valid only until the next rig is read.
        self._posed = reading.Posed(arrays.poses.copy(), arrays.world)
        self._settings = _settings(self._plan, entry, self._limits is not None)
        self._own = [evaluated.pose.bones[name].matrix_basis.to_quaternion() for name in bones]

    def pull(self, place):
        """Turn the bones so that the held point comes as near as possible to a place in the world."""
        if place == self.point:
            self.restore()
            return
        rotations, scales = np.empty((len(self.moved), 4)), np.empty((len(self.moved), 3))
        self._plan.solve(
            self._bones,
            *self._posed,
            self._settings,
            _columns(Matrix.Translation(place)),
            np.full((1, 3), np.nan),
            limits=self._limits,
            rotations=rotations,
            scales=scales,
        )
        for one, path, before, own, turn in zip(self.moved, self.paths, self._before, self._own, rotations):
            thing = one.thing
            setattr(thing, path, rotation_values(thing, own @ Quaternion(turn.tolist()), before))

    def restore(self):
        """Restore the rotation channels that the bones had when the point was taken hold of."""
        for one, path, before in zip(self.moved, self.paths, self._before):
            setattr(one.thing, path, before)


class _ControlGrab:
    """Pulls a point on a bone that is a target or a pole of a chain, by moving the bone as a whole."""

    def __init__(self, context, rig, bone, factor):
        self._context = context
        self._control = controls.Control(rig, bone)
        controls.check_movable(self._control, ("location",))
        self.moved, self.paths = [self._control], ["location"]
        self._before = tuple(self._control.thing.location)
        self._matrix = controls.world_matrix(self._control, self._depsgraph)
        self.point = point_on(rig, self._depsgraph, bone, factor)

    @property
    def _depsgraph(self):
        return self._context.view_layer.depsgraph

    def pull(self, place):
        """Move the bone so that the held point comes to a place in the world."""
        if place == self.point:
            self.restore()
            return
        matrix = Matrix.Translation(place - self.point) @ self._matrix
        self._control.thing.location = controls.basis_for(self._control, self._depsgraph, matrix).translation

    def restore(self):
        """Restore the location that the bone had when the point was taken hold of."""
        self._control.thing.location = self._before


class _TargetGrab:
    """Pulls a point on a bone that a solver drives, by moving the target of the bone's chain."""

    def __init__(self, context, rig, entry, bone, factor):
        self._context = context
        evaluated = rig.evaluated_get(self._depsgraph)
        control = controls.blend_target(entry, evaluated.motus.ik.entries[entry.name].target_blend)
        if control is None:
            raise Refused(tr("{bone} is between two targets: drag it where Blend stands on one of them").format(bone=entry.name))
        controls.check_movable(control, ("location",))
        self._control = control
        self.moved, self.paths = [control], ["location"]
        self._before = tuple(control.thing.location)
        self.point = point_on(rig, self._depsgraph, bone, factor)
        self._solver, self._chain = _solver(rig, entry, self._depsgraph)
        self._place = self._chain.bones.index(bone)
        self._along = Vector((0.0, rig.data.bones[bone].length * factor, 0.0))
        # Length of the chain at rest, by which steps and distances of the search are measured.
        self._length = sum(rig.data.bones[name].length for name in self._chain.bones) * rig.matrix_world.median_scale
        self._start = self._solver.targets[self._chain.index, 12:15].copy()
        # Blender evaluates in single precision, so its result is slightly different from the result computed here.
        self._bias = np.array(self.point) - self._reached(self._start)
        self._tip = self._solver.solve()[self._chain.index][TIP]

    @property
    def _depsgraph(self):
        return self._context.view_layer.depsgraph

    def pull(self, place):
        """Move the target so that the held point comes as near as possible to a place in the world."""
        if place == self.point:
            self.restore()
            return
        goal = self._seek(np.array(place) - self._bias)
        matrix = controls.world_matrix(self._control, self._depsgraph)
        matrix.translation = Vector(goal.tolist())
        location = controls.basis_for(self._control, self._depsgraph, matrix).translation
        if not self._control.bone:
            location = location - self._control.object.delta_location
        self._control.thing.location = location

    def restore(self):
        """Restore the location that the target had when the point was taken hold of."""
        self._control.thing.location = self._before

    def _reached(self, target):
        self._solver.targets[self._chain.index, 12:15] = target
        self._solver.solve()
        return np.array(self._solver.poses(self._chain)[self._place] @ self._along)

    def _seek(self, wanted):
        """World position of the target for which the held point is nearest to a wanted place.

        The search starts from the target, moved as far as the point is dragged. If the point does not come to the place, for example
        because the target is far out of reach, a second search starts from the chain's tip, moved as far.
        """
        moved = wanted + self._bias - np.array(self.point)
        error, target = self._seek_from(self._start + moved, wanted)
        if error > NEAR * self._length:
            error, target = min((error, target), self._seek_from(self._tip + moved, wanted), key=lambda found: found[0])
        return target

    def _seek_from(self, target, wanted):
        """(distance left, target) of a search by damped least squares that starts at a target; both targets are world positions."""
        error = self._reached(target) - wanted
        damping = 1e-3
        for _ in range(ROUNDS):
            if np.linalg.norm(error) <= NEAR * self._length:
                break
            slopes = np.column_stack(
                [(self._reached(target + PROBE * self._length * axis) - wanted - error) / (PROBE * self._length) for axis in np.eye(3)]
            )
            step = -np.linalg.solve(slopes.T @ slopes + damping * np.eye(3), slopes.T @ error)
            step *= min(1.0, LONGEST_STEP * self._length / max(np.linalg.norm(step), 1e-30))
            tried = self._reached(target + step) - wanted
            if np.linalg.norm(tried) < np.linalg.norm(error):
                target, error, damping = target + step, tried, damping / 10.0
            else:
                damping *= 10.0
        return np.linalg.norm(error), target


def _solver(rig, entry, depsgraph):
    found = forward.solver_of(rig, entry.name, depsgraph)
    if found is None or not found[0].settings[found[1].index, found[0].columns["is_on"]]:
        raise Refused(tr("{bone} of {object} is not being solved: the panel says why").format(bone=entry.name, object=rig.name))
    return found


def _settings(plan, entry, has_limits):
    values = {
        "position_weight": 1.0,
        "bend": 1.0,
        "tolerance": 1e-6,
        "iterations": 100.0,
        "is_on": 1.0,
        "use_limits": float(has_limits),
        "hinge_angle": entry.hinge_angle if entry else 0.0,
    }
    return np.array([[values.get(name, 0.0) for name in plan.SETTINGS]])


def _limits(rig, evaluated, entry, bones, depsgraph):
    """Joint limits of bones as IkPlan.solve() reads them, (bones, 6) in radians; None if the bones' entry keeps no limits."""
    if entry is None or not entry.use_limits:
        return None
    for group in groups.groups(rig):
        rows = forward.chain_rows(group).get(entry.name)
        if rows:
            limits = reading.gather(evaluated, group.data[groups.PLAN], depsgraph).limits
            free = np.array([[-np.inf] * 3 + [np.inf] * 3])  # for an effector that is not one of the chain's bones
            row_of = dict(zip(rows.bones, rows.rows))  # of the longest chain, if the length is keyed
            known = [limits[row : row + 1] if row < len(limits) else free for row in map(row_of.get, bones)]
            return np.ascontiguousarray(np.concatenate(known))
    return None


def _columns(matrix):
    return rigs.columns(matrix).reshape(1, 16)
