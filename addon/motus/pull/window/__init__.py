"""Pulling with the mouse: the tool, its cursor and keys, and what the viewport shows meanwhile."""
