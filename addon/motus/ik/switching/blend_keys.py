"""Key the setting Blend from one target of a chain to the next over time: functions that the operator motus.ik_switch_target calls.

Target number 0 is the chain's target; numbers from 1 on are its further targets. Blend at a number is at that target.
"""

from ...core.blender import actions
from ...core.file.pointers import pointed
from ...core.refusals import Refused
from ...core.settings import lists
from ...core.translations import tr
from .. import chains, setup
from ..goals import blend_targets, controls
from ..keying import SAME_FRAME, KeyWriter

LARGEST_STEP = 0.5
"""Largest distance of a value of Blend from the number of a target at which the value belongs to that target."""


def curve_of(rig, entry):
    """F-curve of an entry's setting Blend; None if Blend has no keys."""
    for prefix in chains.prefixes(rig, rig.motus.ik.entries.find(entry.name)):
        curve = actions.find(rig, prefix + "target_blend")
        if curve:
            return curve
    return None


def present(rig, entry, frame):
    """Number of the target at which a chain is at a frame. Raises Refused if the chain is between two targets."""
    curve = curve_of(rig, entry)
    blend = curve.evaluate(frame) if curve else entry.target_blend
    blend = max(0.0, min(blend, len(entry.extra_targets)))
    if abs(blend - round(blend)) > blend_targets.STANDS:
        sentence = tr("{bone} passes from one target to another at frame {frame}: begin before or after that")
        raise Refused(sentence.format(bone=entry.name, frame=f"{frame:g}"))
    return round(blend)


def check_other(entry, number, goal):
    """Refuse to switch to a target, (object, bone name), at which the chain is already. number: of the chain's present target."""
    if controls.blend_target(entry, number) == controls.Control(*goal):
        raise Refused(tr("{bone} is at {target} already").format(bone=entry.name, target=controls.Control(*goal).label))


def place_next(entry, number, goal):
    """Let `goal`, (object, bone name), be the further target that follows target `number`; insert it if it is not there already.

    Returns whether a target was inserted before existing ones, whose numbers rise by 1.
    """
    extras = entry.extra_targets
    if number < len(extras) and (pointed(extras[number], "object"), extras[number].bone) == goal:
        return False
    lists.check_own(extras, [number])
    extra = lists.add_numbered(extras, "Target")
    extra.object, extra.bone = goal
    lists.move(extras, len(extras) - 1, number)
    entry.active_extra_target = number
    return len(extras) - 1 > number


def switch(rig, entry, goal, start, end, interpolation):
    """Key Blend so that a chain passes from its present target to `goal` between two frames. Returns the number of the present target.

    goal: (object, bone name). start, end: frames of F-curves. Later switches in the F-curve are changed to start from `goal`.
    """
    number = present(rig, entry, start)
    check_other(entry, number, goal)
    actions.make_local(rig)
    curve, last = curve_of(rig, entry), float(len(entry.extra_targets))
    with setup.at_once(rig):
        is_between = place_next(entry, number, goal)
        if curve:
            _change(curve, lambda value: min(value, last))  # higher values meant the last target, too
            _renumber(curve, number, start, end, is_between)
        writer = KeyWriter()
        path = curve.data_path if curve else ""
        writer.write(entry, "target_blend", [start, end], [float(number), number + 1.0], interpolation, instead_of=path)
    return number


def _renumber(curve, number, start, end, is_between):
    """Change the keys of earlier and later switches to the numbers that targets have after a new switch.

    number: of the target that the new switch leaves. is_between: whether its target was inserted before existing ones.
    """
    for key in curve.keyframe_points:
        value, is_later = key.co.y, key.co.x > end + SAME_FRAME
        # A later switch that left the present target now leaves the new target.
        leaves_here = is_later and number - LARGEST_STEP < value <= number + LARGEST_STEP
        if leaves_here or (is_between and value > number + LARGEST_STEP):
            for point in (key.co, key.handle_left, key.handle_right):
                point.y += 1.0
    curve.update()


def take_out(rig, entry, number):
    """Change Blend and its keys for a further target that is about to be removed. number: of this target."""
    paths = [prefix + "target_blend" for prefix in chains.prefixes(rig, rig.motus.ik.entries.find(entry.name))]
    for player in actions.players(rig):
        if any(curve.data_path in paths and _passes(curve, number) for curve in actions.curves_of(player)):
            actions.make_own(player)  # a different rig that shares the action has targets of its own
            for curve in actions.curves_of(player):
                if curve.data_path in paths:
                    _change(curve, lambda value: blend_targets.without(value, number))
    if entry.target_blend > number - 1.0:
        entry.target_blend = blend_targets.without(entry.target_blend, number)


def _passes(curve, number):
    """Whether an F-curve of Blend passes towards the target of a number, or a later one."""
    return any(key.co.y > number - 1.0 for key in curve.keyframe_points)


def _change(curve, change):
    """Replace the values of all keys and handles of an F-curve by change(value)."""
    for key in curve.keyframe_points:
        for point in (key.co, key.handle_left, key.handle_right):
            point.y = change(point.y)
    curve.update()
