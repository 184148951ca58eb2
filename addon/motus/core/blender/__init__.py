"""Wrappers of Blender's API: differences between versions, and tasks that take several API calls. They know nothing of systems."""
