"""Which keys animate a setting whose past counts; what they say of it stands in core/animation/keys.py."""

from ..core.animation import channel


def find(owner, settings, name):
    """The F-curve of the active action that animates a setting, or None. `owner` may be evaluated."""
    return channel.acting_curve(owner, _path(settings, name))


def is_driven(owner, settings, name):
    """Whether a driver sets the setting, so that only its present value is known."""
    return channel.is_driven(owner, _path(settings, name))


def is_in_strips(owner, settings, name):
    """Whether NLA strips take part in the setting's value, so that only its present one is known."""
    return channel.is_in_strips(owner, _path(settings, name))


def _path(settings, name):
    return f"{settings.path_from_id()}.{name}"
