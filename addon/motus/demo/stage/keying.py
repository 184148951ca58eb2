"""Keys of a scene, and of one that begins again after nine seconds."""

CYCLE = 216  # frames


def key(thing, name, keys, index=-1, shift=0):
    """Key a property, or one of its axes, at (frame, value) rows, so many frames later."""
    for frame, value in keys:
        if index < 0:
            setattr(thing, name, value)
        else:
            getattr(thing, name)[index] = value
        thing.keyframe_insert(name, index=index, frame=frame + shift)


def key_cycle(thing, name, keys, index=-1):
    """Key a property, or one of its axes, at frames of the cycle and of those before and after: it closes smoothly."""
    for turn in (-1, 0, 1):
        key(thing, name, keys, index, turn * CYCLE)
