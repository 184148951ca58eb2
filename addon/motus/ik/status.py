"""What an entry's solver said of it, in words."""

import math
from typing import NamedTuple

import bpy

from ..core import dependencies, native, rigs, wiring
from ..core.translations import tr
from . import chains, reading
from .groups import OUTPUTS
from .setup import system

LEAST_FAULT = 1e-5
"""Share of a chain's reach: less is not worth a warning."""


class Report(NamedTuple):
    """Outputs of one entry; m and rad."""

    residual: float
    angle: float
    reason: float
    distance: float
    reach: float


def report(owner, name, depsgraph):
    """The Report of the entry of this name; None where it was not solved."""
    values = wiring.outputs_of(system(), owner, name, OUTPUTS, depsgraph)
    return None if values is None else Report(*values)


def sentence(context, owner, entry):
    """(icon, sentence in the user's language) of why an entry does not reach, or of a pole or limits that do not count;
    the sentence is "" where all is well."""
    found = report(owner, entry.name, context.view_layer.depsgraph)
    if found is None:
        return 'ERROR', _unwired(owner, entry)
    if found.reason in reading.UNWANTED:
        return 'ERROR', _unwanted(entry, found.reason)
    is_animated = entry.position_weight * owner.motus.ik.influence == 0.0
    unreached = "" if is_animated else _unreached(context, entry, found)
    return 'INFO', _without_pole(context, entry) or unreached or _unlimited(owner, entry)


def _unwired(owner, entry):
    chain = chains.find(owner, entry)
    if chain is None:
        return tr("{object} has no bone {bone}").format(object=owner.name, bone=entry.name)
    others = chains.driven_elsewhere(owner, entry.name)
    shared = [name for name in chain.driven if name in others]
    if shared:
        label, other = others[shared[0]]
        return tr("{bone} is driven by {system} of {other} already: shorten the chain").format(
            bone=shared[0], system=tr(label), other=other)
    if dependencies.levels(owner).get(("ik", entry.name), 0) is None:
        return tr("The target moves with the chain itself: choose another one")
    return ""


def _unwanted(entry, reason):
    if reason == reading.NO_TARGET:
        return tr("{bone} has no target: choose one").format(bone=entry.name)
    if reason == reading.TARGET_DELETED:
        return tr("{target} is in no collection any more: choose another target").format(target=entry.target.name)
    if reason == reading.NO_TARGET_BONE:
        return tr("{object} has no bone {bone}").format(object=entry.target.name, bone=entry.target_bone)
    return tr("A number of this chain is not finite")


def _without_pole(context, entry):
    """Of a pole that is gone."""
    pole, bone = entry.pole, entry.pole_bone
    if pole is None:
        return ""
    if rigs.is_deleted(pole, context.view_layer):
        return tr("{pole} is in no collection any more: the chain bends as without a pole").format(pole=pole.name)
    if bone and not (pole.pose and bone in pole.pose.bones):
        return tr("{object} has no bone {bone}: the chain bends as without a pole").format(object=pole.name, bone=bone)
    return ""


def _unreached(context, entry, found):
    reasons = native.module.Reason
    if found.reason == int(reasons.TOO_FAR):
        if found.distance > found.reach:
            return tr("The target is {length} too far away").format(length=length(context, found.residual))
        if is_turned_away(entry, found):
            return tr("With the target's orientation {length} are left").format(length=length(context, found.residual))
        return tr("Softness keeps the chain {length} from the target").format(length=length(context, found.residual))
    if found.reason == int(reasons.TOO_NEAR):
        return tr("The target is {length} too near").format(length=length(context, found.residual))
    if found.reason == int(reasons.LIMIT):
        return tr("A joint limit is in the way: {length} are left").format(length=length(context, found.residual))
    if found.reason == int(reasons.ITERATIONS):
        return tr("The iterations were used up: {length} are left").format(length=length(context, found.residual))
    return ""


def _unlimited(owner, entry):
    """Of a bone after the chain: it takes the target's orientation as it is."""
    turns = entry.rotation_weight * owner.motus.ik.influence > 0.0
    if entry.use_limits and turns and not entry.use_tail and _has_limits(owner.pose.bones[entry.name]):
        return tr("{bone} has joint limits of its own: they count only with Use Tail").format(bone=entry.name)
    return ""


def _has_limits(bone):
    return any(getattr(bone, f"{kind}_{letter}") for kind in ("lock_ik", "use_ik_limit") for letter in "xyz")


def fault(found, entry):
    """(what is left, of check_results.WHY) of a Report; (0, 'NONE') where the target is reached, or softness alone keeps it
    off."""
    codes = native.module.Reason
    names = {int(codes.TOO_FAR): 'FAR', int(codes.TOO_NEAR): 'NEAR', int(codes.LIMIT): 'LIMIT',
             int(codes.ITERATIONS): 'ITERATIONS'}
    reason = names.get(int(found.reason), 'NONE')
    if reason == 'FAR' and found.distance <= found.reach:
        reason = 'TURN' if is_turned_away(entry, found) else 'NONE'
    if reason == 'NONE' or found.residual <= LEAST_FAULT * found.reach:
        return 0.0, 'NONE'
    return found.residual, reason


def is_turned_away(entry, found):
    """Whether a target within the chain's reach is too far for the bones before the last one, which takes its orientation."""
    return found.distance <= found.reach and entry.softness == 0.0 and entry.rotation_weight > 0.0


def warnings(context, owner, entry):
    """Sentences for the report of an operator."""
    if not owner.evaluated_get(context.view_layer.depsgraph).is_evaluated:
        return []
    _, text = sentence(context, owner, entry)
    return [text] if text else []


def length(context, value):
    """A length in the scene's units."""
    units = context.scene.unit_settings
    name = 'METRIC' if units.system == 'NONE' else units.system
    return bpy.utils.units.to_string(name, 'LENGTH', value * units.scale_length, precision=4)


def angle(value):
    """An angle in degrees."""
    return f"{math.degrees(value):.3g}°"
