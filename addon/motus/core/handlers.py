"""Appends functions to Blender's lists of handlers, and takes them out again whatever other scripts have done to the lists."""


def add(pairs):
    """pairs: (list of handlers, function)."""
    for functions, function in pairs:
        functions.append(function)


def remove(pairs):
    """Take back what add() did, last first. A script may have cleared the list."""
    for functions, function in reversed(pairs):
        if function in functions:
            functions.remove(function)
