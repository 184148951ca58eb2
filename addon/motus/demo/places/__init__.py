"""Landscapes and rooms for demo scenes: the land around a lake, its woods, a colonnade, and a studio."""
