"""Match controls (targets and poles) of chains to the animated pose, or the animated pose to the solution, over a range of frames.

match_fk() and match_ik() are generators: the first value is the number of steps, each further value is the number of steps done. They
go through the frames at least twice, to read poses and to measure the error of the result. A generator that is closed before its end
restores everything.
"""

from typing import Any, NamedTuple

from mathutils import Matrix, Vector

from ...core import rigs, wiring
from ...core.blender.frames import Kept, as_text, go_to
from ...core.file.pointers import pointed
from ...core.lazy import numpy as np
from ...core.measures import scene_time
from ...core.refusals import Refused, check_no_tweak_mode, check_posed
from ...core.translations import tr
from .. import forward, groups, reading, targets
from ..goals import controls
from ..keying import Channels, KeyWriter
from . import weights
from .pose_compare import Poses, without_sinks


class _Chain(NamedTuple):
    """Chain on which a matching job works.

    name: of its entry. found: the entry and its bones. group: the Group that solves it. rows: the chain's rows in that group's results.
    """

    name: str
    found: groups.Found
    group: Any
    rows: forward.ChainRows

    @property
    def bones(self):
        """Names of the bones whose pose must not change by the matching."""
        return (*self.found.chain.driven, *self.found.guards)


def _chosen(rig, bone):
    """List of the _Chain of the entry named `bone`, or of all solved entries if it is empty. Raises Refused if there is none."""
    targets.check_editable(rig)
    check_no_tweak_mode(rig)
    name = rig.motus.ik.entries[targets.entry_for(rig, bone)].name if bone else ""
    known = {found.entry.name: found for found in groups.survey(rig)}
    result = [
        _Chain(one, known[one], group, rows)
        for group in groups.groups(rig)
        for one, rows in forward.chain_rows(group).items()
        if name in ("", one)
    ]
    if not result:
        raise Refused(tr("No chain of {object} is being solved").format(object=rig.name))
    return result


def _entries(rig, chosen):
    """Entries of chains. They are looked up at each call, since a script may change the list of entries between two frames."""
    return [rig.motus.ik.entries[chain.name] for chain in chosen]


def match_fk(context, rig, bone, frames, switch, outcome):
    """Key the targets and poles of chains so that the solution is the animated pose; a generator of the number of steps done.

    bone: name of an entry, "" for all. frames: rising frames of the scene. switch: set the position weights to 1 over these frames.
    outcome: dictionary that gets "error" (a pose_compare.Error) and "chains" (their number).
    """
    chosen = _chosen(rig, bone)
    for chain in chosen:
        if pointed(chain.found.entry, "target") is None:
            raise Refused(tr("{bone} has no target: choose one").format(bone=chain.name))
    if switch:
        weights.check(rig, _entries(rig, chosen))
    kept, writer = Kept(context.scene, controls.animated_with(rig, _entries(rig, chosen))), KeyWriter()
    scene, done = context.scene, 0
    times = [scene_time.keys_time(scene, frame) for frame in frames]
    try:
        go_to(scene, frames[0])
        wanted, poses = _Wanted(context, rig, chosen), Poses(rig, chosen)
        passes = wanted.passes()
        yield len(frames) * (len(passes) + 1)  # one more pass, to measure the error
        with without_sinks(rig, chosen):
            for frame in frames:
                go_to(scene, frame)
                wanted.record(context.view_layer.depsgraph, frame)
                wanted.place(context.view_layer.depsgraph, passes[0], len(poses.kept))
                poses.record(context.view_layer.depsgraph)
                done += 1
                yield done
            wanted.write(writer, passes[0], times)
            for controls_now in passes[1:]:
                for index, frame in enumerate(frames):
                    go_to(scene, frame)
                    wanted.place(context.view_layer.depsgraph, controls_now, index)
                    done += 1
                    yield done
                wanted.write(writer, controls_now, times)
        if switch:
            weights.switch(scene, rig, _entries(rig, chosen), times, writer, {"position_weight": 1.0})
        for index, frame in enumerate(frames):
            go_to(scene, frame)
            poses.compare(context.view_layer.depsgraph, index, with_all_weight=True)
            done += 1
            yield done
        outcome.update(error=poses.error, chains=len(chosen))
    except BaseException:
        writer.take_back()
        raise
    finally:
        kept.restore(writer.written)


def match_ik(context, rig, bone, frames, switch, outcome):
    """Key the bones of chains so that their animated pose is the solution; a generator of the number of steps done.

    bone: name of an entry, "" for all. frames: rising frames of the scene. switch: set both weights to 0 over these frames.
    outcome: dictionary that gets "error" (a pose_compare.Error) and "chains" (their number).
    """
    chosen = _chosen(rig, bone)
    tracks = _tracks(rig, chosen)
    if switch:
        weights.check(rig, _entries(rig, chosen))
    kept, writer = Kept(context.scene, controls.animated_with(rig, _entries(rig, chosen))), KeyWriter()
    scene, done = context.scene, 0
    times = [scene_time.keys_time(scene, frame) for frame in frames]
    try:
        poses = Poses(rig, chosen)
        yield 2 * len(frames)
        for frame in frames:
            go_to(scene, frame)
            evaluated = rig.evaluated_get(context.view_layer.depsgraph)
            _check_unlaid(evaluated, chosen)
            for track in tracks:
                posed = evaluated.pose.bones[track.thing.name]
                track.add(evaluated.convert_space(pose_bone=posed, matrix=posed.matrix, from_space='POSE', to_space='LOCAL'))
            poses.record(context.view_layer.depsgraph)
            done += 1
            yield done
        for track in tracks:
            for name, rows in track.values.items():
                writer.write(track.thing, name, times, rows, group=track.thing.name)
        if switch:
            weights.switch(scene, rig, _entries(rig, chosen), times, writer, {"position_weight": 0.0, "rotation_weight": 0.0})
        with without_sinks(rig, () if switch else chosen):
            for index, frame in enumerate(frames):
                go_to(scene, frame)
                poses.compare(context.view_layer.depsgraph, index)
                done += 1
                yield done
        outcome.update(error=poses.error, chains=len(chosen))
    except BaseException:
        writer.take_back()
        raise
    finally:
        kept.restore(writer.written)


