"""A point of a chain that is pulled to a place: by its target where a solver has it, else by turning its bones.

A bone that is a target or a pole is moved whole.
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

TIP = slice(-3, None)  # of a row of IkPlan.REPORT
SHORTEST = 1e-6  # of the bone: a point on its head is taken so far along it
ROUNDS = 12
NEAR = 1e-6  # of the chain's length
PROBE = 1e-4  # of the chain's length
LONGEST_STEP = 0.5  # of the chain's length


def grab(context, rig, bone, factor, chain_length=0):
    """Take hold of a bone's chain, for pull() to move. factor: place along the bone, 0 to 1. Raises Refused if the chain cannot be dragged."""
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
    """Names of the bones, from the root, that follow a pulled one: so many, or as far up as they are connected."""
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
    """World place at a share of an evaluated bone's length."""
    evaluated = rig.evaluated_get(depsgraph)
    posed = evaluated.pose.bones[bone]
    return evaluated.matrix_world @ posed.head.lerp(posed.tail, factor)


class _PoseGrab:
    """Turns the bones' own channels."""

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
        # The chain ends at the point that is held.
        lengths = arrays.lengths.copy()
        lengths[rows[-1]] *= max(factor, SHORTEST)
        self._plan = native.module.IkPlan(rigs.parents(rig, list(arrays.names)), [rows], [rows[-1]], [])
        self._bones = self._plan.bones(self._plan.rest(arrays.rest, lengths, arrays.inheritance), arrays.basis)
        # The array holds only until the next rig is read.
        self._posed = reading.Posed(arrays.poses.copy(), arrays.world)
        self._settings = _settings(self._plan, entry, self._limits is not None)
        self._own = [evaluated.pose.bones[name].matrix_basis.to_quaternion() for name in bones]

    def pull(self, place):
        """Turn the bones so that the point comes to a place in the world, as far as it can."""
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
        """Put the bones' channels back."""
        for one, path, before in zip(self.moved, self.paths, self._before):
            setattr(one.thing, path, before)


class _ControlGrab:
    """Moves a bone that is a target or a pole."""

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
        """Move the bone as far as its point goes."""
        if place == self.point:
            self.restore()
            return
        matrix = Matrix.Translation(place - self.point) @ self._matrix
        self._control.thing.location = controls.basis_for(self._control, self._depsgraph, matrix).translation

    def restore(self):
        """Put the bone back."""
        self._control.thing.location = self._before


class _TargetGrab:
    """Moves the target of the entry that solves the bone's chain."""

    def __init__(self, context, rig, entry, bone, factor):
        self._context = context
        evaluated = rig.evaluated_get(self._depsgraph)
        control = controls.station(entry, evaluated.motus.ik.entries[entry.name].target_blend)
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
        # Of the rest pose: what makes a step or a residual small.
        self._length = sum(rig.data.bones[name].length for name in self._chain.bones) * rig.matrix_world.median_scale
        self._start = self._solver.targets[self._chain.index, 12:15].copy()
        # What Blender evaluates and what is computed here differ by single precision.
        self._bias = np.array(self.point) - self._reached(self._start)
        self._tip = self._solver.solve()[self._chain.index][TIP]

    @property
    def _depsgraph(self):
        return self._context.view_layer.depsgraph

    def pull(self, place):
        """Move the target so that the point comes to a place in the world, as far as it can."""
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
        """Put the target back."""
        self._control.thing.location = self._before

    def _reached(self, target):
        self._solver.targets[self._chain.index, 12:15] = target
        self._solver.solve()
        return np.array(self._solver.poses(self._chain)[self._place] @ self._along)

    def _seek(self, wanted):
        """The target for which the point is nearest to a place: sought from the drag's displacement of the target.

        Where that does not come there, as of a target far out of reach, also from the same displacement of the tip.
        """
        moved = wanted + self._bias - np.array(self.point)
        error, target = self._seek_from(self._start + moved, wanted)
        if error > NEAR * self._length:
            error, target = min((error, target), self._seek_from(self._tip + moved, wanted), key=lambda found: found[0])
        return target

    def _seek_from(self, target, wanted):
        """(What is left, target), by damped least squares."""
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
    """(bones, 6) limits of the bones, where their entry keeps them; else None."""
    if entry is None or not entry.use_limits:
        return None
    for group in groups.groups(rig):
        rows = forward.chain_rows(group).get(entry.name)
        if rows:
            limits = reading.gather(evaluated, group.data[groups.PLAN], depsgraph).limits
            free = np.array([[-np.inf] * 3 + [np.inf] * 3])  # of an effector that is none of the chain's bones
            row_of = dict(zip(rows.bones, rows.rows))  # of the longest chain, where the length is keyed
            known = [limits[row : row + 1] if row < len(limits) else free for row in map(row_of.get, bones)]
            return np.ascontiguousarray(np.concatenate(known))
    return None


def _columns(matrix):
    return rigs.columns(matrix).reshape(1, 16)
