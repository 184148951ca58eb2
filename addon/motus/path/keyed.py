"""Find the F-curve, driver or NLA strips that animate a follower's setting; core/animation/keys.py reads the values of the keys."""

from ..core.animation import channel


def find(owner, settings, name):
    """F-curve of the active action that animates a follower's setting; None if there is none. owner: original or evaluated object."""
    return channel.acting_curve(owner, _path(settings, name))


def is_driven(owner, settings, name):
    """Whether a driver sets the follower's setting. Only the present value of a driven setting is known."""
    return channel.is_driven(owner, _path(settings, name))


def is_in_strips(owner, settings, name):
    """Whether NLA strips take part in the value of the follower's setting. Only the present value of such a setting is known."""
    return channel.is_in_strips(owner, _path(settings, name))


def _path(settings, name):
    return f"{settings.path_from_id()}.{name}"
