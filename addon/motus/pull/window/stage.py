"""The session that runs in the window now, for the modules that draw it: one or none."""

_on = []


def enter(pulling):
    """Make a session the running one, in place of the previous one."""
    _on[:] = [pulling]


def leave(pulling):
    """Remove a session that has ended."""
    if pulling in _on:
        _on.remove(pulling)


def clear():
    """Remove any session: the file is closed, or the add-on is disabled."""
    _on.clear()


def current():
    """The running session, or None."""
    return _on[0] if _on else None
