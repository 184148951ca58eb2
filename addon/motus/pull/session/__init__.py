"""Session of pulls on a mesh, without a window: what each dab of the brush reaches and moves, and what can be undone and redone."""
