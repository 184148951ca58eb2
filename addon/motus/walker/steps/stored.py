"""Steps that were chosen by hand, as a walker's settings hold them and as the native Walker takes them."""

import math


def read(settings):
    """Tuple of the chosen steps of a walker, which the plan is made from.

    Each is (leg, frame, offset, turn, None or (place, rotation), frame of the touchdown or None, frame of the lift-off or None).
    """
    return tuple(
        (
            step.leg,
            step.frame,
            tuple(step.offset),
            step.turn,
            (tuple(step.place), tuple(step.rotation)) if step.is_locked else None,
            step.touch if step.use_touch else None,
            step.lift if step.use_lift else None,
        )
        for step in settings.steps
    )


def numbers(found):
    """All numbers of chosen steps. found: result of read()."""
    for _leg, frame, offset, turn, locked, *moments in found:
        yield from (frame, *offset, turn)
        for part in locked or ():
            yield from part
        yield from _set(moments)


def last_moment(settings):
    """Last frame on which a changed step of a walker touches down or lifts, among those that are set; -inf if none is."""
    moments = [one for *_, touch, lift in read(settings) for one in _set((touch, lift)) if math.isfinite(one)]
    return max(moments, default=-math.inf)


def _set(moments):
    return [one for one in moments if one is not None]


def given(found, fps):
    """Chosen steps as the native Walker takes them, with seconds instead of frames. found: result of read()."""

    def seconds(frame):
        return None if frame is None else frame / fps

    return [(leg, seconds(frame), *rest, seconds(touch), seconds(lift)) for leg, frame, *rest, touch, lift in found]
