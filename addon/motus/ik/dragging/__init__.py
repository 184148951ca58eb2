"""Dragging a chain by any of its points."""
