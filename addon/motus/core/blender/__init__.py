"""Differences between versions of Blender, and what its API takes several steps for; knows nothing of systems."""
