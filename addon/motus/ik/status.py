"""Sentences for the user about a chain, made from the numbers that its solver has reported."""

import math
from typing import NamedTuple

from ..core import native, wiring
from ..core.file import deleted
from ..core.file.pointers import pointed
from ..core.interface.ui import length
from ..core.translations import tr
from . import chains, reasons
from .goals import blend_targets, places as goal_places
from .groups import OUTPUTS
from .setup import system

LEAST_FAULT = 1e-5
"""Distance from the target, as a share of the chain's reach, below which no warning is given."""


class Report(NamedTuple):
    """Numbers that the solver has reported for one entry; lengths in metres, angles in radians.

    residual: distance left from the chain's end to its target. angle: angle left to the target's orientation. reason: a value of
    native.Reason or of reasons.py. distance: from the chain's root to the target. reach: farthest distance without stretch.
    """

    residual: float
    angle: float
    reason: float
    distance: float
    reach: float


def report(owner, name, depsgraph):
    """Report of the entry of a name; None if the entry was not solved."""
    values = wiring.outputs_of(system(), owner, name, OUTPUTS, depsgraph)
    return None if values is None else Report(*values)


def added(entry):
    """Sentence that an operator reports after it has given a chain a target."""
    if entry.target_bone:
        return tr("IK added: {bone} follows bone {target}").format(bone=entry.name, target=entry.target_bone)
    return tr("IK added: {bone} follows {target}").format(bone=entry.name, target=pointed(entry, "target").name)


def sentence(context, owner, entry):
    """(icon, sentence in the user's language) that says why a chain does not reach its target, or that its pole or limits do not count.

    The sentence is "" if all is well.
    """
    found = report(owner, entry.name, context.view_layer.depsgraph)
    if found is None or _is_second(owner, entry):
        return 'ERROR', _unwired(owner, entry)
    if found.reason in reasons.UNWANTED:
        return 'ERROR', _unwanted(entry, found.reason)
    astray = _astray(context, owner, entry)
    if astray:
        return 'ERROR', astray
    unreached = "" if is_animated(entry) else _unreached(context, entry, found)
    return 'INFO', _without_pole(entry) or unreached or _unlimited(owner, entry)


def is_unwired(owner, entry):
    """Whether an entry cannot be solved, for example because its bone is missing, or is driven by a different entry already."""
    return bool(_unwired(owner, entry))


def is_animated(entry):
    """Whether an entry leaves its chain to the animation: it is muted, or its position weight times the influence is 0."""
    return entry.is_muted or entry.position_weight * entry.id_data.motus.ik.influence == 0.0


def _is_second(owner, entry):
    """Whether an earlier entry is named after the same bone; the solver's report then belongs to that entry."""
    return owner.motus.ik.entries.get(entry.name) != entry


def _unwired(owner, entry):
    if _is_second(owner, entry):
        return tr("{bone} has another chain in this list: choose another bone").format(bone=entry.name)
    chain = chains.find(owner, entry)
    if chain is None:
        return tr("{object} has no bone {bone}").format(object=owner.name, bone=entry.name)
    others = chains.driven_elsewhere(owner, entry.name)
    shared = [name for name in chain.driven if name in others]
    if shared:
        label, other = others[shared[0]]
        return tr("{bone} is driven by {system} of {other} already: shorten the chain").format(
            bone=shared[0], system=tr(label), other=other
        )
    if wiring.levels(owner).get(("ik", entry.name), 0) is None:
        return tr("The target moves with the chain itself: choose another one")
    return ""


def _unwanted(entry, reason):
    if reason == reasons.NO_TARGET:
        return tr("{bone} has no target: choose one").format(bone=entry.name)
    if reason == reasons.TARGET_DELETED:
        return tr("{target} is in no collection any more: choose another target").format(target=pointed(entry, "target").name)
    if reason == reasons.NO_TARGET_BONE:
        return tr("{object} has no bone {bone}").format(object=pointed(entry, "target").name, bone=entry.target_bone)
    return tr("A number of this chain is not finite")


def _astray(context, owner, entry):
    """Sentence about a missing further target, in whose place the chain goes to the target before it; "" if none is missing."""
    depsgraph = context.view_layer.depsgraph
    now = owner.evaluated_get(depsgraph).motus.ik.entries.get(entry.name)
    if now is None or now.is_muted or not 0.0 < now.target_blend < math.inf or not now.extra_targets:
        return ""
    goals = [(pointed(now, "target"), now.target_bone), *((pointed(extra, "object"), extra.bone) for extra in now.extra_targets)]
    places = [goal_places.world_matrix(goal, bone) if goal and not deleted.is_deleted(goal) else None for goal, bone in goals]
    missing = [number for number in blend_targets.needed(now.target_blend, places)[0] if places[number] is None]
    return tr("Further target {number} is missing: the one before it counts instead").format(number=missing[0]) if missing else ""


def _without_pole(entry):
    """Sentence about a pole that was deleted, or lacks the chosen bone; "" if the pole exists, or none was chosen."""
    pole, bone = pointed(entry, "pole"), entry.pole_bone
    if pole is None:
        return ""
    if deleted.is_deleted(pole):
        return tr("{pole} is in no collection any more: the chain bends as without a pole").format(pole=pole.name)
    if bone and pole.pose and bone not in pole.pose.bones:
        return tr("{object} has no bone {bone}: the chain bends as without a pole").format(object=pole.name, bone=bone)
    return ""


