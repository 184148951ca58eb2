"""Keys of a scene that begins again after nine seconds."""

CYCLE = 216  # frames


def key_cycle(thing, name, keys, index=-1):
    """Key a property, or one of its axes, at frames of the cycle and of those before and after: it closes smoothly."""
    for turn in (-1, 0, 1):
        for frame, value in keys:
            if index < 0:
                setattr(thing, name, value)
            else:
                getattr(thing, name)[index] = value
            thing.keyframe_insert(name, index=index, frame=frame + turn * CYCLE)
