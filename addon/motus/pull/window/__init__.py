"""Pulling with the mouse: the tool in the toolbar with its cursor and keys, and what viewports show during a session."""