def _check_unlaid(evaluated, chosen):
    """Refuse chains with bones that layers pose above their keys: the chains do not start from these keys, so new keys would not match."""
    laid = rigs.laid_bones(evaluated)
    for name in [name for chain in chosen for name in chain.bones if name in laid]:
        raise Refused(tr("Layers pose {bone} above its keys: flatten or mute them first").format(bone=name))


def _tracks(rig, chosen):
    tracks = []
    for chain in chosen:
        channels = ("rotation", "scale") if chain.found.stretches else ("rotation",)
        for name in chain.bones:
            bone = rig.pose.bones[name]
            controls.check_undriven(bone, channels, name)
            tracks.append(Channels(bone, channels))
    return tracks


class _Wanted:
    """Transforms that the controls (targets and poles) of chains must have, one for each frame."""

    def __init__(self, context, rig, chosen):
        self._rig, self._chosen, self._view_layer = rig, chosen, context.view_layer
        self._texts = list(dict.fromkeys(chain.group.data[groups.PLAN] for chain in chosen))
        evaluated = rig.evaluated_get(context.view_layer.depsgraph).motus.ik.entries
        self._places = {}
        self._targets, self._poles = {}, {}
        for chain, entry in zip(chosen, _entries(rig, chosen)):
            found = controls.blend_target(entry, evaluated[chain.name].target_blend)
            found = found or self._under_way(chain)
            controls.check_present(found)
            self._add(self._targets, chain, found, ("location", "rotation"))
            pole = controls.pole(entry)
            if pole:
                self._add(self._poles, chain, pole, ("location",))

    def _add(self, kind, chain, control, channels):
        if control in self._places:
            raise Refused(tr("{target} is the control of several chains: give each one of its own").format(target=control.label))
        controls.check_movable(control, channels)
        if control.bone:
            check_posed(control.object, self._view_layer)
        kind[chain.name] = control
        self._places[control] = [], Channels(control.thing, channels)

    @staticmethod
    def _under_way(chain):
        raise Refused(
            tr("{bone} passes from one target to another in this range: match the frames before or after that").format(bone=chain.name)
        )

    def passes(self):
        """Lists of controls in the order in which they are placed: a control comes after the controls on which it depends.

        The controls of one list do not depend on each other.
        """
        depth = {}
        by_place = {(control.object, control.bone): control for control in self._places}
        above = wiring.hanging(self._rig, by_place)

        def depth_of(control):
            if control not in depth:
                depth[control] = 0
                others = [by_place[place] for place in above[control.object, control.bone]]
                depth[control] = 1 + max(map(depth_of, others), default=-1)
            return depth[control]

        for control in self._places:
            depth_of(control)
        return [[control for control in depth if depth[control] == level] for level in range(max(depth.values()) + 1)]

    def record(self, depsgraph, frame):
        """Note the world matrices that the controls must have at a frame, which is the evaluated one."""
        evaluated = self._rig.evaluated_get(depsgraph)
        entries = evaluated.motus.ik.entries
        for text in self._texts:
            found = reading.gather(evaluated, text, depsgraph)
            goals, poles = found.wired.plan.match(found.bones, *found.posed, found.settings)
            for chain in self._chosen:
                if chain.group.data[groups.PLAN] == text:
                    row = chain.rows.index
                    self._record_one(chain, entries[chain.name], goals[row], poles[row], frame)

    def _record_one(self, chain, entry, goal, pole, frame):
        target = self._targets[chain.name]
        if controls.blend_target(self._rig.motus.ik.entries[chain.name], entry.target_blend) != target:
            self._under_way(chain)
        if not np.isfinite(pole).all():
            raise Refused(tr("{bone} has no pose at frame {frame} that could be matched").format(bone=chain.name, frame=as_text(frame)))
        matrix = Matrix(goal.reshape(4, 4).T.tolist())
        self._places[target][0].append((matrix, entry.rotation_offset.to_matrix()))
        if chain.name in self._poles:
            self._places[self._poles[chain.name]][0].append((Matrix.Translation(Vector(pole.tolist())), None))

    def place(self, depsgraph, controls_now, index):
        """Note the values that the channels of these controls must have at the evaluated frame, whose number in the range is `index`."""
        for control in controls_now:
            matrices, channels = self._places[control]
            channels.add(controls.basis_for(control, depsgraph, *matrices[index]))

    def write(self, writer, controls_now, frames):
        """Write keys for these controls. frames: in the keys' time, in which F-curves have their frames."""
        for control in controls_now:
            channels = self._places[control][1]
            for name, rows in channels.values.items():
                writer.write(channels.thing, name, frames, rows, group=control.bone or "Object Transforms")
