"""Find what animates a setting whose past counts: F-curves, drivers, NLA strips. core/animation/keys.py reads the values of the keys."""

from ..core.animation import channel


def find(owner, settings, name):
    """The F-curve of the active action that animates a setting, or None. owner: original or evaluated object."""
    return channel.acting_curve(owner, _path(settings, name))


def is_driven(owner, settings, name):
    """Whether a driver sets the setting, so that only its present value is known."""
    return channel.is_driven(owner, _path(settings, name))


def is_in_strips(owner, settings, name):
    """Whether NLA strips take part in the setting's value, so that only its present value is known."""
    return channel.is_in_strips(owner, _path(settings, name))


def _path(settings, name):
    return f"{settings.path_from_id()}.{name}"
