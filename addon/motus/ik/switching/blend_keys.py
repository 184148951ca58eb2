"""Blend keyed from one target to the next over time: plain functions behind the switching operator."""

from ...core.blender import actions
from ...core.file.pointers import pointed
from ...core.refusals import Refused
from ...core.translations import tr
from .. import chains, setup
from ..goals import controls, stations
from ..keying import SAME_FRAME, KeyWriter

LARGEST_STEP = 0.5
"""Blend values within this of a number of a target belong to it."""


def curve_of(rig, entry):
    """F-curve of an entry's Blend, or None."""
    for prefix in chains.prefixes(rig, rig.motus.ik.entries.find(entry.name)):
        curve = actions.find(rig, prefix + "target_blend")
        if curve:
            return curve
    return None


def present(rig, entry, frame):
    """Number of the target that the chain is at on a frame. Refuses where it is between two."""
    curve = curve_of(rig, entry)
    blend = curve.evaluate(frame) if curve else entry.target_blend
    blend = max(0.0, min(blend, len(entry.extra_targets)))
    if abs(blend - round(blend)) > stations.STANDS:
        sentence = tr("{bone} passes from one target to another at frame {frame}: begin before or after that")
        raise Refused(sentence.format(bone=entry.name, frame=f"{frame:g}"))
    return round(blend)


def check_other(entry, number, goal):
    """Refuse a target that the chain is at already."""
    if controls.station(entry, number) == controls.Control(*goal):
        raise Refused(tr("{bone} is at {target} already").format(bone=entry.name, target=controls.Control(*goal).label))


def place_next(entry, number, goal):
    """Make `goal`, (object, bone name), the further target after target `number` of a chain's Blend; add one if it is not there.

    Returns whether a target was inserted before existing ones, whose numbers rise by 1.
    """
    extras = entry.extra_targets
    if number < len(extras) and (pointed(extras[number], "object"), extras[number].bone) == goal:
        return False
    extra = extras.add()
    extra.object, extra.bone = goal
    extras.move(len(extras) - 1, number)
    entry.active_extra_target = number
    return len(extras) - 1 > number


def switch(rig, entry, goal, start, end, interpolation):
    """Key the way from the present target to `goal` from one frame to another; later switches start from it."""
    number = present(rig, entry, start)
    check_other(entry, number, goal)
    actions.make_local(rig)
    curve, last = curve_of(rig, entry), float(len(entry.extra_targets))
    with setup.at_once(rig):
        is_between = place_next(entry, number, goal)
        if curve:
            _change(curve, lambda value: min(value, last))  # more was the last target too
            _renumber(curve, number, start, end, is_between)
        writer = KeyWriter()
        path = curve.data_path if curve else ""
        writer.write(entry, "target_blend", [start, end], [float(number), number + 1.0], interpolation, instead_of=path)
    return number


def _renumber(curve, number, start, end, is_between):
    """Keys of switches before and after this one, by the numbers that targets have now."""
    for key in curve.keyframe_points:
        value, is_later = key.co.y, key.co.x > end + SAME_FRAME
        # What left this target later leaves the new one now.
        leaves_here = is_later and number - LARGEST_STEP < value <= number + LARGEST_STEP
        if leaves_here or (is_between and value > number + LARGEST_STEP):
            for point in (key.co, key.handle_left, key.handle_right):
                point.y += 1.0
    curve.update()


def take_out(rig, entry, number):
    """Renumber Blend and its keys for a further target, by its number, that is about to be removed."""
    paths = [prefix + "target_blend" for prefix in chains.prefixes(rig, rig.motus.ik.entries.find(entry.name))]
    for player in actions.players(rig):
        if any(curve.data_path in paths and _passes(curve, number) for curve in actions.curves_of(player)):
            actions.make_own(player)  # a rig that shares it has targets of its own
            for curve in actions.curves_of(player):
                if curve.data_path in paths:
                    _change(curve, lambda value: stations.without(value, number))
    if entry.target_blend > number - 1.0:
        entry.target_blend = stations.without(entry.target_blend, number)


def _passes(curve, number):
    """Whether the target of this number, or a later one, is on the way of an F-curve."""
    return any(key.co.y > number - 1.0 for key in curve.keyframe_points)


def _change(curve, change):
    """Give the points of all keys other values."""
    for key in curve.keyframe_points:
        for point in (key.co, key.handle_left, key.handle_right):
            point.y = change(point.y)
    curve.update()
