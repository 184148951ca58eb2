"""What is being pulled in the window now, for those who draw it: one thing at a time, or nothing."""

_on = []


def enter(pulling):
    """This one is on, in place of whatever was."""
    _on[:] = [pulling]


def leave(pulling):
    """This one is over."""
    if pulling in _on:
        _on.remove(pulling)


def clear():
    """Whatever was on is over: its file is closed, or the add-on goes."""
    _on.clear()


def current():
    """What is on, or None."""
    return _on[0] if _on else None
