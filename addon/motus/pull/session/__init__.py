"""Session of pulls on a mesh, without a window: what each dab reaches and moves, and what can be undone and repeated."""
