"""Pulling with the mouse: the tool with its cursor and keys, and what the viewport shows during a session."""
