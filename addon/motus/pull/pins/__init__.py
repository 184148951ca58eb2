"""Pins: pulls that are kept in a list on the object, and applied by a solver on each frame."""
