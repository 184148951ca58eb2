"""Holds the session (Pulling) that runs in the window, at most one, for the modules that draw it."""

_on = []


def enter(pulling):
    """Make a session the running session; it replaces a previous one."""
    _on[:] = [pulling]


def leave(pulling):
    """Remove a session that has ended, if it is the running session."""
    if pulling in _on:
        _on.remove(pulling)


def clear():
    """Remove the running session, since the file is closed or the add-on is disabled."""
    _on.clear()


def current():
    """The running session; None if there is none."""
    return _on[0] if _on else None