def _unreached(context, entry, found):
    sentences = {
        'NONE': "",
        'FAR': tr("The target is {length} too far away"),
        'TURN': tr("With the target's orientation {length} are left"),
        'SOFT': tr("Softness keeps the chain {length} from the target"),
        'NEAR': tr("The target is {length} too near"),
        'LIMIT': tr("A joint limit is in the way: {length} are left"),
        'ITERATIONS': tr("The iterations were used up: {length} are left"),
    }
    return sentences[_why(found, entry)].format(length=length(context, found.residual))


def _unlimited(owner, entry):
    """Sentence about joint limits that have no effect; "" if there are none.

    If Use Tail is off, the entry's bone is not part of the chain: it takes the target's orientation whatever its limits are.
    """
    turns = entry.rotation_weight * owner.motus.ik.influence > 0.0
    if entry.use_limits and turns and not entry.use_tail and _has_limits(owner.pose.bones[entry.name]):
        return tr("{bone} has joint limits of its own: they count only with Use Tail").format(bone=entry.name)
    return ""


def _has_limits(bone):
    return any(getattr(bone, f"{kind}_{letter}") for kind in ("lock_ik", "use_ik_limit") for letter in "xyz")


def fault(found, entry):
    """(distance left to the target, reason as an item of check_results.WHY) of an entry. found: its Report, or None.

    The reason is 'NONE' if the target is reached, or if nothing but softness keeps the chain from it.
    """
    if is_animated(entry):
        return 0.0, 'ANIMATED'
    if found is None or found.reason in reasons.UNWANTED:
        return 0.0, 'UNSOLVED'
    why = _why(found, entry)
    if why in ('NONE', 'SOFT') or found.residual <= LEAST_FAULT * found.reach:
        return 0.0, 'NONE'
    return found.residual, why


def _why(found, entry):
    """Item of check_results.WHY that says what keeps a chain from its target, or 'SOFT' if softness alone does. found: its Report."""
    codes = native.module.Reason
    if found.reason == int(codes.TOO_FAR):
        return _why_too_far(found, entry)
    names = {int(codes.TOO_NEAR): 'NEAR', int(codes.LIMIT): 'LIMIT', int(codes.ITERATIONS): 'ITERATIONS'}
    return names.get(int(found.reason), 'NONE')


def _why_too_far(found, entry):
    turn = _turn_of_last(entry)
    if found.distance > found.reach:
        # The reason is the one that causes the greater part of the distance that is left.
        by_distance = (1.0 - entry.stretch) * _lag(entry, found.distance, found.reach)
        return 'TURN' if turn > 0.0 and found.residual > 2.0 * by_distance else 'FAR'
    if turn > 0.0 and found.residual > _most_by_softness(found, entry, turn):
        return 'TURN'
    return 'SOFT' if entry.softness > 0.0 else 'FAR'


def _turn_of_last(entry):
    """Weight, 0 to 1, by which the chain's last bone takes the target's orientation even if the chain then misses the target.

    It is 0 if the entry keeps joint limits, since the chain's place then comes before the orientation, or if Use Tail is off.
    """
    is_turned = entry.use_tail and not entry.use_limits
    return entry.rotation_weight * entry.id_data.motus.ik.influence if is_turned else 0.0


def _most_by_softness(found, entry, turn):
    """Largest distance that softness alone can leave between a chain and a target within its reach.

    If the last bone is not turned as the target is, the whole chain stays behind the target by its softness. If it is turned, the
    bones before it stay behind as a chain of their own; a single bone has no softness. The distance of that chain's target is not
    reported, so its reach is taken instead, which is the largest possible. turn: weight of the last bone's turn, 0 to 1.
    """
    if entry.softness == 0.0:
        return 0.0
    whole = _lag(entry, found.distance, found.reach)
    others = found.reach * _share_before_last(entry)
    lag = (1.0 - turn) * whole + turn * _lag(entry, others, others)
    return (1.0 - entry.stretch) * lag + LEAST_FAULT * found.reach


def _lag(entry, distance, reach):
    """Distance by which the tip of a chain that does not stretch stays behind its target, by the chain's softness and reach."""
    return distance - native.module.soft_reach(distance, reach, entry.softness * reach)


def _share_before_last(entry):
    """Share of a chain's rest length that lies before its last bone; 0 if only a single bone lies there, since that has no softness."""
    rig = entry.id_data
    chain = chains.find(rig, entry)  # None until a rig that has lost bones is wired again
    lengths = [rig.data.bones[name].length for name in chain.bones] if chain else []
    return sum(lengths[:-1]) / sum(lengths) if len(lengths) > 2 else 0.0


def warnings(context, owner, entry):
    """Sentences that an operator reports as warnings about an entry; empty if there are none, or if the rig is not evaluated."""
    if not owner.evaluated_get(context.view_layer.depsgraph).is_evaluated:
        return []
    _, text = sentence(context, owner, entry)
    return [text] if text else []


def angle(value):
    """Text of an angle in degrees. value: the angle in radians."""
    return f"{math.degrees(value):.3g}°"
