"""The wooden pilot of the demo scenes: armature, mesh, and actions that animate the pilot."""
