"""Steps that were chosen by hand, as a walker's settings hold them and as the native Walker takes them."""


def read(settings):
    """Tuple of the chosen steps of a walker, which the plan is made from: (leg, frame, offset, turn, None or (place, rotation)) each."""
    return tuple(
        (
            step.leg,
            step.frame,
            tuple(step.offset),
            step.turn,
            (tuple(step.place), tuple(step.rotation)) if step.is_locked else None,
        )
        for step in settings.steps
    )


def numbers(found):
    """All numbers of chosen steps. found: result of read()."""
    for _leg, frame, offset, turn, locked in found:
        yield from (frame, *offset, turn)
        for part in locked or ():
            yield from part


def given(found, fps):
    """Chosen steps as the native Walker takes them, with seconds instead of frames. found: result of read()."""
    return [(leg, frame / fps, *rest) for leg, frame, *rest in found]
