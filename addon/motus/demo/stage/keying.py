"""Set keys, for a scene or for a scene that loops after nine seconds."""

CYCLE = 216  # frames of a loop


def key(thing, name, keys, index=-1, shift=0):
    """Key a property, or one of its axes. keys: (frame, value) rows. shift: number of frames by which the keys are set later."""
    for frame, value in keys:
        if index < 0:
            setattr(thing, name, value)
        else:
            getattr(thing, name)[index] = value
        thing.keyframe_insert(name, index=index, frame=frame + shift)


def key_cycle(thing, name, keys, index=-1):
    """Key a property, or one of its axes, in a cycle and the cycles before and after, so that the loop closes smoothly."""
    for turn in (-1, 0, 1):
        key(thing, name, keys, index, turn * CYCLE)
