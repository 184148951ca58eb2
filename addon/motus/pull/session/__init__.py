"""A session of pulls on a mesh, without a window: what a dab reaches and moves, and what has been done."""
