"""Pins: pulls that are kept in a list on the object, and evaluated by a solver on each frame."""
